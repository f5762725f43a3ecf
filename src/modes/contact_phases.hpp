/// The phases in contact of a motion, and who makes them.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "modes/contact_setup.hpp"
#include "modes/open_contact.hpp"
#include "modes/phase.hpp"

namespace rubatlas::modes {

/// Those under one law.
class ContactPhases {
 public:
  ContactPhases() = default;
  ContactPhases(const ContactPhases&) = delete;
  ContactPhases& operator=(const ContactPhases&) = delete;
  virtual ~ContactPhases() = default;

  /// The one for contacts that slip, rest or skim like these.
  [[nodiscard]] virtual Phase& of(const std::vector<OpenContact>& contacts) = 0;
  /// Calls `use` with each phase that has been asked for.
  virtual void each(const std::function<void(const Phase&)>& use) const = 0;
};

/// What the setup points at outlives the phases.
using MakePhases = std::unique_ptr<ContactPhases>(const ContactSetup&);
/// By collocation (`Collocated`), which has one phase for all contacts. The law has arcs (`Law::arcs`);
/// throws `std::logic_error` where it has none.
MakePhases phases_on_arcs;

}  // namespace rubatlas::modes
