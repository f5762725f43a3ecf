/// Contact law `elastic_ring`: rigid blades, and a massless ring that yields under each tip (MODEL 4.7).
#pragma once

#include <cmath>

#include "contact/friction_law.hpp"
#include "contact/pose.hpp"

namespace rubatlas::contact {

/// With any friction law: the slip velocity of a rigid blade does not depend on the force, so c(v) is
/// explicit.
template <class FrictionLaw>
class RigidBladeContact {
 public:
  /// The force follows from the position alone; nothing bends.
  static constexpr bool kHasBending = false;
  static constexpr bool kHasSlipState = FrictionLaw::kHasSlipState;
  static constexpr bool kLoadFollowsGap = true;

  RigidBladeContact(Geometry geometry, double stiffness, FrictionLaw friction)
      : geometry_(geometry), stiffness_(stiffness), friction_(friction) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  /// The law of one blade: the same for all.
  using OfBlade = RigidBladeContact;
  [[nodiscard]] const OfBlade& of(int /*blade*/) const { return *this; }
  [[nodiscard]] const FrictionLaw& friction() const { return friction_; }
  [[nodiscard]] double stiffness() const { return stiffness_; }  ///< kr [N/m]
  [[nodiscard]] static double damping() { return 0.0; }          ///< of the ring: none
  /// The same blade, shorter at its tip by `lost` [m].
  [[nodiscard]] RigidBladeContact shortened(double lost) const {
    return {{geometry_.reach - lost, geometry_.ring_radius}, stiffness_, friction_};
  }

  /// F = kr (|rk| − R). Always true: the force is continued linearly beyond lift-off, where Runge–Kutta
  /// stages may land.
  bool respond(const Pose& at, double slip, double angular_speed, double& /*bending*/,
               TipForce& force) const {
    const double a = at.radial + geometry_.reach;
    const double b = at.tangential;
    const double distance = std::sqrt(a * a + b * b);
    // |rk| − R from g = |rk|² − R²: exact where |rk| and R are nearly equal.
    const double load = stiffness_ * at.gap / (distance + geometry_.ring_radius);
    force = under_load(at, slip, angular_speed, load);
    return true;
  }
  /// Force and slip velocity of a tip under the normal load F [N].
  [[nodiscard]] TipForce under_load(const Pose& at, double slip, double angular_speed, double load) const {
    TipForce force;
    const double a = at.radial + geometry_.reach;
    const double b = at.tangential;
    const double distance = std::sqrt(a * a + b * b);
    const double normal_radial = a / distance;
    const double normal_tangential = b / distance;
    force.slip_velocity = normal_radial * at.tangential_velocity - normal_tangential * at.radial_velocity +
                          angular_speed * geometry_.reach * normal_radial;
    const double friction = friction_.coefficient(force.slip_velocity, slip) * load;
    force.radial = -load * normal_radial + friction * normal_tangential;
    force.tangential = -load * normal_tangential - friction * normal_radial;
    force.normal = load;
    force.shortening = 0.0;
    force.root_strain = 0.0;
    return force;
  }

  /// The same as `respond`, with the force raised from 0 by increments until it has reached its value, as in
  /// `ElasticaContact`.
  bool respond_upwards(const Pose& at, double slip, double angular_speed, double increment,
                       TipForce& force) const {
    double bending = 0.0;
    respond(at, slip, angular_speed, bending, force);
    const double stepped = std::ceil(force.normal / increment) * increment;
    const double excess = force.normal > 0.0 ? stepped / force.normal : 1.0;
    force.radial *= excess;
    force.tangential *= excess;
    force.normal = stepped;
    return true;
  }

 private:
  Geometry geometry_;
  double stiffness_;  ///< kr [N/m]
  FrictionLaw friction_;
};

/// The law of MODEL 4.7, with Coulomb friction μ.
using ElasticRingContact = RigidBladeContact<CoulombFriction>;

}  // namespace rubatlas::contact
