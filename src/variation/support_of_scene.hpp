/// The shaft's stiffness and damping in a scene, with those of effect `support`.
#pragma once

#include "rotor/support_matrices.hpp"
#include "settings/effects/list.hpp"
#include "settings/scene.hpp"

namespace rubatlas::variation {

/// K and C of z'' + C z' + K z = f at a speed ratio Ω (`settings/effects/support.hpp`).
inline rotor::SupportMatrices support_of(const settings::Scene& line, double speed_ratio) {
  const effects::Support added = line.support.value_or(effects::Support{});
  const double damping = line.rotor.mass * line.rotor.natural_frequency;
  const double stiffness = damping * line.rotor.natural_frequency;
  rotor::SupportMatrices matrices = rotor::isotropic_shaft(line.rotor.damping_ratio);
  Eigen::Matrix2d more;
  more << added.stiffness_xx, added.stiffness_xy, added.stiffness_yx, added.stiffness_yy;
  matrices.stiffness += more / stiffness;
  more << added.damping_xx, added.damping_xy, added.damping_yx, added.damping_yy;
  matrices.damping += more / damping;
  return rotor::with_rotating_damping(matrices, 0.5 * added.rotating_damping / damping, speed_ratio);
}

}  // namespace rubatlas::variation
