/// Contact law of elastic blades on a massless ring with a spring and a damper under each tip: F = kr y +
/// cr y' (Kelvin and Voigt), y how far the ring yields. (Rigid blades: `elastic_ring_contact.hpp`.) Source:
/// Johnson, Contact Mechanics, 1985, §6.4.
///
/// The ring pushes and never pulls: a contact ends where F comes to zero, with the tip still inside the
/// undeformed ring. The laws of its arcs are
/// `collocation/rigid_law.hpp` and `damped_law.hpp`; in steps it is `compared/damped_ring.hpp`.
#pragma once

#include <cmath>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/tip.hpp"

namespace rubatlas::contact {

/// Elastic blades: the blade stands in a ring of radius R + y, and y follows from its force,
///     cr y' = F − kr y.
/// On the receding side a blade bends under a finite load only (MODEL 4.2). Below that it stands straight,
/// and the ring yields under it as under a rigid one: y is the depth of the tip, and F = kr y + cr y'.
///
/// Its equilibria are those of the blade in a ring of any radius: that is read from the gap of its pose
/// alone.
class ElasticBladeOnDampedRing : public ElasticaContact {
 public:
  /// `stiffness`: kr [N/m]; `damping`: cr ωn [N per (m per unit τ)], under each tip.
  ElasticBladeOnDampedRing(const ElasticaContact& blade, double stiffness, double damping)
      : ElasticaContact(blade), straight_(geometry(), stiffness, friction(), damping) {}

  [[nodiscard]] const ElasticRingContact& straight() const { return straight_; }  ///< where it does not bend
  /// The same blade, shorter at its tip by `lost` [m].
  [[nodiscard]] ElasticBladeOnDampedRing shortened(double lost) const {
    return {ElasticaContact::shortened(lost), straight_.stiffness(), straight_.damping()};
  }

  /// dy/dτ [m per unit τ] under a load F [N].
  [[nodiscard]] double yielding_rate(double load, double yielding) const {
    return (load - straight_.stiffness() * yielding) / straight_.damping();
  }

  /// How deep the tip of a straight blade stands in the undeformed ring [m]; 0 outside.
  [[nodiscard]] double depth(const Pose& at) const {
    const double radius = geometry().ring_radius;
    return at.gap > 0.0 ? at.gap / (radius + std::sqrt(radius * radius + at.gap)) : 0.0;
  }
  /// Load above which a straight blade bends [N]; on the approaching side 0, or Euler's without friction.
  [[nodiscard]] double bending_load(const Pose& at, double slip, double angular_speed) const {
    if (starts_unloaded(at, slip)) return curve().friction() > 0.0 ? 0.0 : blade::kEulerLoad * load_unit();
    Pose touching = at;
    touching.gap = 0.0;
    double bending = 0.0;
    TipForce force{};
    return respond(touching, slip, angular_speed, bending, force) ? force.normal : 0.0;
  }

 private:
  ElasticRingContact straight_;
};

}  // namespace rubatlas::contact
