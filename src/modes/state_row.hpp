/// Eight equally spaced times of free motion at once. Their distance is fixed, so that the free motion
/// between them, and the response to each forcing from rest, is known once for a point.
#pragma once

#include <Eigen/Core>
#include <array>
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

/// z'' + 2ζ z' + z = 0 one to eight times a duration after its start.
class FreeRow {
 public:
  FreeRow(const rotor::FreeMotion& free, double duration) : damping_ratio_(free.damping_ratio()) {
    for (int i = 0; i < kTimesOfRow; ++i) {
      const auto kernel = free.kernel((i + 1) * duration);
      cosine_[i] = kernel.cosine;
      sine_[i] = kernel.sine;
    }
  }
  void move(double place, double velocity, RowValues& places, RowValues& velocities) const {
    places = place * cosine_ + (velocity + damping_ratio_ * place) * sine_;
    velocities = velocity * cosine_ - (place + damping_ratio_ * velocity) * sine_;
  }

 private:
  double damping_ratio_;
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

  using OfState = std::array<RowValues, 4>;  ///< of x, y [m], x', y' [m per unit τ]
  [[nodiscard]] const OfState& states() const { return states_; }
  [[nodiscard]] rotor::State state(int i) const {
    return {states_[0][i], states_[1][i], states_[2][i], states_[3][i]};
  }

 private:
  /// What a forcing does to a shaft at rest.
  struct Response {
    double frequency;  ///< ν [per unit τ]
    OfState along;     ///< of the forcing as it is at τ = 0
    OfState across;    ///< of the same a quarter of a turn later
  };

  double spacing_;
  FreeRow isotropic_;
  std::vector<OfState>
      supported_;  ///< of another support: four, what the state follows from each of its parts
  std::vector<Response> responses_;
  OfState states_;
};

}  // namespace rubatlas::modes
