/// Contact law `elastic_ring`: rigid blades, and a massless ring that yields under each tip (MODEL 4.7).
#pragma once

#include <cstdint>

#include "contact/friction_law.hpp"
#include "contact/pose.hpp"
#include "contact/tip.hpp"

namespace rubatlas::contact {

/// With any friction law: the slip velocity of a rigid blade does not depend on the force, so c(v) is
/// explicit. The ring may have a damper beside its spring under each tip, F = kr y + cr y' (Kelvin and
/// Voigt), y the depth of the tip; a contact then ends where F comes to zero, with the tip still inside.
class ElasticRingContact {
 public:
  /// `damping`: cr ωn [N per (m per unit τ)].
  ElasticRingContact(Geometry geometry, double stiffness, const Friction& friction, double damping = 0.0)
      : geometry_(geometry), stiffness_(stiffness), friction_(friction), damping_(damping) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] const Friction& friction() const { return friction_; }
  [[nodiscard]] double stiffness() const { return stiffness_; }  ///< kr [N/m]
  [[nodiscard]] double damping() const { return damping_; }      ///< cr ωn [N per (m per unit τ)]
  /// Rigid blades have no curve.
  [[nodiscard]] static std::uint64_t evaluations() { return 0; }
  /// The same blade, shorter at its tip by `lost` [m].
  [[nodiscard]] ElasticRingContact shortened(double lost) const {
    return {geometry_.shortened(lost), stiffness_, friction_, damping_};
  }

  /// F = kr (|rk| − R) + cr d|rk|/dτ, continued beyond lift-off, where Runge–Kutta stages may land.
  [[nodiscard]] TipForce force(const Pose& at, double slip, double angular_speed) const {
    const BladeVector<double> tip = unbent_tip(geometry_, at);
    const double distance = magnitude(tip);
    // |rk| − R from g = |rk|² − R²: exact where |rk| and R are nearly equal.
    double load = stiffness_ * at.gap / (distance + geometry_.ring_radius);
    if (damping_ > 0.0) load += damping_ * (0.5 * gap_rate(geometry_, at, angular_speed) / distance);
    const double velocity = undeformed_slip_velocity(geometry_, at, angular_speed);
    return tip_force(tip, distance, velocity, load, friction_.coefficient(velocity, slip));
  }

 private:
  Geometry geometry_;
  double stiffness_;  ///< kr [N/m]
  Friction friction_;
  double damping_;  ///< cr ωn [N per (m per unit τ)]
};

}  // namespace rubatlas::contact
