/// The phases by collocation of the laws that have arcs, compiled once for all that ask for them.
#pragma once

#include <memory>

#include "contact/damped_ring.hpp"
#include "contact/directed_elastica.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/friction_law.hpp"
#include "contact/unequal_blades.hpp"
#include "modes/contact_modes.hpp"
#include "modes/phase.hpp"

namespace rubatlas::modes {

/// `law` outlives the phase. None where contacts are not left to collocation, and of laws whose contacts have
/// no arcs: of the column (μ = 0) that may stand straight or is on a ring with dampers, and where p has no
/// room, since friction is so large, or a blade so soft, that it is shortened beyond the table by the least
/// load.
template <class Blade>
std::unique_ptr<Phase> collocated(const ModesRequest& request, const contact::UnequalBlades<Blade>& law);

}  // namespace rubatlas::modes
