/// Where the ring without mass or dampers stands: where its spring balances the blades in contact.
#pragma once

#include <functional>
#include <vector>

#include "modes/rest_judge.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

class RingPlacer : public TipPlaces {
 public:
  using State = rotor::ContactState;
  using Touches = std::function<bool(int blade)>;
  using TipPlaces::TipPlaces;

  /// Puts the ring of a state where its spring balances these contacts. False where there is no such place
  /// (MODEL 5).
  bool place(State& state, const std::vector<OpenContact>& contacts) const;
  /// Finds the ring's place and the contacts together: `touches` opens the contact of a blade that reaches
  /// into the ring at its place, and the contact of a blade that does not is closed. (The place jumps where
  /// friction reverses.) False also where a tip would stick, since its friction would be another unknown
  /// (MODEL 5).
  bool settle(rotor::ShaftAndRing& bodies, double time, std::vector<OpenContact>& contacts,
              const Touches& touches) const;
};

}  // namespace rubatlas::modes
