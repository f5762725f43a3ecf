#include "compared/phases_in_steps.hpp"

#include <stdexcept>

#include "compared/contact_phase.hpp"
#include "compared/damped_ring.hpp"
#include "compared/following_ring.hpp"
#include "compared/skimming.hpp"
#include "compared/solved.hpp"
#include "compared/sticking.hpp"
#include "compared/sticking_elastic.hpp"

namespace rubatlas::compared {

std::unique_ptr<Phase> phase_in_steps(Form form, const ContactSetup& setup, const integrate::Tableau& pair) {
  switch (form) {
    case Form::solved:
      return std::make_unique<ContactPhase<Solved>>(setup, pair);
    case Form::following_ring:
      return std::make_unique<ContactPhase<FollowingRing>>(setup, pair);
    case Form::damped_ring:
      return std::make_unique<ContactPhase<DampedRing>>(setup, pair);
    case Form::yielding_damped_ring:
      return std::make_unique<ContactPhase<YieldingDampedRing>>(setup, pair);
    case Form::skimming:
      return std::make_unique<ContactPhase<Skimming>>(setup, pair);
    case Form::sticking:
      return std::make_unique<ContactPhase<Sticking>>(setup, pair);
    case Form::sticking_elastic:
      return std::make_unique<ContactPhase<StickingElastic>>(setup, pair);
    case Form::resting:
      return std::make_unique<ContactPhase<Resting>>(setup, pair);
  }
  throw std::logic_error("a form of the equations that is none");
}

}  // namespace rubatlas::compared
