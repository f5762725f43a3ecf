/// The elastica's closed form as printed (MODEL 3.2), in 160-digit arithmetic with Boost's Legendre
/// integrals.
///
/// Shares nothing with the program: no complementary amplitude, no half-angle products. So many digits pay
/// for the cancellations of this form, which eats some eighty of them where the blade is all but unloaded.
#pragma once

namespace rubatlas::blade {

/// A point of the curve with its slopes by u, rounded once, at the end.
struct LegendrePoint {
  long double load;        ///< F L² / EI [-]
  long double shortening;  ///< δ / L [-]
  long double deflection;  ///< Δ / L [-]
};

/// At μ >= 0 and bending parameter u > 0.
LegendrePoint legendre_form(double friction, double bending);

/// Derivatives by u: central differences of the above over u ± 1e-9 u, good to 1e-17 where the blade is all
/// but unloaded and half of the digits have cancelled, too.
LegendrePoint legendre_slopes(double friction, double bending);

}  // namespace rubatlas::blade
