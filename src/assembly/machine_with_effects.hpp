/// The machine on which more acts than on the paper's: a list holds just the forcings that the scene has.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

#include "rotor/any_shaft.hpp"
#include "rotor/harmonic.hpp"
#include "rotor/rippled_unbalance.hpp"
#include "rotor/rippling_blades.hpp"
#include "settings/combinations.hpp"
#include "settings/effects/list.hpp"
#include "settings/scene.hpp"
#include "variation/support_of_scene.hpp"

namespace rubatlas::assembly {

/// Whatever a scene's effects make of it. The closed form of the isotropic shaft at constant speed is kept
/// where the line has both.
class MachineWithEffects {
 public:
  /// Between revolutions (`changing_motion.hpp`).
  static constexpr bool kMayChange = true;
  MachineWithEffects(settings::Scene line, settings::Machine machine)
      : line_(std::move(line)), machine_(machine) {}

  [[nodiscard]] rotor::AnyShaft forcing(double speed_ratio) const {
    if (machine_ == settings::Machine::isotropic_shaft) return {rotor::Harmonics(harmonics(speed_ratio))};
    const rotor::SupportMatrices matrices = variation::support_of(line_, speed_ratio);
    std::vector<rotor::HarmonicForcing> forcing;
    for (const auto& term : harmonics(speed_ratio))
      forcing.push_back({term.acceleration(0.0), term.frequency()});
    return {rotor::SupportedShaft(rotor::LinearSupport(matrices.stiffness, matrices.damping, forcing))};
  }
  [[nodiscard]] rotor::RipplingBlades blades(double speed_ratio) const {
    return {angles(), speed_ratio, line_.speed_ripple.value_or(effects::SpeedRipple{})};
  }

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
    using effects::Effects;
    std::vector<double> result = rotor::equal_angles(line_.blades.count);
    if (effects::acts<&Effects::unequal_blades>(line_)) {
      const auto errors = line_.unequal_blades->errors(line_.blades.count);
      for (std::size_t k = 0; k < result.size(); ++k) result[k] += errors[k].angle;
    }
    return result;
  }

 private:
  settings::Scene line_;
  settings::Machine machine_;
};

}  // namespace rubatlas::assembly
