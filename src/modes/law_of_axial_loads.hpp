/// Elastic blades under an axial load, which have one unknown, the bending parameter u. Its root is looked
/// for here (MODEL 4.1 and 4.2).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "contact/elastica_contact.hpp"
#include "contact/resting_law.hpp"
#include "modes/law.hpp"

namespace rubatlas::modes {

class LawOfAxialLoads final : public LawOfBlades<LawOfAxialLoads, contact::ElasticaContact> {
 public:
  using LawOfBlades::LawOfBlades;

  bool respond(const TipPlace& at, OpenContact& contact, contact::TipForce& force) const override {
    return of(contact.blade).respond(at.pose, contact.slip, at.speed, contact.bending, force);
  }
  [[nodiscard]] Kind kind() const override {
    return {.remembers = true, .price_of_curve = WorkPrice::kCurve};
  }
  [[nodiscard]] std::uint64_t evaluations() const override { return blades().evaluations(); }
  /// The branch on which the blade stands has come to its end.
  [[nodiscard]] ModeEnd without_force(int blade) const override {
    if (has_branches(blade)) return {Guard::snap, blade};
    if (releases_at_fold(blade)) return {Guard::lift_off, blade};
    return Law::without_force(blade);
  }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;

  [[nodiscard]] bool has_branches(int blade) const override { return of(blade).has_branches(); }
  [[nodiscard]] bool releases_at_fold(int blade) const override { return of(blade).releases_at_fold(); }
  [[nodiscard]] bool ends_unloaded(const contact::Pose& at, const OpenContact& contact) const override {
    return of(contact.blade).ends_unloaded(at, contact.slip, contact.bending);
  }
  [[nodiscard]] double straight_reserve(const contact::Pose& at, const OpenContact& contact) const override {
    return of(contact.blade).straight_reserve(at, contact.slip, contact.bending);
  }
  /// A blade released at the fold returns from a finite distance, and the force of a compressed column starts
  /// from zero: neither hops without end.
  [[nodiscard]] bool may_skim(int blade) const override {
    return !releases_at_fold(blade) && !of(blade).may_stand_straight();
  }

  /// A contact opens on the approaching side from zero force, on the receding side from a finite one (MODEL
  /// 4.2).
  [[nodiscard]] bool open(const TipPlace& at, OpenContact& contact) const override;
  [[nodiscard]] Standing keep(const TipPlace& at, OpenContact& contact) const override;
  /// In the direction in which the blade moves. Where there is no next equilibrium, the blade is free if the
  /// ring opens and the undeformed tip is outside it.
  [[nodiscard]] Standing snap(const TipPlace& at, OpenContact& contact) const override;
  [[nodiscard]] bool bend_anew(const TipPlace& at, OpenContact& contact) const override;
  /// A column whose u has come to 0 while its tip is still in the ring (g > 0) stands straight from there on.
  [[nodiscard]] bool straightens(const TipPlace& at, OpenContact& contact) const override;

  /// For some elastic blades the model does not say it.
  [[nodiscard]] bool knows_rest() const override { return contact::resting_law(of(0)).has_value(); }
  [[nodiscard]] std::optional<contact::UnequalBlades<contact::DirectedElastica>> law_of_rest(
      int blade_count) const override {
    return contact::resting_law(blades(), blade_count);
  }
  [[nodiscard]] bool bends_in_u() const override { return true; }
};

}  // namespace rubatlas::modes
