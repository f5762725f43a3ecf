/// Elastic blades on a ring with dampers, which yields in its own time. On the receding side a blade stands
/// straight while the ring's load is too small to bend it.
#pragma once

#include <cstdint>
#include <memory>

#include "contact/damped_ring.hpp"
#include "modes/law.hpp"

namespace rubatlas::modes {

class LawOfDampedRing final : public LawOfBlades<LawOfDampedRing, contact::ElasticBladeOnDampedRing> {
 public:
  using LawOfBlades::LawOfBlades;

  /// Where its blade stands in the ring that yields by y, the `yielding` of the contact.
  bool respond(const TipPlace& at, OpenContact& contact, contact::TipForce& force) const override {
    return of(contact.blade)
        .respond(at.pose, contact.slip, at.speed, contact.yielding, contact.bending, force);
  }
  [[nodiscard]] Kind kind() const override {
    return {.lifts_off_inside = true, .price_of_curve = WorkPrice::kCurve};
  }
  [[nodiscard]] std::uint64_t evaluations() const override { return blades().evaluations(); }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;

  [[nodiscard]] bool open(const TipPlace& at, OpenContact& contact) const override;
  /// A blade that has unbent to the ring's circle stays in contact where the ring pushes it.
  [[nodiscard]] bool straightens(const TipPlace& at, OpenContact& contact) const override;
  [[nodiscard]] bool knows_rest() const override { return false; }
};

}  // namespace rubatlas::modes
