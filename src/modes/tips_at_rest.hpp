/// Tips that always slip and come to rest where their slip reversals accumulate, under another law
/// (`contact/resting_law.hpp`): a part of the modes of elastic blades.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "modes/contact_phase.hpp"
#include "modes/sticking_elastic.hpp"

namespace rubatlas::modes {

template <class Law, class Pair>
class TipsAtRest {
 public:
  /// `like`: what the modes of the slipping tips are made from. `slips_in_bending`: while a tip slips its
  /// blade has the unknown u, and κ and φ are to be found anew.
  template <class OtherSetup>
  TipsAtRest(Law law, const OtherSetup& like, bool slips_in_bending)
      : law_(std::move(law)),
        setup_{like.machine, &law_, like.limits, like.meter},
        judge_(setup_),
        slips_in_bending_(slips_in_bending) {}
  TipsAtRest(const TipsAtRest&) = delete;  // the judge points at the law
  TipsAtRest& operator=(const TipsAtRest&) = delete;

  [[nodiscard]] std::unique_ptr<Phase> phase() const {
    return std::make_unique<ContactPhase<Resting<Law>, Pair>>(setup_);
  }
  /// The functions of `ContactModes` of these names.
  bool comes_to_rest(const rotor::ContactState& state, OpenContact& contact) const {
    OpenContact there = in_own_unknowns(contact);
    if (!judge_.come_to_rest(there, state)) return false;
    contact = there;
    return true;
  }
  bool let_go(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
              std::size_t contact) const {
    std::vector<OpenContact> there = at_rest(contacts);
    judge_.let_go(there, contact, state);
    OpenContact& loose = contacts[contact];
    loose = {loose.blade, there[contact].slip, loose.bending, loose.bend};
    return true;
  }
  [[nodiscard]] std::vector<OpenContact> at_rest(const std::vector<OpenContact>& contacts) const {
    std::vector<OpenContact> there = contacts;
    for (OpenContact& contact : there) contact = in_own_unknowns(contact);
    return there;
  }

 private:
  [[nodiscard]] OpenContact in_own_unknowns(OpenContact contact) const {
    if (slips_in_bending_ && contact.slip != 0.0) contact.bend = {};
    return contact;
  }

  Law law_;
  ContactSetup<Law> setup_;
  Resting<Law> judge_;
  bool slips_in_bending_;
};

}  // namespace rubatlas::modes
