#include "variation/parts_of_scene.hpp"

#include <cmath>
#include <complex>
#include <vector>

#include "rotor/rippled_unbalance.hpp"
#include "rotor/support_matrices.hpp"
#include "settings/effects/list.hpp"

namespace rubatlas::variation {

namespace {

using effects::Effects;

/// All harmonic forcings that the scene has.
std::vector<rotor::Harmonic> harmonics_of(const settings::Scene& line, double speed_ratio) {
  const double damping = line.rotor.damping_ratio;
  std::vector<rotor::Harmonic> terms;
  if (effects::acts<&Effects::unbalance>(line)) {
    const double specific_moment = line.unbalance->moment / line.rotor.mass;
    if (effects::acts<&Effects::speed_ripple>(line)) {
      terms = rotor::rippled_unbalance(*line.speed_ripple, specific_moment, line.unbalance->phase,
                                       speed_ratio, damping);
    } else {
      terms.push_back(rotor::RotatingUnbalance(specific_moment, line.unbalance->phase, speed_ratio, damping));
    }
  }
  const double frequency = line.rotor.natural_frequency;
  const double stiffness = line.rotor.mass * frequency * frequency;
  const auto add_static = [&](const auto& load) {
    const std::complex<double> deflection = load->deflection(stiffness, frequency);
    terms.emplace_back(std::abs(deflection), std::arg(deflection), 0.0, damping);
  };
  if (effects::acts<&Effects::gravity>(line)) add_static(line.gravity);
  if (effects::acts<&Effects::side_load>(line)) add_static(line.side_load);
  return terms;
}

/// K and C of z'' + C z' + K z = f at a speed ratio Ω (`settings/effects/support.hpp`).
rotor::SupportMatrices support_of(const settings::Scene& line, double speed_ratio) {
  const effects::Support added = line.support.value_or(effects::Support{});
  const double damping = line.rotor.mass * line.rotor.natural_frequency;
  const double stiffness = damping * line.rotor.natural_frequency;
  rotor::SupportMatrices matrices = rotor::isotropic_shaft(line.rotor.damping_ratio);
  Eigen::Matrix2d more;
  more << added.stiffness_xx, added.stiffness_xy, added.stiffness_yx, added.stiffness_yy;
  matrices.stiffness += more / stiffness;
  more << added.damping_xx, added.damping_xy, added.damping_yx, added.damping_yy;
  matrices.damping += more / damping;
  return rotor::with_rotating_damping(matrices, 0.5 * added.rotating_damping / damping, speed_ratio);
}

rotor::AnyShaft shaft_of(const settings::Scene& line, double speed_ratio) {
  const std::vector<rotor::Harmonic> harmonics = harmonics_of(line, speed_ratio);
  // The closed form of the isotropic shaft at constant speed is kept where a line has both.
  if (!effects::acts<&Effects::support>(line) && !effects::acts<&Effects::speed_ripple>(line))
    return {rotor::Harmonics(harmonics)};
  const rotor::SupportMatrices matrices = support_of(line, speed_ratio);
  std::vector<rotor::HarmonicForcing> forcing;
  forcing.reserve(harmonics.size());
  for (const rotor::Harmonic& term : harmonics) forcing.push_back({term.acceleration(0.0), term.frequency()});
  return {rotor::SupportedShaft(rotor::LinearSupport(matrices.stiffness, matrices.damping, forcing))};
}

rotor::Ring ring_of(const settings::Scene& line) {
  if (!effects::acts<&Effects::ring_body>(line)) return {};
  const double stiffness = 1.0 / line.ring_body->compliance;
  if (line.ring_body->mass == 0.0) return rotor::FollowingRing{stiffness};
  return rotor::RingBody(line.ring_body->mass, stiffness, line.ring_body->damping,
                         line.rotor.natural_frequency);
}

}  // namespace

rotor::Machine machine_of(const settings::Scene& line, double speed_ratio) {
  return {constants_of(line, speed_ratio),
          {angles_of(line), speed_ratio, line.speed_ripple.value_or(effects::SpeedRipple{})},
          shaft_of(line, speed_ratio),
          ring_of(line)};
}

}  // namespace rubatlas::variation
