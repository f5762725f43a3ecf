#include "compared/phases_in_steps.hpp"

#include <algorithm>

#include "collocation/damped_law.hpp"
#include "collocation/rigid_law.hpp"
#include "compared/contact_phase.hpp"
#include "compared/damped_ring.hpp"
#include "compared/following_ring.hpp"
#include "compared/skimming.hpp"
#include "compared/solved.hpp"
#include "compared/sticking.hpp"
#include "compared/sticking_elastic.hpp"

namespace rubatlas::compared {
namespace {

/// Each form of the equations is a phase of its own.
class PhasesInSteps final : public modes::ContactPhases {
 public:
  PhasesInSteps(const ContactSetup& setup, const integrate::Tableau& pair) : setup_(setup), pair_(pair) {}

  Phase& of(const std::vector<OpenContact>& contacts) override {
    const auto* rigid = dynamic_cast<const collocation::RigidLaw*>(setup_.law);
    if (std::ranges::count(contacts, 0.0, &OpenContact::slip) > 0)
      return rigid != nullptr ? made<Sticking>(resting_) : made<StickingElastic>(resting_);
    if (std::ranges::count(contacts, true, &OpenContact::skims) > 0) return made<Skimming>(skimming_);
    if (dynamic_cast<const collocation::DampedLaw*>(setup_.law) != nullptr)
      return made<YieldingDampedRing>(slipping_);
    if (rigid != nullptr && rigid->of(0).damping() > 0.0) return made<DampedRing>(slipping_);
    if (rigid != nullptr && setup_.machine->following_ring() != nullptr)
      return made<FollowingRing>(slipping_);
    return made<Solved>(slipping_);
  }
  void each(const std::function<void(const Phase&)>& use) const override {
    for (const auto* phase : {&slipping_, &resting_, &skimming_}) {
      if (*phase != nullptr) use(**phase);
    }
  }

 private:
  template <class Mode>
  Phase& made(std::unique_ptr<Phase>& phase) {
    if (phase == nullptr) phase = std::make_unique<ContactPhase<Mode>>(setup_, pair_);
    return *phase;
  }

  ContactSetup setup_;
  integrate::Tableau pair_;
  std::unique_ptr<Phase> slipping_, resting_, skimming_;
};

}  // namespace

std::unique_ptr<modes::ContactPhases> phases_in_steps(const ContactSetup& setup,
                                                      const integrate::Tableau& pair) {
  return std::make_unique<PhasesInSteps>(setup, pair);
}

}  // namespace rubatlas::compared
