/// Modes and resets of elastic blades under an axial load, which have one unknown, the bending parameter u.
/// Its root is looked for here (MODEL 4.1 and 4.2).
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "contact/elastica_contact.hpp"
#include "contact/resting_law.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "modes/collocated_laws.hpp"
#include "modes/modes_of_law.hpp"
#include "modes/skimming.hpp"
#include "modes/solved.hpp"
#include "modes/tips_at_rest.hpp"

namespace rubatlas::modes {

template <class Pair = integrate::DormandPrince853>
class ModesOfAxialLoads final : public ModesOfLaw<contact::ElasticaContact, Pair> {
 public:
  using Base = ModesOfLaw<contact::ElasticaContact, Pair>;
  using typename Base::Law;
  using LawOfRest = contact::UnequalBlades<contact::DirectedElastica<contact::StickingFriction>>;

  ModesOfAxialLoads(const ModesRequest& request, Law law)
      : Base(request, std::move(law)), skims_(this->setup_) {
    this->solved_ = this->template phase_of<Solved<Law>>();
    this->skimming_ = this->template phase_of<Skimming<Law>>();
    this->collocated_ = modes::collocated(request, this->law_);
    if (auto law_of_rest = resting_law(this->law_, request.machine.blades.count())) {
      tips_at_rest_.emplace(std::move(*law_of_rest), this->setup_, true);
      this->resting_ = tips_at_rest_->phase();
    }
  }

  /// A contact opens on the approaching side from zero force, on the receding side from a finite one (MODEL
  /// 4.2).
  [[nodiscard]] bool open(const TipPlace& at, OpenContact& contact) const override {
    const auto& blade = this->blade(contact);
    if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
        blade.starts_unloaded(at.pose, contact.slip))
      return true;
    return takes(blade.solve(at.pose, contact.slip), contact);
  }
  [[nodiscard]] Standing keep(const TipPlace& at, OpenContact& contact) const override {
    const auto& blade = this->blade(contact);
    const bool outside = at.pose.gap <= 0.0;
    if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
        blade.ends_unloaded(at.pose, contact.slip, contact.bending)) {
      contact.bending = 0.0;
      return outside ? Standing::free : Standing::stands;
    }
    if (outside && !blade.releases_at_fold()) return Standing::free;
    const bool found =
        contact.bending > 0.0 ? follow(at, contact) : takes(blade.solve(at.pose, contact.slip), contact);
    if (found) return Standing::stands;
    return outside ? Standing::free : Standing::lost;
  }
  /// On its branch, or on the next one where a change of the blade or of its speed, or rounding next to a
  /// fold, has taken it past the end.
  [[nodiscard]] bool follow(const TipPlace& at, OpenContact& contact) const override {
    const auto& blade = this->blade(contact);
    auto root = blade.solve_near(at.pose, contact.slip, contact.bending);
    if (!root && blade.has_branches()) root = blade.snap(at.pose, contact.slip, contact.bending, at.speed);
    return takes(root, contact);
  }
  /// In the direction in which the blade moves. Where there is no next equilibrium, the blade is free if the
  /// ring opens and the undeformed tip is outside it.
  [[nodiscard]] Standing snap(const TipPlace& at, OpenContact& contact) const override {
    const auto& blade = this->blade(contact);
    if (takes(blade.snap(at.pose, contact.slip, contact.bending, at.speed), contact)) return Standing::stands;
    const bool free =
        at.pose.gap <= 0.0 && !blade.closes_in(at.pose, contact.slip, contact.bending, at.speed);
    return free ? Standing::free : Standing::lost;
  }
  [[nodiscard]] bool bend_anew(const TipPlace& at, OpenContact& contact) const override {
    const auto root = this->blade(contact).solve(at.pose, contact.slip);
    contact.bending = root.value_or(0.0);
    return root.has_value();
  }
  /// A column whose u has come to 0 while its tip is still in the ring (g > 0) stands straight from there on.
  [[nodiscard]] bool straightens(const TipPlace& at, OpenContact& contact) const override {
    const auto& blade = this->blade(contact);
    if (!blade.may_stand_straight() || at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose))
      return false;
    contact.bending = 0.0;
    return true;
  }

  [[nodiscard]] bool releases_at_fold(int blade) const override {
    return this->law_.of(blade).releases_at_fold();
  }
  /// A blade released at the fold returns from a finite distance, and the force of a compressed column starts
  /// from zero: neither hops without end.
  [[nodiscard]] bool begins_to_skim(const rotor::ContactState& state,
                                    const std::vector<OpenContact>& contacts, double hop) const override {
    const auto& blade = this->blade(contacts.front());
    return !blade.releases_at_fold() && !blade.may_stand_straight() && skims_.begins(state, contacts, hop);
  }

  /// For some elastic blades the model does not say it.
  [[nodiscard]] bool has_law_of_rest() const override { return tips_at_rest_.has_value(); }
  bool comes_to_rest(const rotor::ContactState& state, OpenContact& contact) override {
    return tips_at_rest_->comes_to_rest(state, contact);
  }
  bool let_go(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
              std::size_t contact) override {
    return tips_at_rest_->let_go(state, contacts, contact);
  }
  [[nodiscard]] std::vector<OpenContact> at_rest(const std::vector<OpenContact>& contacts) const override {
    return tips_at_rest_->at_rest(contacts);
  }
  void leave_law_of_rest(OpenContact& contact) const override {
    Base::leave_law_of_rest(contact);
    contact.bending = 0.0;
  }

 private:
  static bool takes(const std::optional<double>& root, OpenContact& contact) {
    if (root) contact.bending = *root;
    return root.has_value();
  }
  Skimming<Law> skims_;
  std::optional<TipsAtRest<LawOfRest, Pair>> tips_at_rest_;
};

}  // namespace rubatlas::modes
