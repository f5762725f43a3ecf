/// Eight equally spaced times of free motion at once. Their distance is fixed, so that the free motion
/// between them, and the response to each forcing from rest, is known once for a point.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "rotor/constants.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

constexpr int kTimesOfRow = 8;
using RowValues = Eigen::Array<double, kTimesOfRow, 1>;
/// Where one row starts from the end of another, so many may follow before a state in closed form: rounding
/// adds up.
constexpr int kRowsFromClosedForm = 16;

/// Of x, y [m], x', y' [m per unit τ].
using StatesOfRow = std::array<RowValues, 4>;

/// z'' + 2ζν z' + ν² z = 0 one to eight spacings after its start.
class FreeRow {
 public:
  /// `frequency`: ν [-].
  FreeRow(const rotor::FreeMotion& free, double frequency, double spacing)
      : damping_ratio_(free.damping_ratio()), frequency_(frequency) {
    for (int i = 0; i < kTimesOfRow; ++i) {
      const auto kernel = free.kernel((i + 1) * (frequency * spacing));
      cosine_[i] = kernel.cosine;
      sine_[i] = kernel.sine;
    }
  }
  void move(const rotor::State& from, StatesOfRow& states) const {
    for (std::size_t i = 0; i < 2; ++i) {
      const double place = from[static_cast<Eigen::Index>(i)];
      const double velocity = from[static_cast<Eigen::Index>(i + 2)] / frequency_;
      states[i] = place * cosine_ + (velocity + damping_ratio_ * place) * sine_;
      states[i + 2] = frequency_ * (velocity * cosine_ - (place + damping_ratio_ * velocity) * sine_);
    }
  }

 private:
  double damping_ratio_, frequency_;
  RowValues cosine_, sine_;  ///< `FreeMotion::kernel`
};

/// The shaft.
class StateRow {
 public:
  /// `spacing`: between two times [τ].
  StateRow(const rotor::Machine& machine, double spacing);

  [[nodiscard]] double spacing() const { return spacing_; }

  /// Moves the row to a state at time τ of the revolution, which its eight times follow by one to eight
  /// spacings.
  void start(double time, const rotor::State& state);

  [[nodiscard]] const StatesOfRow& states() const { return states_; }
  [[nodiscard]] rotor::State state(int i) const {
    return {states_[0][i], states_[1][i], states_[2][i], states_[3][i]};
  }

 private:
  /// What a forcing does to a shaft at rest.
  struct Response {
    double frequency;    ///< ν [per unit τ]
    StatesOfRow along;   ///< of the forcing as it is at τ = 0
    StatesOfRow across;  ///< of the same a quarter of a turn later
  };

  double spacing_;
  FreeRow isotropic_;
  std::vector<StatesOfRow>
      supported_;  ///< of another support: four, what the state follows from each of its parts
  std::vector<Response> responses_;
  StatesOfRow states_;
};

}  // namespace rubatlas::modes
