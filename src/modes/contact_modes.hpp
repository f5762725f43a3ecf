/// The modes in contact of one law on one machine, and who judges which of its tips rest.
///
/// A motion executes modes and resets and does not know their equations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "modes/contact_limits.hpp"
#include "modes/contact_phases.hpp"
#include "modes/contact_setup.hpp"
#include "modes/law.hpp"
#include "modes/open_contact.hpp"
#include "modes/phase.hpp"
#include "modes/rest_judge.hpp"
#include "modes/ring_placer.hpp"
#include "modes/skimming_judge.hpp"
#include "modes/tips_at_rest.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

/// What the modes of a motion are made for.
struct ModesRequest {
  const rotor::Machine& machine;  ///< outlives the modes, as the meter does
  ContactLimits limits;
  WorkMeter& meter;
  MakePhases* make_phases;
};

class ContactModes {
 public:
  ContactModes(const ModesRequest& request, std::unique_ptr<Law> law);
  ContactModes(const ContactModes&) = delete;  // phases point at their law
  ContactModes& operator=(const ContactModes&) = delete;

  [[nodiscard]] const Law& law() const { return *law_; }

  [[nodiscard]] ContactPhases& phases() { return made(phases_, setup_); }
  /// Those under the law of rest.
  [[nodiscard]] ContactPhases& resting() { return made(resting_, tips_at_rest_->setup()); }
  /// Calls `use` with each phase that has been asked for.
  template <class Use>
  void each_phase(Use use) const {
    for (const auto* phases : {&phases_, &resting_}) {
      if (*phases != nullptr) (*phases)->each(use);
    }
  }

  /// Price of the searches for equilibria since the last phase or call; nothing where they are short [ns].
  std::int64_t price_of_searches();
  /// A phase has paid for its own.
  void searches_are_paid() { paid_evaluations_ = law_->evaluations(); }

  /// Whether the first of these blades, which has just touched down, begins to skim: it would hop at most
  /// `hop` [m] high, and return.
  [[nodiscard]] bool begins_to_skim(const rotor::ContactState& state,
                                    const std::vector<OpenContact>& contacts, double hop) const;

  // Rest.

  /// A tip whose slip velocity comes to zero may rest at once.
  [[nodiscard]] bool tips_stick() const { return judge_ != nullptr; }
  /// Tips that rest do so under another law.
  [[nodiscard]] bool has_law_of_rest() const { return tips_at_rest_.has_value(); }
  /// The functions of `RestJudge` of these names; where no tip can rest there is nothing to judge.
  bool settle(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
              const RestJudge::Tell& tell) {
    return !judge_ || judge_->settle(state, contacts, tell);
  }
  bool arrest(const rotor::ContactState& state, std::vector<OpenContact>& contacts, std::size_t contact) {
    return judge_ && judge_->arrest(state, contacts, contact);
  }
  bool let_go(const rotor::ContactState& state, std::vector<OpenContact>& contacts, std::size_t contact) {
    if (!tips_at_rest_) return judge_ && judge_->let_go(state, contacts, contact);
    tips_at_rest_->let_go(state, contacts[contact]);
    return true;
  }
  /// The limit of slip reversals that accumulate: the tip comes to rest where friction can hold it. False,
  /// and nothing changed, where friction cannot hold it yet.
  bool comes_to_rest(const rotor::ContactState& state, OpenContact& contact) {
    return tips_at_rest_ && tips_at_rest_->comes_to_rest(state, contact);
  }
  /// Contacts in the unknowns of the law of tips at rest.
  [[nodiscard]] std::vector<OpenContact> at_rest(const std::vector<OpenContact>& contacts) const {
    return tips_at_rest_ ? tips_at_rest_->at_rest(contacts) : contacts;
  }
  /// A tip that has come loose and slips against s, as its velocity errs by the tolerance, would slip back to
  /// where it was: puts the shaft's velocity where v = 0.
  void set_out_from_rest(rotor::ShaftAndRing& state, double time, OpenContact contact) const;
  /// A contact under the law of tips at rest, as another motion takes it over: a tip at rest comes loose
  /// where the machine changes, and s becomes the side to which its blade is bent.
  void leave_law_of_rest(OpenContact& contact) const;

  // A ring without mass.

  /// `RingPlacer::settle`.
  bool place_ring(rotor::ShaftAndRing& state, double time, std::vector<OpenContact>& contacts,
                  const RingPlacer::Touches& touches) const {
    return !ring_placer_ || ring_placer_->settle(state, time, contacts, touches);
  }

 private:
  ContactPhases& made(std::unique_ptr<ContactPhases>& phases, const ContactSetup& setup) const {
    if (phases == nullptr) phases = make_phases_(setup);
    return *phases;
  }

  std::unique_ptr<Law> law_;
  ContactSetup setup_;
  std::uint64_t paid_evaluations_ = 0;  ///< of curves, whose price has been told
  MakePhases* make_phases_;
  std::unique_ptr<ContactPhases> phases_, resting_;  ///< once they are asked for
  std::unique_ptr<RestJudge> judge_;                 ///< of tips that stick
  std::optional<TipsAtRest> tips_at_rest_;           ///< of those that rest because reversals accumulate
  std::optional<SkimmingJudge> skimming_judge_;
  std::optional<RingPlacer> ring_placer_;  ///< of a ring without mass
};

}  // namespace rubatlas::modes
