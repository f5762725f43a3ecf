/// Functions of a `double`, or of eight nodes in lanes at once, made of sums and products alone, so that
/// their bits are the same on every processor.
#pragma once

#include <algorithm>
#include <cmath>

namespace rubatlas::contact {

// What lanes have for themselves (`collocation/nodes_in_lanes.hpp`).
inline double smaller(double a, double b) {
  return std::min(a, b);
}
inline double magnitude(double a) {
  return std::abs(a);
}
inline double with_sign_of(double a, double b) {
  return std::copysign(a, b);
}

/// 1 − e^−x for x >= 0, with an error of less than 2e-15 of it. Beyond 40 it is 1 to the last bit.
///
/// The series at x/64, and six times y(2x) = y (2 − y), which loses no digits.
template <class Number>
Number decayed(const Number& x) {
  constexpr double kLargest = 40.0;
  constexpr int kDoublings = 6;
  const Number part = smaller(x, Number(kLargest)) * (1.0 / 64.0);
  constexpr int kTerms = 15;
  Number sum(1.0);
  for (int k = kTerms; k > 1; --k) sum = Number(1.0) - part * sum * (1.0 / k);
  Number result = part * sum;
  for (int i = 0; i < kDoublings; ++i) result = result * (Number(2.0) - result);
  return result;
}

/// tanh x, with an error of less than 2e-15 of it.
template <class Number>
Number hyperbolic_tangent(const Number& x) {
  // Of the same sign as x: x/|x| would be no number at 0.
  const Number decay = decayed(Number(magnitude(x) * 2.0));
  const Number size = decay / (Number(2.0) - decay);
  return with_sign_of(size, x);
}

}  // namespace rubatlas::contact
