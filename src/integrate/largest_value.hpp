/// The largest value of a function that is smooth on the scale of its samples.
#pragma once

#include <span>

#include "integrate/function_view.hpp"

namespace rubatlas::integrate {

struct Sample {
  double argument;
  double value;
};

/// From three samples or more, in the order of their arguments, within [0, 1]: where the function is largest
/// between the first and the last of them, however often it rises and falls there. The argument errs by about
/// 1e-6, the value by the square of that. Where it is not larger than `known`, the largest sample.
Sample largest_value(FunctionView function, std::span<const Sample> samples, double known);

}  // namespace rubatlas::integrate
