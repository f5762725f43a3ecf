/// The phases in contact of one motion, each made where it is first asked for.
#pragma once

#include <memory>

#include "modes/contact_setup.hpp"
#include "modes/law.hpp"
#include "modes/phase.hpp"

namespace rubatlas::modes {

class ContactPhases {
 public:
  /// What `setup` points at outlives the phases.
  ContactPhases(MakePhase* make, const ContactSetup& setup) : make_(make), setup_(setup) {}

  [[nodiscard]] Phase* slipping() { return made(slipping_, setup_.law->form(*setup_.machine), setup_); }
  /// Some tips rest.
  [[nodiscard]] Phase* sticking() {
    Phase* const own = made(sticking_, setup_.law->form_of_sticking(), setup_);
    return own != nullptr ? own : slipping();
  }
  /// Null where the phase of slipping tips is told which of them skims.
  [[nodiscard]] Phase* skimming() { return made(skimming_, Form::skimming, setup_); }
  /// Tips that always slip and come to rest where their slip reversals accumulate, under the law of
  /// `at_rest`.
  [[nodiscard]] Phase* resting(const ContactSetup& at_rest) { return made(resting_, Form::resting, at_rest); }
  [[nodiscard]] bool has_resting(const Phase* phase) const { return phase == resting_.get(); }

  /// Calls `use` with each phase that has been made.
  template <class Use>
  void each(Use use) const {
    for (const auto* phase : {&slipping_, &sticking_, &skimming_, &resting_}) {
      if (*phase != nullptr) use(**phase);
    }
  }

 private:
  Phase* made(std::unique_ptr<Phase>& phase, Form form, const ContactSetup& setup) const {
    if (phase == nullptr) phase = make_(form, setup);
    return phase.get();
  }

  MakePhase* make_;
  ContactSetup setup_;
  std::unique_ptr<Phase> slipping_;
  std::unique_ptr<Phase> sticking_;
  std::unique_ptr<Phase> skimming_;
  std::unique_ptr<Phase> resting_;
};

}  // namespace rubatlas::modes
