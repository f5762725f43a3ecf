/// Tips that can stick: a mode for them, which also judges whether they do, beside the modes of slipping
/// tips.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "modes/contact_modes.hpp"

namespace rubatlas::modes {

/// `Slipping`: the modes of slipping tips; `Mode`: that of tips of which some stick.
template <class Slipping, class Mode>
class WithTipsThatStick final : public Slipping {
 public:
  using typename Slipping::Law;

  WithTipsThatStick(const ModesRequest& request, Law law)
      : Slipping(request, std::move(law)), judge_(this->setup_) {
    this->sticking_ = this->template phase_of<Mode>();
  }

  bool settle(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
              const ContactModes::Tell& tell) override {
    return judge_.settle(state, contacts, tell);
  }
  bool arrest(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
              std::size_t contact) override {
    return judge_.arrest(contacts, contact, state);
  }
  bool let_go(const rotor::ContactState& state, std::vector<OpenContact>& contacts,
              std::size_t contact) override {
    return judge_.let_go(contacts, contact, state);
  }

 private:
  Mode judge_;
};

}  // namespace rubatlas::modes
