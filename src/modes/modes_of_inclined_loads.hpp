/// Modes and resets of elastic blades under an inclined load, which have two unknowns, κ and φ. The mode that
/// begins finds both where a contact opens.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "contact/directed_elastica.hpp"
#include "contact/friction_law.hpp"
#include "contact/resting_law.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "modes/collocated_laws.hpp"
#include "modes/modes_of_law.hpp"
#include "modes/solved.hpp"
#include "modes/sticking_elastic.hpp"
#include "modes/tips_at_rest.hpp"
#include "modes/tips_that_stick.hpp"

namespace rubatlas::modes {

template <class Friction, class Pair = integrate::DormandPrince853>
class ModesOfInclinedLoads : public ModesOfLaw<contact::DirectedElastica<Friction>, Pair> {
 public:
  using Base = ModesOfLaw<contact::DirectedElastica<Friction>, Pair>;
  using typename Base::Law;

  ModesOfInclinedLoads(const ModesRequest& request, Law law) : Base(request, std::move(law)) {
    this->solved_ = this->template phase_of<Solved<Law>>();
    this->collocated_ = modes::collocated(request, this->law_);
  }

  /// Snaps to another equilibrium on the side to which the blade is bent, or, where there is none, to one on
  /// the other side.
  [[nodiscard]] Standing snap(const TipPlace& at, OpenContact& contact) const override {
    constexpr double kSame = 1e-3;  // of κ: a root so close to the fold is the one that ends there
    const auto& blade = this->blade(contact);
    const double modulus = contact.bend.modulus;
    const double side = std::copysign(1.0, modulus);
    auto root = blade.solve(at.pose, contact.slip, at.speed, side);
    if (root && std::abs(root->modulus - modulus) < kSame * std::abs(modulus)) root = std::nullopt;
    if (!root) root = blade.solve(at.pose, contact.slip, at.speed, -side);
    if (!root) return Standing::lost;
    contact.bend = *root;
    return Standing::stands;
  }
};

/// Under Coulomb's law, whose tips come to rest where their slip reversals accumulate.
template <class Pair = integrate::DormandPrince853>
class ModesOfInclinedCoulomb final : public ModesOfInclinedLoads<contact::CoulombFriction, Pair> {
 public:
  using Base = ModesOfInclinedLoads<contact::CoulombFriction, Pair>;
  using typename Base::Law;

  ModesOfInclinedCoulomb(const ModesRequest& request, Law law)
      : Base(request, std::move(law)),
        tips_at_rest_(*contact::resting_law(this->law_, request.machine.blades.count()), this->setup_,
                      false) {
    this->resting_ = tips_at_rest_.phase();
  }

  bool comes_to_rest(const rotor::ContactState& state, OpenContact& contact) override {
    return tips_at_rest_.comes_to_rest(state, contact);
  }
  bool let_go(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
              std::size_t contact) override {
    return tips_at_rest_.let_go(state, contacts, contact);
  }

 private:
  TipsAtRest<contact::UnequalBlades<contact::DirectedElastica<contact::StickingFriction>>, Pair>
      tips_at_rest_;
};

/// Of laws whose friction depends on the slip velocity, and has no slip reversals.
template <class Pair = integrate::DormandPrince853>
using ModesOfInclinedVelocity = ModesOfInclinedLoads<contact::VelocityFriction, Pair>;

/// Of tips that may stick.
template <class Pair = integrate::DormandPrince853>
using ModesOfStickingInclined = WithTipsThatStick<
    ModesOfInclinedLoads<contact::StickingFriction, Pair>,
    StickingElastic<contact::UnequalBlades<contact::DirectedElastica<contact::StickingFriction>>>>;

}  // namespace rubatlas::modes
