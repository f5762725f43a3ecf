/// What steps have to know of a kind of law besides what its arcs do.
#pragma once

#include <cstdint>

#include "collocation/axial_law.hpp"
#include "contact/pose.hpp"
#include "modes/phase.hpp"
#include "modes/work_meter.hpp"

namespace rubatlas::compared {

class KindOfLaw {
 public:
  explicit KindOfLaw(const collocation::Law& law)
      : law_(&law), axial_(dynamic_cast<const collocation::AxialLaw*>(&law)) {}

  /// The force follows from the place of the tip alone, and nothing bends.
  [[nodiscard]] bool load_follows_gap() const { return law_->is_rigid() && law_->ends_at_ring(); }
  /// The last bending says on which branch or side a blade stands.
  [[nodiscard]] bool remembers() const { return law_->leans() || axial_ != nullptr; }
  /// Of an evaluation of a blade's curve [ns].
  [[nodiscard]] std::int64_t price_of_curve() const {
    return law_->leans() ? modes::WorkPrice::kInclinedCurve : modes::WorkPrice::kCurve;
  }

  [[nodiscard]] bool has_branches() const { return axial_ != nullptr && axial_->has_branches(0); }
  /// What it means that a blade finds no force: the branch on which it stands has come to its end.
  [[nodiscard]] modes::ModeEnd without_force(int blade) const {
    if (law_->leans() || has_branches()) return {modes::Guard::snap, blade};
    if (law_->releases_at_fold(blade)) return {modes::Guard::lift_off, blade};
    return {modes::Guard::left_validity, -1, ending::StatusDetail::no_equilibrium};
  }
  /// Whether the force of a contact vanishes with the gap where its tip stands.
  [[nodiscard]] bool ends_unloaded(const contact::Pose& at, const modes::OpenContact& contact) const {
    return axial_ == nullptr || axial_->of(contact.blade).ends_unloaded(at, contact.slip, contact.bending);
  }
  /// What the straight branch of a column is short of its end on the receding side, in Euler loads. The force
  /// goes on smoothly past it, so that the end can be located. 1 where there is no such end.
  [[nodiscard]] double straight_reserve(const contact::Pose& at, const modes::OpenContact& contact) const {
    if (axial_ == nullptr || contact.bending != 0.0 || !(contact.slip * at.tangential < 0.0)) return 1.0;
    const contact::ElasticaContact& blade = axial_->of(contact.blade);
    return blade.may_stand_straight() ? 1.0 - blade.straight_load(at) / blade::kEulerLoad : 1.0;
  }

 private:
  const collocation::Law* law_;
  const collocation::AxialLaw* axial_;  ///< null: of another kind
};

}  // namespace rubatlas::compared
