/// Effect `support`: stiffness and damping added to the shaft, as any 2×2 matrices.
///
///     z'' + C z' + K z = f,   K = I + ΔK/k + 2ζr Ω J,   C = 2ζ I + ΔC/(m ωn) + 2ζr I,   2ζr = cr/(m ωn)
///
/// An anisotropic shaft or bearing has Δkxx ≠ Δkyy, a seal kxy = −kyx, and damping that turns with the rotor
/// (cr, friction within the shaft) drives a forward whirl that is slower than the spin; J = ((0, 1), (−1,
/// 0)). Linear, so that flight stays exact; a support that is unstable in flight ends a point where the shaft
/// reaches the ring (MODEL 5).
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct Support {
  double stiffness_xx = 0.0;      ///< Δkxx [N/m]
  double stiffness_xy = 0.0;      ///< Δkxy [N/m]: force −Δkxy y along x
  double stiffness_yx = 0.0;      ///< Δkyx [N/m]: force −Δkyx x along y
  double stiffness_yy = 0.0;      ///< Δkyy [N/m]
  double damping_xx = 0.0;        ///< Δcxx [N s/m]
  double damping_xy = 0.0;        ///< Δcxy [N s/m]: force −Δcxy dy/dt along x
  double damping_yx = 0.0;        ///< Δcyx [N s/m]: force −Δcyx dx/dt along y
  double damping_yy = 0.0;        ///< Δcyy [N s/m]
  double rotating_damping = 0.0;  ///< cr [N s/m]

  static constexpr Description kDescription{
      .section = "/support",
      .meaning = "stiffness and damping besides the shaft's own: anisotropy, seals, rotating damping",
      .equation =
          "z'' + (2ζ I + ΔC/(m ωn) + 2ζr I) z' + (I + ΔK/k + 2ζr Ω J) z = f, 2ζr = cr/(m ωn), "
          "J = ((0, 1), (−1, 0))",
      .source = "Ehrich, Handbook of Rotordynamics; Yamamoto & Ishida, Linear and Nonlinear Rotordynamics",
      .flight = "closed form: the exponential of the system's matrix",
      .breaks = "mirror symmetry; phase volume contracts by e^{-tr(C) T}",
  };
  static constexpr auto quantities() {
    constexpr settings::Range kAny = settings::between(-1e15, 1e15);
    return std::tuple{Field<&Support::stiffness_xx>{.pointer = "/support/stiffness_xx",
                                                    .symbol = "Δkxx",
                                                    .unit = "N/m",
                                                    .meaning = "stiffness along x, added to the shaft's",
                                                    .source = "none",
                                                    .range = kAny},
                      Field<&Support::stiffness_xy>{.pointer = "/support/stiffness_xy",
                                                    .symbol = "Δkxy",
                                                    .unit = "N/m",
                                                    .meaning = "force against x for a displacement along y",
                                                    .source = "none",
                                                    .range = kAny},
                      Field<&Support::stiffness_yx>{.pointer = "/support/stiffness_yx",
                                                    .symbol = "Δkyx",
                                                    .unit = "N/m",
                                                    .meaning = "force against y for a displacement along x",
                                                    .source = "none",
                                                    .range = kAny},
                      Field<&Support::stiffness_yy>{.pointer = "/support/stiffness_yy",
                                                    .symbol = "Δkyy",
                                                    .unit = "N/m",
                                                    .meaning = "stiffness along y, added to the shaft's",
                                                    .source = "none",
                                                    .range = kAny},
                      Field<&Support::damping_xx>{.pointer = "/support/damping_xx",
                                                  .symbol = "Δcxx",
                                                  .unit = "N s/m",
                                                  .meaning = "damping along x, added to the shaft's",
                                                  .source = "none",
                                                  .range = kAny},
                      Field<&Support::damping_xy>{.pointer = "/support/damping_xy",
                                                  .symbol = "Δcxy",
                                                  .unit = "N s/m",
                                                  .meaning = "force against x for a velocity along y",
                                                  .source = "none",
                                                  .range = kAny},
                      Field<&Support::damping_yx>{.pointer = "/support/damping_yx",
                                                  .symbol = "Δcyx",
                                                  .unit = "N s/m",
                                                  .meaning = "force against y for a velocity along x",
                                                  .source = "none",
                                                  .range = kAny},
                      Field<&Support::damping_yy>{.pointer = "/support/damping_yy",
                                                  .symbol = "Δcyy",
                                                  .unit = "N s/m",
                                                  .meaning = "damping along y, added to the shaft's",
                                                  .source = "none",
                                                  .range = kAny},
                      Field<&Support::rotating_damping>{.pointer = "/support/rotating_damping",
                                                        .symbol = "cr",
                                                        .unit = "N s/m",
                                                        .meaning = "damping that turns with the rotor",
                                                        .source = "none",
                                                        .range = settings::between(0.0, 1e15)}};
  }
  [[nodiscard]] bool acts() const {
    return stiffness_xx != 0.0 || stiffness_xy != 0.0 || stiffness_yx != 0.0 || stiffness_yy != 0.0 ||
           damping_xx != 0.0 || damping_xy != 0.0 || damping_yx != 0.0 || damping_yy != 0.0 ||
           rotating_damping != 0.0;
  }
};

}  // namespace rubatlas::effects
