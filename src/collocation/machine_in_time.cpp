#include "collocation/machine_in_time.hpp"

#include <algorithm>
#include <cmath>

namespace rubatlas::collocation {

MachineInTime::MachineInTime(const rotor::Machine& machine, double ring_radius)
    : blades_(&machine.blades),
      numbers_{.speed_ratio = machine.constants.speed_ratio,
               .damping_ratio = machine.constants.damping_ratio,
               .misalignment = machine.constants.misalignment,
               .ring_radius = ring_radius,
               .force_unit = machine.constants.force_unit} {
  const auto add = [&](double amplitude, double phase, double frequency) {
    terms_.push_back({amplitude, phase});
    numbers_.frequency.at(numbers_.forcing_count++) = frequency;
  };
  if (const rotor::SupportedShaft* supported = machine.supported()) {
    const rotor::LinearSupport& support = supported->support;
    const auto by_rows = [](const Eigen::Matrix2d& matrix) {
      return std::array{matrix(0, 0), matrix(0, 1), matrix(1, 0), matrix(1, 1)};
    };
    numbers_.support = {false, by_rows(support.stiffness()), by_rows(support.damping())};
    for (const rotor::HarmonicForcing& term : support.terms())
      add(std::abs(term.amplitude), std::arg(term.amplitude), term.frequency);
  } else {
    for (const rotor::Harmonic& term : machine.harmonics()->terms())
      add(term.amplitude(), term.phase(), term.frequency());
  }
  const rotor::BladeSet& blades = machine.blades;
  if (blades.ripples())
    numbers_.ripple = {blades.ripple_amplitude(), blades.ripple_frequency(), blades.ripple_depth()};
  if (const rotor::RingBody* ring = machine.ring_body()) {
    const double frequency = ring->frequency();
    numbers_.ring = {true, frequency * frequency, 2.0 * ring->damping_ratio() * frequency,
                     ring->force_unit()};
  }
  if (const rotor::FollowingRing* ring = machine.following_ring())
    numbers_.ring = {.moves = true, .spring = ring->stiffness};
  double fastest = std::max(blades.speed_bound(), std::abs(numbers_.ripple.frequency));
  for (std::size_t j = 0; j < numbers_.forcing_count; ++j)
    fastest = std::max(fastest, std::abs(numbers_.frequency[j]));
  longest_interval_ = kFarthestTurn / fastest;
}

std::complex<double> MachineInTime::forcing(double time) const {
  std::complex<double> sum;
  for (std::size_t j = 0; j < numbers_.forcing_count; ++j) sum += term(j, time);
  return sum;
}

void MachineInTime::start(Interval& interval) const {
  const double time = interval.start_time;
  interval.start_angular_speed = blades_->angular_speed(time);
  for (std::size_t j = 0; j < numbers_.forcing_count; ++j) {
    const std::complex<double> there = term(j, time);
    interval.forcing[j] = {there.real(), there.imag()};
  }
  if (numbers_.ripples()) {
    const contact::BladeDirection ripple = blades_->ripple(time);
    interval.ripple = {ripple.cosine, ripple.sine};
  }
}

}  // namespace rubatlas::collocation
