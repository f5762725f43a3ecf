/// Tips that always slip and come to rest where their slip reversals accumulate, under another law
/// (`contact/resting_law.hpp`).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "modes/contact_setup.hpp"
#include "modes/law_of_inclined_loads.hpp"
#include "modes/rest_of_elastic_blades.hpp"

namespace rubatlas::modes {

class TipsAtRest {
 public:
  /// `slipping`: what the modes of the slipping tips are made from.
  TipsAtRest(LawOfInclinedLoads::Blades law, const ContactSetup& slipping)
      : law_(std::move(law), false),
        setup_{slipping.machine, &law_, slipping.limits, slipping.meter},
        judge_(setup_),
        slips_in_u_(slipping.law->bends_in_u()) {}
  TipsAtRest(const TipsAtRest&) = delete;  // the judge points at the law
  TipsAtRest& operator=(const TipsAtRest&) = delete;

  [[nodiscard]] const ContactSetup& setup() const { return setup_; }
  /// The functions of `ContactModes` of these names.
  bool comes_to_rest(const rotor::ContactState& state, OpenContact& contact) const {
    OpenContact there = in_own_unknowns(contact);
    if (!judge_.come_to_rest(there, state)) return false;
    contact = there;
    return true;
  }
  void let_go(const rotor::ContactState& state, OpenContact& loose) const {
    OpenContact there = in_own_unknowns(loose);
    judge_.leave_rest(there, state);
    loose = {loose.blade, there.slip, loose.bending, loose.bend};
  }
  [[nodiscard]] std::vector<OpenContact> at_rest(const std::vector<OpenContact>& contacts) const {
    std::vector<OpenContact> there = contacts;
    for (OpenContact& contact : there) contact = in_own_unknowns(contact);
    return there;
  }

 private:
  [[nodiscard]] OpenContact in_own_unknowns(OpenContact contact) const {
    if (slips_in_u_ && contact.slip != 0.0) contact.bend = {};
    return contact;
  }

  LawOfInclinedLoads law_;
  ContactSetup setup_;
  RestOfElasticBlades judge_;
  bool slips_in_u_;
};

}  // namespace rubatlas::modes
