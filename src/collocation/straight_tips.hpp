/// Straight tips at rest on the ring (`contact/sticking.hpp`): those of rigid blades, and of blades that do
/// not bend.
#pragma once

#include <complex>
#include <span>

#include "collocation/tip_places.hpp"

namespace rubatlas::collocation {

class StraightTips : public TipPlaces {
 public:
  using TipPlaces::TipPlaces;
  using State = rotor::ContactState;

  /// dv/dτ of a tip under an acceleration of the shaft, seen from the ring [m per unit τ²].
  [[nodiscard]] double slip_acceleration(int blade, const State& state,
                                         const std::complex<double>& acceleration) const;
  /// Finds c of the tips at rest among all that touch: those that take away dv/dτ of each.
  void hold(const State& state, std::span<Touch> touching) const;
  /// Takes v of these blades' tips, of the first two at most, from the shaft's velocity, the shortest way.
  void bring_to_rest(std::span<const int> tips, State& state) const;

 private:
  /// Direction of the slip.
  [[nodiscard]] std::complex<double> tangent(int blade, const State& state) const;
};

}  // namespace rubatlas::collocation
