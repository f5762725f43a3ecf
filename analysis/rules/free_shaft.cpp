#include "analysis/rules/free_shaft.hpp"

#include <algorithm>
#include <numbers>

namespace rubatlas::analysis {
namespace {

using Complex = FreeShaft::Complex;

Complex deflection_of(const settings::Scene& line) {
  const double frequency = line.rotor.natural_frequency;
  const double stiffness = line.rotor.mass * frequency * frequency;
  Complex sum = 0.0;
  if (line.gravity) sum += line.gravity->deflection(stiffness, frequency);
  if (line.side_load) sum += line.side_load->deflection(stiffness, frequency);
  return sum;
}

/// Z [m]: the point at phase 0 of the circle on which an unbalance drives the shaft.
Complex circle_of(const settings::Scene& line, double speed) {
  if (!line.unbalance) return 0.0;
  const Complex detuning(1.0 - speed * speed, 2.0 * line.rotor.damping_ratio * speed);
  return std::polar(line.unbalance->moment / line.rotor.mass, line.unbalance->phase) * speed * speed /
         detuning;
}

/// The tips are on circles round f, as seen from the ring's centre at −i y0.
double distance_of(const settings::Scene& line, Complex deflection, Complex circle) {
  const double reach = line.blades.hub_radius + line.blades.length;
  double farthest = 0.0;
  for (int blade = 0; blade < line.blades.count; ++blade) {
    const double angle = 2.0 * std::numbers::pi * blade / line.blades.count;
    farthest = std::max(farthest, std::abs(circle + std::polar(reach, angle)));
  }
  return line.ring.radius - farthest - std::abs(deflection + Complex(0.0, line.rotor.misalignment));
}

}  // namespace

FreeShaft::FreeShaft(const settings::Scene& line, double speed_ratio)
    : speed_ratio_(speed_ratio),
      damping_ratio_(line.rotor.damping_ratio),
      revolution_(rotor::FreeMotion(damping_ratio_).kernel(2.0 * std::numbers::pi / speed_ratio)),
      deflection_(deflection_of(line)),
      circle_(circle_of(line, speed_ratio)),
      distance_(distance_of(line, deflection_, circle_)) {}

bool FreeShaft::describes(const settings::Scene& line) {
  using effects::Effects;
  return !effects::acts<&Effects::support>(line) && !effects::acts<&Effects::speed_ripple>(line) &&
         !effects::acts<&Effects::speed_ramp>(line);
}

FreeShaft::Vibration FreeShaft::vibration(std::span<const double> section) const {
  return {Complex(section[0], section[1]) - deflection_ - circle_,
          Complex(section[2], section[3]) - Complex(0.0, speed_ratio_) * circle_};
}

FreeShaft::Vibration FreeShaft::later(const Vibration& now) const {
  using Motion = rotor::FreeMotion;
  return {Motion::position(revolution_, damping_ratio_, now.position, now.velocity),
          Motion::velocity(revolution_, damping_ratio_, now.position, now.velocity)};
}

}  // namespace rubatlas::analysis
