/// What a linear support is made of: contributions to K and C of z'' + C z' + K z = f, dimensionless
/// (k = m ωn² for stiffness, m ωn for damping), each added to the isotropic shaft of MODEL 1.
#pragma once

#include <Eigen/Core>

namespace rubatlas::rotor {

struct SupportMatrices {
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Identity();  ///< K [-]
  Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();        ///< C [-]
};

/// The isotropic shaft: K = I, C = 2ζ I.
inline SupportMatrices isotropic_shaft(double damping_ratio) {
  return {Eigen::Matrix2d::Identity(), 2.0 * damping_ratio * Eigen::Matrix2d::Identity()};
}

/// Damping ζ_r that turns with the rotor at Ω (internal damping of shaft and shrink fits): its force
/// −2ζ_r (z' − iΩ z) opposes the velocity that a turning observer sees, hence C += 2ζ_r I and
/// K += 2ζ_r Ω [[0, 1], [−1, 0]]. It feeds forward whirl slower than the rotor: with external damping ζ the
/// threshold is Ω = 1 + ζ/ζ_r (Yamamoto & Ishida, Linear and Nonlinear Rotordynamics;
/// Ehrich, Handbook of Rotordynamics).
inline SupportMatrices with_rotating_damping(SupportMatrices support, double rotating_damping_ratio,
                                             double speed_ratio) {
  const double cross = 2.0 * rotating_damping_ratio * speed_ratio;
  support.damping.diagonal().array() += 2.0 * rotating_damping_ratio;
  support.stiffness(0, 1) += cross;
  support.stiffness(1, 0) -= cross;
  return support;
}

}  // namespace rubatlas::rotor
