/// What equations ask of a number beyond arithmetic. A number is a double, or the lanes of a SIMD register
/// (`std::experimental::simd`), one motion in each; their `abs` and `sqrt` are found beside their types.
#pragma once

#include <concepts>

namespace rubatlas::number {

/// Whether a comparison holds, for lanes in any of them.
template <class Mask>
bool any(const Mask& mask) {
  if constexpr (std::same_as<Mask, bool>) {
    return mask;
  } else {
    return any_of(mask);
  }
}

/// `yes` where a comparison holds, else `no`; for lanes in each by itself.
template <class Mask, class Number>
Number choose(const Mask& mask, const Number& yes, const Number& no) {
  if constexpr (std::same_as<Mask, bool>) {
    return mask ? yes : no;
  } else {
    Number chosen = no;
    where(mask, chosen) = yes;
    return chosen;
  }
}

}  // namespace rubatlas::number
