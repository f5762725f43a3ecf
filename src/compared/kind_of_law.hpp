/// What steps have to know of a kind of law. Collocation asks the law of its arcs
/// (`collocation/arc_law.hpp`).
#pragma once

#include <cstdint>

#include "contact/pose.hpp"
#include "modes/laws.hpp"
#include "modes/phase.hpp"
#include "modes/work_meter.hpp"

namespace rubatlas::compared {

class KindOfLaw {
 public:
  explicit KindOfLaw(const modes::Law& law)
      : rigid_(dynamic_cast<const modes::LawOfRigidBlades*>(&law)),
        inclined_(dynamic_cast<const modes::LawOfInclinedLoads*>(&law)),
        axial_(dynamic_cast<const modes::LawOfAxialLoads*>(&law)) {}

  /// Friction takes its sign from s, so that a slip reversal is an event.
  [[nodiscard]] bool has_slip_state() const {
    if (rigid_ != nullptr) return rigid_->of(0).friction().has_slip_state();
    return inclined_ == nullptr || inclined_->of(0).friction().has_slip_state();
  }
  /// A tip whose slip velocity comes to zero may rest at once (MODEL 7.14).
  [[nodiscard]] bool sticks() const {
    return rigid_ != nullptr ? rigid_->sticks() : inclined_ != nullptr && inclined_->sticks();
  }
  /// The force follows from the place of the tip alone, and nothing bends.
  [[nodiscard]] bool load_follows_gap() const { return rigid_ != nullptr && rigid_->of(0).damping() == 0.0; }
  /// The last bending says on which branch or side a blade stands.
  [[nodiscard]] bool remembers() const { return inclined_ != nullptr || axial_ != nullptr; }
  /// Of an evaluation of a blade's curve [ns].
  [[nodiscard]] std::int64_t price_of_curve() const {
    return inclined_ != nullptr ? modes::WorkPrice::kInclinedCurve : modes::WorkPrice::kCurve;
  }

  [[nodiscard]] bool has_branches() const { return axial_ != nullptr && axial_->of(0).has_branches(); }
  /// What it means that a blade finds no force: the branch on which it stands has come to its end.
  [[nodiscard]] modes::ModeEnd without_force(int blade) const {
    if (inclined_ != nullptr || has_branches()) return {modes::Guard::snap, blade};
    if (axial_ != nullptr && axial_->releases_at_fold(blade)) return {modes::Guard::lift_off, blade};
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
  // The one of these that it is.
  const modes::LawOfRigidBlades* rigid_;
  const modes::LawOfInclinedLoads* inclined_;
  const modes::LawOfAxialLoads* axial_;
};

}  // namespace rubatlas::compared
