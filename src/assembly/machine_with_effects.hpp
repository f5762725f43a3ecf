/// Machines on which more acts than on the paper's: a list holds just the forcings that the scene has.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

#include "modes/supported_flight.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/harmonic.hpp"
#include "rotor/rippled_unbalance.hpp"
#include "rotor/rippling_blades.hpp"
#include "settings/effects/list.hpp"
#include "settings/scene.hpp"
#include "variation/support_of_scene.hpp"

namespace rubatlas::assembly {

/// Whatever a scene's effects make of it, at constant speed.
class MachineWithEffects {
 public:
  /// Between revolutions (`changing_motion.hpp`).
  static constexpr bool kMayChange = true;
  explicit MachineWithEffects(settings::Scene line) : line_(std::move(line)) {}

  [[nodiscard]] rotor::Harmonics forcing(double speed_ratio) const {
    return rotor::Harmonics(harmonics(speed_ratio));
  }
  [[nodiscard]] rotor::BladeSet blades(double speed_ratio) const { return {angles(), speed_ratio}; }

  /// All harmonic forcings that the scene has.
  [[nodiscard]] std::vector<rotor::Harmonic> harmonics(double speed_ratio) const {
    using effects::Effects;
    const double damping = line_.rotor.damping_ratio;
    std::vector<rotor::Harmonic> terms;
    if (effects::acts<&Effects::unbalance>(line_)) {
      const double specific_moment = line_.unbalance->moment / line_.rotor.mass;
      if (effects::acts<&Effects::speed_ripple>(line_)) {
        terms = rotor::rippled_unbalance(*line_.speed_ripple, specific_moment, line_.unbalance->phase,
                                         speed_ratio, damping);
      } else {
        terms.push_back(
            rotor::RotatingUnbalance(specific_moment, line_.unbalance->phase, speed_ratio, damping));
      }
    }
    const double frequency = line_.rotor.natural_frequency;
    const double stiffness = line_.rotor.mass * frequency * frequency;
    const auto add_static = [&](const auto& load) {
      const std::complex<double> deflection = load->deflection(stiffness, frequency);
      terms.emplace_back(std::abs(deflection), std::arg(deflection), 0.0, damping);
    };
    if (effects::acts<&Effects::gravity>(line_)) add_static(line_.gravity);
    if (effects::acts<&Effects::side_load>(line_)) add_static(line_.side_load);
    return terms;
  }

  /// Angles of the blades from blade 0's place [rad].
  [[nodiscard]] std::vector<double> angles() const {
    std::vector<double> result = rotor::equal_angles(line_.blades.count);
    if (effects::acts<&Effects::unequal_blades>(line_)) {
      const auto errors = line_.unequal_blades->errors(line_.blades.count);
      for (std::size_t k = 0; k < result.size(); ++k) result[k] += errors[k].angle;
    }
    return result;
  }

 protected:
  using Effects = effects::Effects;
  settings::Scene line_;
};

/// On any linear support, at a speed that may ripple.
class AnyMachine final : public MachineWithEffects {
 public:
  using MachineWithEffects::MachineWithEffects;
  [[nodiscard]] rotor::RipplingBlades blades(double speed_ratio) const {
    return {angles(), speed_ratio, line_.speed_ripple.value_or(effects::SpeedRipple{})};
  }
  [[nodiscard]] modes::SupportedShaft forcing(double speed_ratio) const {
    const rotor::SupportMatrices matrices = variation::support_of(line_, speed_ratio);
    std::vector<rotor::HarmonicForcing> forcing;
    for (const auto& term : harmonics(speed_ratio)) {
      forcing.push_back({term.acceleration(0.0), term.frequency()});
    }
    return modes::SupportedShaft(rotor::LinearSupport(matrices.stiffness, matrices.damping, forcing));
  }
};

}  // namespace rubatlas::assembly
