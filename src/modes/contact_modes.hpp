/// The modes in contact of one law on one machine, and who judges which of its tips rest.
///
/// A motion executes modes and resets and does not know their equations.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "collocation/inclined_law.hpp"
#include "modes/phase.hpp"
#include "modes/rest_judge.hpp"
#include "modes/rest_of_elastic_blades.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

class ContactModes : public TipPlaces {
 public:
  /// Machine and meter outlive the modes.
  ContactModes(const rotor::Machine& machine, std::unique_ptr<Law> law, const ContactLimits& limits,
               WorkMeter& meter, MakePhases* make_phases);
  ContactModes(const ContactModes&) = delete;  // phases point at their law
  ContactModes& operator=(const ContactModes&) = delete;

  [[nodiscard]] const Law& law() const { return *law_; }

  /// The one for such contacts.
  [[nodiscard]] Phase& phase_of(const std::vector<OpenContact>& contacts) {
    const bool rests = under_law_of_rest(contacts);
    std::unique_ptr<ContactPhases>& phases = rests ? resting_ : phases_;
    if (phases == nullptr)
      phases = make_phases_({machine_, rests ? &*law_of_rest_ : own_law_.get(), limits_, meter_});
    return phases->of(contacts);
  }
  /// Calls `use` with each phase that has been asked for.
  void each_phase(const auto& use) const {
    for (const auto* phases : {&phases_, &resting_}) {
      if (*phases != nullptr) (*phases)->each(use);
    }
  }

  /// Whether the blade that has just touched down, the last of these contacts, begins to skim. If so, it is
  /// the first of them from here on.
  bool begins_to_skim(const rotor::ContactState& state, std::vector<OpenContact>& contacts) const;
  /// Finds the place of a ring without mass, where its spring balances the blades in contact, and the
  /// contacts together: `touches` opens the contact of a blade that reaches into the ring at its place, and
  /// the contact of a blade that does not is closed. (The place jumps where friction reverses.) False where
  /// there is no such place, and where a tip would stick, since its friction would be another unknown (MODEL
  /// 5).
  bool place_ring(rotor::ShaftAndRing& bodies, double time, std::vector<OpenContact>& contacts,
                  const std::function<bool(int blade)>& touches) const;

  // Rest.

  /// Of tips that may rest at once where their slip velocity comes to zero; null where they do not.
  [[nodiscard]] RestJudge* rest_judge() const { return judge_.get(); }
  /// Tips that rest do so under another law, and those that slip beside them, too.
  [[nodiscard]] bool under_law_of_rest(const std::vector<OpenContact>& contacts) const {
    return law_of_rest_ && any_rests(contacts);
  }
  /// `RestJudge::let_go`, under whichever law the tip has been at rest.
  bool let_go(const rotor::ContactState& state, const std::vector<OpenContact>& contacts,
              OpenContact& contact);
  /// The limit of slip reversals that accumulate: the tip comes to rest where friction can hold it. False,
  /// and it slips on, where friction cannot hold it yet.
  bool comes_to_rest(const rotor::ContactState& state, OpenContact& contact) const {
    return law_of_rest_ && RestOfElasticBlades(machine(), *law_of_rest_).come_to_rest(contact, state);
  }
  /// A tip that has come loose and slips against s, as its velocity errs by the tolerance, would slip back to
  /// where it was: puts the shaft's velocity where v = 0.
  void set_out_from_rest(rotor::ShaftAndRing& state, const TipPlace& at, double time,
                         OpenContact contact) const;
  /// A contact under the law of tips at rest, as another motion takes it over: a tip at rest comes loose
  /// where the machine changes, and s becomes the side to which its blade is bent.
  static void leave_law_of_rest(OpenContact& contact) {
    if (contact.slip == 0.0) contact.slip = std::copysign(1.0, contact.bend.modulus);
    contact.bending = 0.0;
  }

 private:
  std::unique_ptr<Law> own_law_;
  /// Of tips that always slip, and come to rest where their slip reversals accumulate.
  std::optional<collocation::InclinedLaw> law_of_rest_;
  ContactLimits limits_;
  WorkMeter* meter_;
  MakePhases* make_phases_;
  std::unique_ptr<ContactPhases> phases_, resting_;  ///< once they are asked for
  std::unique_ptr<RestJudge> judge_;                 ///< of tips that stick
};

}  // namespace rubatlas::modes
