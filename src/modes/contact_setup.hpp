/// What the modes of one motion share, and who makes their phases.
#pragma once

#include <memory>

#include "modes/contact_limits.hpp"
#include "modes/law.hpp"
#include "modes/phase.hpp"
#include "modes/work_meter.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

/// All of it outlives the modes.
struct ContactSetup {
  const rotor::Machine* machine;
  const Law* law;
  ContactLimits limits;
  WorkMeter* meter;
};

/// Null where the phase of slipping tips is for this form, too.
using MakePhase = std::unique_ptr<Phase>(Form, const ContactSetup&);
/// By collocation (`Collocated`), which has one form for all. The law has arcs (`Law::arcs`); throws
/// `std::logic_error` where it has none.
MakePhase phase_on_arcs;

}  // namespace rubatlas::modes
