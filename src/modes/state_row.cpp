#include "modes/state_row.hpp"

#include <cmath>
#include <complex>
#include <cstddef>

#include "rotor/harmonic.hpp"
#include "rotor/linear_support.hpp"

namespace rubatlas::modes {

StateRow::StateRow(const rotor::Machine& machine, double spacing)
    : spacing_(spacing), isotropic_(rotor::FreeMotion(machine.constants.damping_ratio), 1.0, spacing) {
  if (const rotor::Harmonics* harmonics = machine.harmonics()) {
    const rotor::FreeMotion free(machine.constants.damping_ratio);
    for (const rotor::Harmonic& term : harmonics->terms()) {
      Response& response = responses_.emplace_back();
      response.frequency = term.frequency();
      for (int i = 0; i < kTimesOfRow; ++i) {
        const double elapsed = (i + 1) * spacing_;
        const auto from_rest = term.from_rest(0.0, elapsed, free, free.kernel(elapsed));
        response.along[0][i] = from_rest.position.real();
        response.along[1][i] = from_rest.position.imag();
        response.along[2][i] = from_rest.velocity.real();
        response.along[3][i] = from_rest.velocity.imag();
      }
      response.across = {-response.along[1], response.along[0], -response.along[3], response.along[2]};
    }
    return;
  }
  const rotor::LinearSupport& support = machine.supported()->support;
  supported_.resize(4);
  responses_.resize(support.terms().size());
  for (int i = 0; i < kTimesOfRow; ++i) {
    const rotor::LinearSupport::Propagator over = support.propagator((i + 1) * spacing_);
    for (std::size_t from = 0; from < 4; ++from) {
      for (std::size_t to = 0; to < 4; ++to)
        supported_[from][to][i] = over.free(static_cast<int>(to), static_cast<int>(from));
    }
    for (std::size_t j = 0; j < responses_.size(); ++j) {
      const rotor::HarmonicForcing& term = support.terms()[j];
      responses_[j].frequency = term.frequency;
      const double real = term.amplitude.real();
      const double imaginary = term.amplitude.imag();
      const Eigen::Vector4d along = over.forced[j] * Eigen::Vector2d(real, imaginary);
      const Eigen::Vector4d across = over.forced[j] * Eigen::Vector2d(-imaginary, real);
      for (std::size_t to = 0; to < 4; ++to) {
        responses_[j].along[to][i] = along[static_cast<int>(to)];
        responses_[j].across[to][i] = across[static_cast<int>(to)];
      }
    }
  }
}

void StateRow::start(double time, const rotor::State& state) {
  if (supported_.empty()) {
    isotropic_.move(state, states_);
  } else {
    for (std::size_t to = 0; to < 4; ++to)
      states_[to] = (state[0] * supported_[0][to] + state[1] * supported_[1][to]) +
                    (state[2] * supported_[2][to] + state[3] * supported_[3][to]);
  }
  for (const Response& response : responses_) {
    const std::complex<double> direction = std::polar(1.0, response.frequency * time);
    for (std::size_t to = 0; to < 4; ++to)
      states_[to] += direction.real() * response.along[to] + direction.imag() * response.across[to];
  }
}

}  // namespace rubatlas::modes
