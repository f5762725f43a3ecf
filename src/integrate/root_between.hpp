/// Root of a function between two points where it has opposite signs.
#pragma once

#include "integrate/function_view.hpp"

namespace rubatlas::integrate {

/// The root to `bits` bits of the argument, by default to the last one (TOMS 748, which keeps the root
/// bracketed whatever the rounding). Where rounding gives both ends one sign, or makes them one place, the
/// end with the smaller |value|; where a value is not a number, `high`. The ends may be given in either
/// order.
double root_between(FunctionView function, double low, double high, double at_low, double at_high,
                    unsigned bits = 52);

}  // namespace rubatlas::integrate
