#include "analysis/rules/free_shaft.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "analysis/rules/scene_tolerances.hpp"
#include "analysis/rules/starts.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"
#include "settings/quantity.hpp"

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
  if (!effects::acts<&effects::Effects::unbalance>(line)) return 0.0;
  const Complex detuning(1.0 - speed * speed, 2.0 * line.rotor.damping_ratio * speed);
  return std::polar(line.unbalance->moment / line.rotor.mass, line.unbalance->phase) * speed * speed /
         detuning;
}

/// Radius of the ring less that of the outermost tip's circle round f [m].
double room_of(const settings::Scene& line, Complex circle) {
  const double reach = line.blades.hub_radius + line.blades.length;
  const auto errors = line.unequal_blades.value_or(effects::UnequalBlades{}).errors(line.blades.count);
  double farthest = 0.0;
  for (int blade = 0; blade < line.blades.count; ++blade) {
    const auto& error = errors[static_cast<std::size_t>(blade)];
    const double angle = 2.0 * std::numbers::pi * blade / line.blades.count + error.angle;
    farthest = std::max(farthest, std::abs(circle + std::polar(reach + error.length, angle)));
  }
  return line.ring.radius - farthest;
}

}  // namespace

FreeShaft::FreeShaft(const settings::Scene& line, double speed_ratio)
    : speed_ratio_(speed_ratio),
      damping_ratio_(line.rotor.damping_ratio),
      revolution_(rotor::FreeMotion(damping_ratio_).kernel(2.0 * std::numbers::pi / speed_ratio)),
      deflection_(deflection_of(line)),
      circle_(circle_of(line, speed_ratio)),
      room_(room_of(line, circle_)),
      centre_(deflection_ + Complex(0.0, line.rotor.misalignment)) {}

bool FreeShaft::describes(const settings::Scene& line) {
  using effects::Effects;
  return !effects::acts<&Effects::support>(line) && !effects::acts<&Effects::speed_ripple>(line) &&
         !effects::acts<&Effects::speed_ramp>(line);
}

bool FreeShaft::describes(const settings::Scene& line, double speed_ratio) {
  return describes(line) && std::isfinite(std::abs(circle_of(line, speed_ratio)));
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

double FreeShaft::distance(const Vibration& left) const {
  double farthest = std::abs(centre_) + left.bound();
  if (damping_ratio_ < 1.0) {
    // D spirals inwards from an ellipse, and never leaves a polygon round that.
    constexpr int kCorners = 64;
    const double enlarged = 1.0 / std::cos(std::numbers::pi / kCorners);
    const double frequency = rotor::FreeMotion(damping_ratio_).damped_frequency();
    const Complex quarter_later = (left.velocity + damping_ratio_ * left.position) / frequency;
    double corner = 0.0;
    for (int i = 0; i < kCorners; ++i) {
      const Complex turn = std::polar(enlarged, 2.0 * std::numbers::pi * i / kCorners);
      corner =
          std::max(corner, std::abs(centre_ + turn.real() * left.position + turn.imag() * quarter_later));
    }
    farthest = std::min(farthest, corner);
  }
  return room_ - farthest;
}

double largest_sag(const settings::Scene& scene, double share) {
  if (!scene.gravity && !scene.side_load) return 0.0;
  // A shaft at rest asks neither for what has an axis of its own (damping, friction, speed, ...) nor for
  // where it has started.
  settings::Scene at_rest = scene;
  for (const auto& axis : settings::grid_axes()) (at_rest.grid.*axis.values).resize(1);
  for (auto& axis : at_rest.grid.swept) {
    if (is_initial_axis(settings::axis_name(axis.pointer))) axis.values.resize(1);
  }
  const plan::Grid grid(at_rest);
  const settings::Scene short_axes = plan::with_short_axes(at_rest);
  double largest = 0.0;
  for (std::size_t number = 0; number < grid.line_count(); ++number) {
    const auto at = grid.parameters(grid.point(number, 0));
    const auto line = plan::scene_of_line(short_axes, at);
    const double sag = std::abs(FreeShaft(line, at.speed_ratio).deflection());
    if (sag > share * length_scale(line)) largest = std::max(largest, sag);
  }
  return largest;
}

}  // namespace rubatlas::analysis
