/// Modes of rigid blades on an elastic ring, whose force follows from the gap: on a ring that yields under
/// each tip, or that has no mass and stands where all blades push it.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "contact/elastic_ring_contact.hpp"
#include "contact/friction_law.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "modes/collocated_laws.hpp"
#include "modes/following_ring.hpp"
#include "modes/modes_of_law.hpp"
#include "modes/solved.hpp"
#include "modes/sticking.hpp"
#include "modes/tips_that_stick.hpp"

namespace rubatlas::modes {

template <class Friction, class Pair = integrate::DormandPrince853>
class ModesOfRigidBlades : public ModesOfLaw<contact::RigidBladeContact<Friction>, Pair> {
 public:
  using Base = ModesOfLaw<contact::RigidBladeContact<Friction>, Pair>;
  using typename Base::Law;

  ModesOfRigidBlades(const ModesRequest& request, Law law) : Base(request, std::move(law)) {
    if (request.machine.following_ring() != nullptr) {
      ring_placer_.emplace(this->setup_);
      this->solved_ = this->template phase_of<FollowingRing<Law>>();
    } else {
      this->solved_ = this->template phase_of<Solved<Law>>();
    }
    this->collocated_ = modes::collocated(request, this->law_);
  }

  bool place_ring(rotor::ShaftAndRing& state, double time, std::vector<OpenContact>& contacts,
                  const ContactModes::Touches& touches) override {
    return !ring_placer_ || ring_placer_->settle(state, time, contacts, touches);
  }

 private:
  std::optional<FollowingRing<Law>> ring_placer_;
};

/// Of tips that may stick.
template <class Pair = integrate::DormandPrince853>
using ModesOfStickingRigid = WithTipsThatStick<
    ModesOfRigidBlades<contact::StickingFriction, Pair>,
    Sticking<contact::UnequalBlades<contact::RigidBladeContact<contact::StickingFriction>>>>;

}  // namespace rubatlas::modes
