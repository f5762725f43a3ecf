/// Modes and resets of blades on a ring with dampers, which yields in its own time.
#pragma once

#include <utility>

#include "contact/damped_ring.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "modes/collocated_laws.hpp"
#include "modes/damped_ring.hpp"
#include "modes/modes_of_law.hpp"

namespace rubatlas::modes {

template <class Pair = integrate::DormandPrince853>
class ModesOfRigidBladesOnDampedRing final : public ModesOfLaw<contact::RigidBladeOnDampedRing, Pair> {
 public:
  using Base = ModesOfLaw<contact::RigidBladeOnDampedRing, Pair>;
  using typename Base::Law;

  ModesOfRigidBladesOnDampedRing(const ModesRequest& request, Law law) : Base(request, std::move(law)) {
    this->solved_ = this->template phase_of<DampedRing<Law>>();
    this->collocated_ = modes::collocated(request, this->law_);
  }
};

/// On the receding side a blade stands straight while the ring's load is too small to bend it.
template <class Pair = integrate::DormandPrince853>
class ModesOfElasticBladesOnDampedRing final : public ModesOfLaw<contact::ElasticBladeOnDampedRing, Pair> {
 public:
  using Base = ModesOfLaw<contact::ElasticBladeOnDampedRing, Pair>;
  using typename Base::Law;

  ModesOfElasticBladesOnDampedRing(const ModesRequest& request, Law law) : Base(request, std::move(law)) {
    this->solved_ = this->template phase_of<YieldingDampedRing<Law>>();
    this->collocated_ = modes::collocated(request, this->law_);
  }

  [[nodiscard]] bool open(const TipPlace& at, OpenContact& contact) const override {
    const auto& blade = this->blade(contact);
    const double load = blade.ring_load(0.0, blade.depth_rate(at.pose, at.speed));
    contact.straight = load < blade.bending_load(at.pose, contact.slip, at.speed);
    return true;
  }
  /// A blade that has unbent to the ring's circle stays in contact where the ring pushes it.
  [[nodiscard]] bool straightens(const TipPlace& at, OpenContact& contact) const override {
    const auto& blade = this->blade(contact);
    const double rate = blade.depth_rate(at.pose, at.speed);
    if (contact.straight || !(blade.ring_load(contact.yielding, rate) > 0.0)) return false;
    contact.straight = true;
    contact.bending = 0.0;
    return true;
  }
  [[nodiscard]] bool has_law_of_rest() const override { return false; }
};

}  // namespace rubatlas::modes
