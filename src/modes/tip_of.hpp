/// The tip of an undeformed blade against the ring, as observables see it.
#pragma once

#include <cmath>

#include "contact/tip.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

inline trajectory::Tip tip_of(const contact::Geometry& geometry, const contact::Pose& at,
                              double angular_speed) {
  const double radius = geometry.ring_radius;
  // |tip|² = R² + g
  const double distance = std::sqrt(std::fmax(radius * radius + at.gap, 0.0));
  const double slip = contact::undeformed_slip_velocity(geometry, at, angular_speed);
  return {at.gap / (radius + distance), 0.5 * contact::gap_rate(geometry, at, angular_speed) / distance,
          std::copysign(1.0, slip) * at.tangential};
}

}  // namespace rubatlas::modes
