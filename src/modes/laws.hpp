/// The kinds of law: rigid blades, and elastic ones under an axial load, under an inclined one, and on a ring
/// with dampers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "contact/damped_ring.hpp"
#include "contact/directed_elastica.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "modes/law.hpp"

namespace rubatlas::modes {

/// Rigid blades on an elastic ring, whose force follows from the gap: on a ring that yields under each tip,
/// with a damper or without, or that has no mass and stands where all blades push it.
class LawOfRigidBlades final : public LawOfBlades<LawOfRigidBlades, contact::ElasticRingContact> {
 public:
  using LawOfBlades::LawOfBlades;

  bool respond(const TipPlace& at, OpenContact& contact, contact::TipForce& force) const override {
    force = of(contact.blade).force(at.pose, contact.slip, at.speed);
    return true;
  }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;
  [[nodiscard]] std::unique_ptr<RestJudge> rest_judge(const ContactSetup& setup) const override;
  [[nodiscard]] bool knows_rest() const override { return true; }
  [[nodiscard]] bool sticks() const { return of(0).friction().sticks; }
};

/// Elastic blades on a ring with dampers, which yields in its own time. On the receding side a blade stands
/// straight while the ring's load is too small to bend it.
class LawOfDampedRing final : public LawOfBlades<LawOfDampedRing, contact::ElasticBladeOnDampedRing> {
 public:
  using LawOfBlades::LawOfBlades;

  [[nodiscard]] bool lifts_off_inside() const override { return true; }
  [[nodiscard]] std::uint64_t evaluations() const override { return blades().evaluations(); }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;

  [[nodiscard]] bool open(const TipPlace& at, OpenContact& contact) const override;
  /// A blade that has unbent to the ring's circle stays in contact where the ring pushes it.
  [[nodiscard]] bool straightens(const TipPlace& at, OpenContact& contact) const override;
};

/// Elastic blades under an inclined load, which have two unknowns, κ and φ. The mode that begins finds both
/// where a contact opens.
class LawOfInclinedLoads final : public LawOfBlades<LawOfInclinedLoads, contact::DirectedElastica> {
 public:
  /// `rests_at_once`: a tip that can rest does so where its slip velocity comes to zero, else only where its
  /// reversals accumulate (MODEL 4.4).
  explicit LawOfInclinedLoads(Blades blades, bool rests_at_once = true)
      : LawOfBlades(std::move(blades)), rests_at_once_(rests_at_once) {}

  bool respond(const TipPlace& at, OpenContact& contact, contact::TipForce& force) const override {
    return of(contact.blade).respond(at.pose, contact.slip, at.speed, contact.bend, force);
  }
  /// A tip whose slip velocity comes to zero may rest at once (MODEL 7.14).
  [[nodiscard]] bool sticks() const { return of(0).friction().sticks && rests_at_once_; }
  [[nodiscard]] bool searches_long() const override { return true; }
  [[nodiscard]] std::uint64_t evaluations() const override { return blades().evaluations(); }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;

  [[nodiscard]] std::unique_ptr<RestJudge> rest_judge(const ContactSetup& setup) const override;
  /// Snaps to another equilibrium on the side to which the blade is bent, or, where there is none, to one on
  /// the other side.
  [[nodiscard]] Standing snap(const TipPlace& at, OpenContact& contact) const override;
  [[nodiscard]] std::optional<contact::DirectedElastica> law_of_rest(int blade) const override;

 private:
  bool rests_at_once_;
};

/// Elastic blades under an axial load, which have one unknown, the bending parameter u. Its root is looked
/// for here (MODEL 4.1 and 4.2).
class LawOfAxialLoads final : public LawOfBlades<LawOfAxialLoads, contact::ElasticaContact> {
 public:
  using LawOfBlades::LawOfBlades;

  bool respond(const TipPlace& at, OpenContact& contact, contact::TipForce& force) const override {
    return of(contact.blade).respond(at.pose, contact.slip, at.speed, contact.bending, force);
  }
  [[nodiscard]] std::uint64_t evaluations() const override { return blades().evaluations(); }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;

  [[nodiscard]] bool releases_at_fold(int blade) const override { return of(blade).releases_at_fold(); }
  /// A blade released at the fold returns from a finite distance, and the force of a compressed column starts
  /// from zero: neither hops without end.
  [[nodiscard]] bool may_skim() const override { return !releases_at_fold(0) && !of(0).may_stand_straight(); }

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

  [[nodiscard]] std::optional<contact::DirectedElastica> law_of_rest(int blade) const override;
};

}  // namespace rubatlas::modes
