/// Straight tips at rest on the ring (`contact/sticking.hpp`): those of rigid blades, and of blades that do
/// not bend.
#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <span>

#include "collocation/tip_places.hpp"
#include "contact/sticking.hpp"

namespace rubatlas::collocation {

class StraightTips : public TipPlaces {
 public:
  using TipPlaces::TipPlaces;
  using State = rotor::ContactState;

  /// dv/dτ of a tip under an acceleration of the shaft, seen from the ring [m per unit τ²].
  [[nodiscard]] double slip_acceleration(int blade, const State& state,
                                         const std::complex<double>& acceleration) const {
    const contact::BladeDirection er = direction(blade, state);
    const contact::Geometry& geometry = law_->geometry(blade);
    const std::complex<double> seen = acceleration * std::complex<double>(er.cosine, -er.sine);
    // The hub's own angular acceleration moves the tip across the blade.
    const double turning = geometry.reach * blades().angular_acceleration(state[rotor::kTime]);
    return contact::slip_acceleration(geometry, pose(blade, state), angular_speed(state),
                                      {seen.real(), seen.imag() + turning});
  }
  /// Finds c of the tips at rest among all that touch: those that take away dv/dτ of each.
  void hold(const State& state, std::span<Touch> touching) const {
    std::complex<double> sum;
    std::array<Touch*, contact::kMostAtRest> touches{};
    std::array<double, contact::kMostAtRest> loads{};  // F [N]
    std::size_t count = 0;
    for (Touch& touch : touching) {
      touch.holding = 0.0;
      const contact::TipForce force = law_->force(touch, tip_place(touch.blade, state));
      sum += contact::on_rotor(force, direction(touch.blade, state));
      if (touch.slip != 0.0 || count == contact::kMostAtRest) continue;
      touches[count] = &touch;
      loads[count++] = force.normal;
    }
    const std::complex<double> acceleration = machine().acceleration(state, sum).shaft;
    std::array<contact::AtRest, contact::kMostAtRest> tips{};
    for (std::size_t i = 0; i < count; ++i)
      tips[i] = {tangent(touches[i]->blade, state),
                 slip_acceleration(touches[i]->blade, state, acceleration)};
    contact::share_out(std::span(tips).first(count));
    for (std::size_t i = 0; i < count; ++i)
      touches[i]->holding = tips[i].pull / (loads[i] * rotor().force_unit);
  }
  /// Takes v of these blades' tips, of the first two at most, from the shaft's velocity, the shortest way.
  void bring_to_rest(std::span<const int> tips, State& state) const {
    std::array<contact::AtRest, contact::kMostAtRest> at_rest{};
    const std::size_t count = std::min(tips.size(), at_rest.size());
    for (std::size_t i = 0; i < count; ++i)
      at_rest[i] = {tangent(tips[i], state),
                    contact::undeformed_slip_velocity(law_->geometry(tips[i]), pose(tips[i], state),
                                                      angular_speed(state))};
    contact::share_out(std::span(at_rest).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      state[2] -= at_rest[i].pull * at_rest[i].tangent.real();
      state[3] -= at_rest[i].pull * at_rest[i].tangent.imag();
    }
  }

 private:
  /// Direction of the slip.
  [[nodiscard]] std::complex<double> tangent(int blade, const State& state) const {
    const contact::BladeDirection er = direction(blade, state);
    return contact::tangent(law_->geometry(blade), pose(blade, state)) *
           std::complex<double>(er.cosine, er.sine);
  }
};

}  // namespace rubatlas::collocation
