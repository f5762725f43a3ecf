/// Eight times of a flight at once: where the shaft and the tips are, and between which of these times a tip
/// may touch the ring.
///
/// The times are equally spaced, so that the free motion between them, and the response to each forcing from
/// rest, is known once for a point. Between two of them the gap g of a blade is a cubic through its values
/// and slopes, but for a remainder that a bound of the fourth derivative bounds: |g − cubic| <= max|g''''| h⁴
/// θ²(1 − θ)²/24 at the share θ of their distance h. Since θ²(1 − θ)² <= θ(1 − θ)/4, it is enough to add
/// max|g''''| h⁴/288 to both inner Bernstein coefficients of the cubic: where all four are negative, so is g.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "contact/pose.hpp"
#include "integrate/newton_between.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/free_motion.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::modes {

constexpr int kTimesOfRow = 8;
using RowValues = Eigen::Array<double, kTimesOfRow, 1>;
/// Where one row starts from the end of another, so many may follow before a state in closed form: rounding
/// adds up.
constexpr int kRowsFromClosedForm = 16;

/// Of each time x, y [m], x', y' [m per unit τ].
using StatesOfRow = Eigen::Array<double, kTimesOfRow, 4>;

/// z'' + 2ζν z' + ν² z = 0 one to eight spacings after its start.
class FreeRow {
 public:
  FreeRow(const rotor::FreeMotion& free, double spacing)
      : damping_ratio_(free.damping_ratio()), frequency_(free.frequency()) {
    for (int i = 0; i < kTimesOfRow; ++i) {
      const auto kernel = free.kernel((i + 1) * (frequency_ * spacing));
      cosine_[i] = kernel.cosine;
      sine_[i] = kernel.sine;
    }
  }
  void move(const rotor::State& from, StatesOfRow& states) const {
    for (int i = 0; i < 2; ++i) {
      const double place = from[i];
      const double velocity = from[i + 2] / frequency_;
      states.col(i) = place * cosine_ + (velocity + damping_ratio_ * place) * sine_;
      states.col(i + 2) = frequency_ * (velocity * cosine_ - (place + damping_ratio_ * velocity) * sine_);
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
  [[nodiscard]] rotor::State state(int i) const { return states_.row(i).transpose(); }

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

/// Directions at the times of a row.
struct DirectionsOfRow {
  RowValues cosine, sine;

  /// Each turned by an angle, as a direction of that angle has it.
  [[nodiscard]] DirectionsOfRow turned(const auto& by) const {
    return {cosine * by.cosine - sine * by.sine, sine * by.cosine + cosine * by.sine};
  }
};

/// How the hub turns until eight equally spaced times.
class TurnRow {
 public:
  /// `blades` outlive the row. `spacing`: between two times [τ].
  TurnRow(const rotor::BladeSet& blades, double spacing);

  /// Moves the row to a time τ of the revolution, which its eight times follow.
  void start(double time);

  /// Of the angle by which the hub turns from the start of the row.
  [[nodiscard]] const DirectionsOfRow& turned() const { return turned_; }
  /// φ' at the start of the row, and at its times [per unit τ].
  [[nodiscard]] double speed_at_start() const { return speed_at_start_; }
  [[nodiscard]] const RowValues& speed() const { return speed_; }

 private:
  const rotor::BladeSet* blades_;
  DirectionsOfRow mean_;    ///< of the angle at the mean speed
  DirectionsOfRow ripple_;  ///< of the angle by which the ripple goes on
  DirectionsOfRow turned_;
  double speed_at_start_;
  RowValues speed_;
};

class FlightRow {
 public:
  /// `machine` outlives the row. `spacing`: h [τ].
  FlightRow(const rotor::Machine& machine, double spacing);

  [[nodiscard]] double spacing() const { return states_.spacing(); }  ///< h [τ]

  /// Moves the row to a state of the flight at time τ of the revolution; `fourth_bound`: of |g''''| in it.
  void start(double time, const rotor::ShaftAndRing& bodies, double fourth_bound);

  /// g [m²] and dg/dτ of a blade at the start of the row and at its eight times.
  struct Gaps {
    double before;
    double rate_before;
    RowValues gap;
    RowValues rate;

    /// Where an interval begins; the one after the last: where that ends.
    [[nodiscard]] integrate::ValueAndSlope at(int interval) const {
      if (interval == 0) return {before, rate_before};
      return {gap[interval - 1], rate[interval - 1]};
    }
  };
  /// `er`: direction of the blade at the start of the row.
  [[nodiscard]] Gaps gaps(const contact::Geometry& geometry, const contact::BladeDirection& er) const {
    const contact::Pose at_start =
        contact::pose(geometry, er, start_[0], start_[1] + misalignment_, start_[2], start_[3]);
    const auto [cosine, sine] = turn_.turned().turned(er);
    const double reach = 2.0 * geometry.reach;
    const RowValues x = seen_.col(0), y = seen_.col(1), vx = seen_.col(2), vy = seen_.col(3);
    return {at_start.gap, contact::gap_rate(geometry, at_start, turn_.speed_at_start()),
            square_ + (reach * (x * cosine + y * sine) + geometry.closing()),
            square_rate_ + reach * ((vx * cosine + vy * sine) + turn_.speed() * (y * cosine - x * sine))};
  }
  [[nodiscard]] rotor::ShaftAndRing state(int i) const;

  /// The first of the eight intervals of the row in which a tip with these gaps may touch; kTimesOfRow: none.
  /// `rounding`: more than the gaps are rounded by [m²].
  [[nodiscard]] int first_doubt(const Gaps& gaps, double rounding) const {
    const double remainder = remainder_ + rounding;
    const double third = spacing() / 3.0;
    // The inner Bernstein coefficients: before a time, and, of the next interval, behind it.
    const RowValues rise = third * gaps.rate;
    const RowValues before = gaps.gap - rise;
    const RowValues behind = gaps.gap + rise;
    // The tip of a blade that has just lifted off starts at the ring, up to rounding.
    double first = std::min(gaps.before, 0.0) + third * gaps.rate_before;
    const double highest = before.max(behind).maxCoeff();
    // Mostly.
    if (std::max(first, highest) + remainder < 0.0 && gaps.gap.maxCoeff() < 0.0) return kTimesOfRow;
    for (int i = 0; i < kTimesOfRow; ++i) {
      if (!(std::max(first, before[i]) + remainder < 0.0 && gaps.gap[i] < 0.0)) return i;
      first = behind[i];
    }
    return kTimesOfRow;
  }

  /// Where the gap of a tip rises all through one of the eight intervals, from below zero to above, so that
  /// the tip touches once: when, roughly, a duration from the start of the interval [τ].
  [[nodiscard]] std::optional<double> only_crossing(const Gaps& gaps, int interval, double rounding) const;

  /// What |g''''| <= `fourth_bound` leaves of g between two times at a distance h, in its inner Bernstein
  /// coefficients [m²].
  [[nodiscard]] static double remainder(double fourth_bound, double spacing) {
    const double square = spacing * spacing;
    return fourth_bound * square * square / 288.0;
  }

 private:
  double misalignment_;
  StateRow states_;
  std::optional<FreeRow> ring_;  ///< that is a body
  TurnRow turn_;
  rotor::State start_ = rotor::State::Zero();
  StatesOfRow ring_states_ = StatesOfRow::Zero();
  StatesOfRow seen_;                ///< c and c', of the shaft as seen from the ring
  RowValues square_, square_rate_;  ///< |c|² and its derivative
  double remainder_ = 0.0;
};

}  // namespace rubatlas::modes
