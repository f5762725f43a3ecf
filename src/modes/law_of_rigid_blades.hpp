/// Rigid blades on an elastic ring, whose force follows from the gap: on a ring that yields under each tip,
/// with a damper or without, or that has no mass and stands where all blades push it.
#pragma once

#include <memory>

#include "contact/elastic_ring_contact.hpp"
#include "modes/law.hpp"

namespace rubatlas::modes {

class LawOfRigidBlades final : public LawOfBlades<LawOfRigidBlades, contact::ElasticRingContact> {
 public:
  using LawOfBlades::LawOfBlades;

  bool respond(const TipPlace& at, OpenContact& contact, contact::TipForce& force) const override {
    return of(contact.blade).respond(at.pose, contact.slip, at.speed, contact.bending, force);
  }
  [[nodiscard]] Kind kind() const override {
    const contact::Friction& friction = of(0).friction();
    return {.has_slip_state = friction.has_slip_state(),
            .sticks = friction.sticks,
            .load_follows_gap = !has_damper()};
  }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;
  [[nodiscard]] std::unique_ptr<RestJudge> rest_judge(const ContactSetup& setup) const override;
  [[nodiscard]] bool has_damper() const { return of(0).damping() > 0.0; }
};

}  // namespace rubatlas::modes
