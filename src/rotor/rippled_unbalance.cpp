#include "rotor/rippled_unbalance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rubatlas::rotor {

std::vector<Harmonic> rippled_unbalance(const effects::SpeedRipple& ripple, double specific_moment,
                                        double phase, double speed_ratio, double damping_ratio) {
  const double depth = ripple.amplitude / ripple.order;
  const double strength = std::abs(specific_moment) * speed_ratio * speed_ratio;
  std::vector<Harmonic> terms;
  const auto add = [&](int k) {
    const double frequency = speed_ratio * (1.0 + k * ripple.order);
    const double weight = ::jn(k, depth);
    const double amplitude = specific_moment * frequency * frequency * weight;
    const double angle = phase - depth * std::sin(ripple.phase) + k * ripple.phase;
    terms.emplace_back(std::abs(amplitude), amplitude < 0.0 ? angle + std::numbers::pi : angle, frequency,
                       damping_ratio);
    return std::abs(amplitude);
  };
  constexpr int kMost = 64;
  add(0);
  for (int k = 1; k < kMost; ++k) {
    const double strongest = std::max(add(k), add(-k));
    if (strongest < std::numeric_limits<double>::epsilon() * 1e-2 * strength) break;
  }
  return terms;
}

}  // namespace rubatlas::rotor
