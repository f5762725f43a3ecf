/// The phases in steps of a Runge–Kutta pair.
#pragma once

#include <memory>
#include <stdexcept>

#include "compared/contact_phase.hpp"
#include "compared/damped_ring.hpp"
#include "compared/following_ring.hpp"
#include "compared/skimming.hpp"
#include "compared/solved.hpp"
#include "compared/sticking.hpp"
#include "compared/sticking_elastic.hpp"
#include "modes/contact_setup.hpp"

namespace rubatlas::compared {

/// A `MakePhase`.
template <class Pair>
std::unique_ptr<Phase> phase_in_steps(Form form, const ContactSetup& setup) {
  switch (form) {
    case Form::solved:
      return std::make_unique<ContactPhase<Solved, Pair>>(setup);
    case Form::following_ring:
      return std::make_unique<ContactPhase<FollowingRing, Pair>>(setup);
    case Form::damped_ring:
      return std::make_unique<ContactPhase<DampedRing, Pair>>(setup);
    case Form::yielding_damped_ring:
      return std::make_unique<ContactPhase<YieldingDampedRing, Pair>>(setup);
    case Form::skimming:
      return std::make_unique<ContactPhase<Skimming, Pair>>(setup);
    case Form::sticking:
      return std::make_unique<ContactPhase<Sticking, Pair>>(setup);
    case Form::sticking_elastic:
      return std::make_unique<ContactPhase<StickingElastic, Pair>>(setup);
    case Form::resting:
      return std::make_unique<ContactPhase<Resting, Pair>>(setup);
  }
  throw std::logic_error("a form of the equations that is none");
}

}  // namespace rubatlas::compared
