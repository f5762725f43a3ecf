#include "collocation/straight_tips.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "contact/sticking.hpp"

namespace rubatlas::collocation {

double StraightTips::slip_acceleration(int blade, const State& state,
                                       const std::complex<double>& acceleration) const {
  const contact::BladeDirection er = direction(blade, state);
  const contact::Geometry& geometry = law_->geometry(blade);
  const std::complex<double> seen = acceleration * std::complex<double>(er.cosine, -er.sine);
  // The hub's own angular acceleration moves the tip across the blade.
  const double turning = geometry.reach * blades().angular_acceleration(state[rotor::kTime]);
  return contact::slip_acceleration(geometry, pose(blade, state), angular_speed(state),
                                    {seen.real(), seen.imag() + turning});
}

std::complex<double> StraightTips::tangent(int blade, const State& state) const {
  const contact::BladeDirection er = direction(blade, state);
  return contact::tangent(law_->geometry(blade), pose(blade, state)) *
         std::complex<double>(er.cosine, er.sine);
}

void StraightTips::hold(const State& state, std::span<Touch> touching) const {
  const auto force = [&](const Touch& touch) { return law_->force(touch, tip_place(touch.blade, state)); };
  std::complex<double> sum;
  for (Touch& touch : touching) {
    touch.holding = 0.0;
    sum += contact::on_rotor(force(touch), direction(touch.blade, state));
  }
  const std::complex<double> acceleration = machine().acceleration(state, sum).shaft;
  std::array<contact::AtRest, contact::kMostAtRest> tips{};
  std::array<Touch*, contact::kMostAtRest> touches{};
  std::size_t count = 0;
  for (Touch& touch : touching) {
    if (touch.slip != 0.0 || count == contact::kMostAtRest) continue;
    touches[count] = &touch;
    tips[count++] = {tangent(touch.blade, state), slip_acceleration(touch.blade, state, acceleration)};
  }
  contact::share_out(std::span(tips).first(count));
  for (std::size_t i = 0; i < count; ++i)
    touches[i]->holding = tips[i].pull / (force(*touches[i]).normal * rotor().force_unit);
}

void StraightTips::bring_to_rest(std::span<const int> tips, State& state) const {
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

}  // namespace rubatlas::collocation
