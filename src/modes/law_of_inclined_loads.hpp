/// Elastic blades under an inclined load, which have two unknowns, κ and φ. The mode that begins finds both
/// where a contact opens.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "contact/directed_elastica.hpp"
#include "contact/resting_law.hpp"
#include "modes/law.hpp"

namespace rubatlas::modes {

class LawOfInclinedLoads final : public LawOfBlades<LawOfInclinedLoads, contact::DirectedElastica> {
 public:
  /// `rests_at_once`: a tip that can rest does so where its slip velocity comes to zero, else only where its
  /// reversals accumulate (MODEL 4.4).
  explicit LawOfInclinedLoads(Blades blades, bool rests_at_once = true)
      : LawOfBlades(std::move(blades)), rests_at_once_(rests_at_once) {}

  bool respond(const TipPlace& at, OpenContact& contact, contact::TipForce& force) const override {
    return of(contact.blade)
        .respond(at.pose, contact.slip, at.speed, contact.bend.modulus, contact.bend.amplitude, force);
  }
  [[nodiscard]] Kind kind() const override {
    const contact::Friction& friction = of(0).friction();
    return {.has_slip_state = friction.has_slip_state(),
            .sticks = friction.sticks && rests_at_once_,
            .remembers = true,
            .price_of_curve = WorkPrice::kInclinedCurve,
            .searches_long = true};
  }
  [[nodiscard]] std::uint64_t evaluations() const override { return blades().evaluations(); }
  [[nodiscard]] ModeEnd without_force(int blade) const override { return {Guard::snap, blade}; }
  [[nodiscard]] std::unique_ptr<collocation::ArcLaw> arcs(const rotor::Machine& machine,
                                                          double max_shortening) const override;

  [[nodiscard]] std::unique_ptr<RestJudge> rest_judge(const ContactSetup& setup) const override;
  /// Snaps to another equilibrium on the side to which the blade is bent, or, where there is none, to one on
  /// the other side.
  [[nodiscard]] Standing snap(const TipPlace& at, OpenContact& contact) const override;
  [[nodiscard]] std::optional<contact::UnequalBlades<contact::DirectedElastica>> law_of_rest(
      int blade_count) const override {
    return contact::resting_law(blades(), blade_count);
  }

 private:
  bool rests_at_once_;
};

}  // namespace rubatlas::modes
