/// How a force changes with the state of the shaft along the path of a contact.
#pragma once

#include <Eigen/Core>

namespace rubatlas::variation {

/// Derivatives of a contact's force on the rotor by c and c', times τ_θ.
struct ForceSlopes {
  Eigen::Matrix2d by_place = Eigen::Matrix2d::Zero();     ///< (df/dc) τ_θ [N/m]
  Eigen::Matrix2d by_velocity = Eigen::Matrix2d::Zero();  ///< (df/dc') τ_θ [N per (m per unit τ)]

  ForceSlopes& operator+=(const ForceSlopes& other) {
    by_place += other.by_place;
    by_velocity += other.by_velocity;
    return *this;
  }
};

/// Sizes of τ_θ, and of u_θ or κ_θ and φ_θ, on a piece, against which their errors count.
struct PathScale {
  double time_rate = 1.0;
  double bending_rate = 1.0;
};

}  // namespace rubatlas::variation
