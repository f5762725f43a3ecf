/// The search for the touch-down that ends a flight, with proof that there is none before it, and for the
/// tips that pass the ring meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "contact/pose.hpp"
#include "modes/flight.hpp"
#include "modes/flight_row.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"
#include "rotor/machine.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

/// Finds the first touch-down of a flight: in rows of times, and in the first interval of a row that leaves a
/// doubt, of each blade that may touch in it, by Newton's method where its gap certainly rises meanwhile,
/// else in a finer row, and last in steps that its tip cannot outrun. These shrink towards a touch-down, and
/// end there.
///
/// Also the piece of motion that is being recorded: the flight, with the tips that it knows.
class TouchdownSearch final : public trajectory::PieceWithoutContact {
 public:
  /// Flight and meter outlive the search. `blades`: one geometry for each blade. `touches_inside`: a tip that
  /// has lifted off inside the ring touches it where it turns outwards there (MODEL 7.16).
  TouchdownSearch(const Flight& flight, std::vector<contact::Geometry> blades, WorkMeter& meter,
                  bool touches_inside = false);

  struct Touchdown {
    int blade;
    double time;  ///< τ of the revolution
  };

  /// Nothing also where the meter ends the revolution.
  std::optional<Touchdown> find(double until);
  /// The touch-down of a tip from `time` on and before `until`, in steps that it cannot outrun.
  std::optional<Touchdown> by_steps(const contact::Geometry& tip, int blade, double time,
                                    rotor::ShaftAndRing bodies, double until);

  /// Whether the shaft's centre reaches the ring before `until`, |c| = R, with no blade in contact (MODEL 5):
  /// the zero of the gap of a blade without length. False also where the meter ends the revolution.
  bool shaft_at_ring(double until);

  /// The flight up to `end` [τ].
  trajectory::MotionPiece& piece(double end) {
    end_ = end;
    return *this;
  }
  [[nodiscard]] double begin() const override { return flight_->start_time(); }
  [[nodiscard]] double end() const override { return end_; }
  [[nodiscard]] trajectory::State state(double time) override {
    return rotor::as_array(flight_->shaft(time));
  }
  void places(const trajectory::SampleTimes& times, int first, std::span<double> x,
              std::span<double> y) override {
    flight_->places(times, first, x, y);
  }
  [[nodiscard]] double displacement_bound() const override {
    return flight_->shaft_bound(begin(), rotor::shaft(flight_->at_start()), end_ - begin(), false);
  }
  [[nodiscard]] double largest_displacement(double known, double /*speed_ratio*/) override {
    return displacement_bound() > known ? flight_->largest_displacement(begin(), end_, known) : known;
  }
  [[nodiscard]] trajectory::Tip tip(int blade, double time) override;
  /// As far as the meter pays. Once this has been asked for, the search keeps the gaps that it finds.
  [[nodiscard]] std::optional<trajectory::Pass> nearest_pass(
      double known, const trajectory::PointConstants& point) override;

  /// Bounds of |g'''| and |g''''| of the blade that reaches farthest [m² per unit τ³, τ⁴].
  struct GapBounds {
    double third;
    double fourth;
  };
  [[nodiscard]] GapBounds gap_bounds(const FlightBound& bound) const;

  /// Gaps evaluated, one for each blade and time, or row of times.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  /// Of e^{−iφ} [per unit τ², τ³, τ⁴].
  static rotor::DerivativeBounds turning_bounds(const rotor::BladeSet& blades);

  /// Where a shaft on a stiff support, or a ring on a stiff spring, moves too fast for the first spacing,
  /// rows have half of it, a quarter, and so on, down to this share.
  static constexpr double kClosest = 1.0 / 2048.0;

  /// Bounds of a flight, the time up to which they hold, and the rows that they allow.
  struct Outlook {
    double until;   ///< τ of the revolution
    double fourth;  ///< of |g''''|
    FlightRow* row;
  };
  /// `shows_passes`: the cubics of the rows show where tips pass, besides what may touch.
  [[nodiscard]] Outlook outlook(double time, const rotor::ShaftAndRing& bodies, double until,
                                bool shows_passes);
  FlightRow& row_of(double spacing) {
    return rows_by_spacing_.try_emplace(spacing, *machine_, spacing).first->second;
  }
  std::span<const FlightRow::Gaps> read(FlightRow& row, double time, const rotor::ShaftAndRing& bodies,
                                        double fourth_bound, int left_open);
  std::optional<Touchdown> by_newton(int blade, double from, double to, double guess, double until);

  [[nodiscard]] const contact::Geometry& geometry(int blade) const {
    return blades_[static_cast<std::size_t>(blade)];
  }
  [[nodiscard]] contact::Pose pose(int blade, double time, const rotor::ShaftAndRing& bodies) const;

  static constexpr std::uint16_t kMostRows = 4096;  ///< kept at once
  struct KeptRow {
    double begin;    ///< τ of the revolution
    double spacing;  ///< τ
    int intervals;   ///< of the row that belong to the flight's way; the next row goes on after them
  };
  [[nodiscard]] bool rows_reach_end(double spacing) const;
  double look_along(double from);
  [[nodiscard]] std::int64_t price_of_row() const {
    return flight_->price_of_state() + static_cast<std::int64_t>(blades_.size()) * WorkPrice::kGap;
  }
  [[nodiscard]] static bool may_have_top(const FlightRow::Gaps& gaps, double spacing);
  [[nodiscard]] double gap_rate(int blade, double time) const;
  void take_start(int blade, double rate, trajectory::Pass& nearest);
  void take_top(int blade, double time, trajectory::Pass& nearest);
  void take_tops(const KeptRow& row, int blade, const FlightRow::Gaps& gaps, trajectory::Pass& nearest);

  [[nodiscard]] double clear_step(const contact::Geometry& geometry, int blade, double time,
                                  const rotor::ShaftAndRing& bodies, double until) const;

  const Flight* flight_;
  double end_ = 0.0;  ///< of the piece [τ]
  WorkMeter* meter_;
  const rotor::Machine* machine_;
  bool touches_inside_;
  std::vector<contact::Geometry> blades_;
  double ring_radius_;  ///< R [m]
  double rounding_;     ///< of gaps: below it a row does not tell [m²]
  double farthest_;     ///< the longest reach of a blade [m]
  rotor::DerivativeBounds turning_;
  double first_spacing_;                          ///< of rows [τ]
  std::vector<int> first_doubts_;                 ///< of the blades in a row
  std::vector<std::optional<double>> crossings_;  ///< of those that may touch first
  std::map<double, FlightRow> rows_by_spacing_;
  bool keeps_rows_ = false;
  std::vector<KeptRow> rows_;          ///< found along the flight, where they are kept
  std::vector<FlightRow::Gaps> gaps_;  ///< blade by blade in each of them, then in the row that was read last
  std::uint64_t evaluations_ = 0;
};

}  // namespace rubatlas::modes
