/// The sweeps that solve an interval (`interval.hpp`). Compiled once for each kind of processor; everything
/// here has internal linkage, so that no other source can come to use instructions of a processor that it was
/// not compiled for.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

template <std::size_t kWidth>
class Sweeps {
 public:
  using Number = Lanes<kWidth>;

  Sweeps(const Contact& contact, const BendingTable& table, const Closeness& closeness, Interval& interval)
      : contact_(contact),
        table_(table),
        closeness_(closeness),
        interval_(interval),
        nodes_(node_tables()),
        chord_time_(Number(nodes_.node) * interval.chord.time),
        chord_argument_(Number(nodes_.node) * interval.chord.argument + interval.start_argument),
        deviation_(interval.deviation) {
    if (closeness.warm) {
      x_ = Number(interval.x);
      y_ = Number(interval.y);
      vx_ = Number(interval.vx);
      vy_ = Number(interval.vy);
    } else {
      const Number elapsed = chord_time_ + deviation_ * interval.normal.time;
      const auto taylor = [&](std::size_t i, Number& place, Number& velocity) {
        const double acceleration = interval.acceleration[i];
        const double jerk = interval.jerk[i];
        velocity = elapsed * (elapsed * (0.5 * jerk) + acceleration) + interval.start[2 + i];
        place = elapsed *
                    (elapsed * (elapsed * (jerk * (1.0 / 6)) + 0.5 * acceleration) + interval.start[2 + i]) +
                interval.start[i];
      };
      taylor(0, x_, vx_);
      taylor(1, y_, vy_);
    }
  }

  bool solve() {
    double before = kFirstChange;
    for (interval_.sweeps = 1; interval_.sweeps <= kMostSweeps; ++interval_.sweeps) {
      const double change = sweep();
      if (!(change < kFirstChange)) return false;
      // The changes form a geometric series in the end, of which this is the rest.
      const double ratio = std::min(change / before, kSlowest);
      if (change * ratio <= closeness_.velocity && interval_.sweeps > 1) {
        store();
        return true;
      }
      before = change;
    }
    return false;
  }

 private:
  static constexpr int kMostSweeps = 12;
  static constexpr double kFirstChange = 1e3;  ///< [m per unit τ]: of no motion in a ring
  static constexpr double kSlowest = 0.5;      ///< ratio of changes, where none is known
  /// Of Δ/L: below it δ/Δ is less than rounding of what it is added to.
  static constexpr double kUnbent = 1e-9;

  /// The curve at eight nodes, with slopes by p.
  struct Curve {
    Number load, shortening, deflection;
    Number load_slope, shortening_slope, deflection_slope;
  };

  /// Four nodes at a time, each with its own piece, of which one register holds all three quantities.
  RUBATLAS_INLINE void evaluate_curve(const Number& argument, Curve& curve) const {
    using Row = simd::simd<double, simd::simd_abi::deduce_t<double, kWidth == 2 ? 2 : 4>>;
    constexpr std::size_t kRows = 4 / Row::size();
    constexpr std::size_t kAtOnce = 4;
    // Not set to zero first. NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
    alignas(64) double at[kNodes];
    argument.store_to(at);
    struct alignas(64) Values {
      // Not set to zero first. NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
      double at[3][kNodes];
    };
    Values value;
    Values slope;
    constexpr double kPerPiece = 1.0 / BendingTable::kWidth;
    for (std::size_t i = 0; i < kNodes; i += kAtOnce) {
      std::array<const double*, kAtOnce> coefficients;
      std::array<double, kAtOnce> t;
      for (std::size_t k = 0; k < kAtOnce; ++k) {
        const double place = std::clamp(at[i + k] * kPerPiece, 0.0, static_cast<double>(table_.last_piece()));
        const int piece = static_cast<int>(place);
        coefficients[k] = table_.pieces()[piece].coefficients[0].data();
        t[k] = 2.0 * (at[i + k] * kPerPiece - piece) - 1.0;
      }
      std::array<std::array<Row, kRows>, kAtOnce> sum;
      std::array<std::array<Row, kRows>, kAtOnce> rate;
      const auto row = [&](std::size_t k, std::size_t power, std::size_t r) {
        return Row(coefficients[k] + 4 * power + r * Row::size(), simd::vector_aligned);
      };
      for (std::size_t k = 0; k < kAtOnce; ++k) {
        for (std::size_t r = 0; r < kRows; ++r) {
          rate[k][r] = row(k, BendingTable::kDegree, r);
          sum[k][r] = rate[k][r] * t[k] + row(k, BendingTable::kDegree - 1, r);
        }
      }
#pragma GCC unroll 16
      for (std::size_t below = 2; below <= BendingTable::kDegree; ++below) {
        const std::size_t power = BendingTable::kDegree - below;
        for (std::size_t k = 0; k < kAtOnce; ++k) {
          for (std::size_t r = 0; r < kRows; ++r) {
            rate[k][r] = rate[k][r] * t[k] + sum[k][r];
            sum[k][r] = sum[k][r] * t[k] + row(k, power, r);
          }
        }
      }
      for (std::size_t k = 0; k < kAtOnce; ++k) {
        for (std::size_t quantity = 0; quantity < 3; ++quantity) {
          value.at[quantity][i + k] = sum[k][quantity / Row::size()][quantity % Row::size()];
          slope.at[quantity][i + k] = rate[k][quantity / Row::size()][quantity % Row::size()];
        }
      }
    }
    constexpr double kSlopeUnit = 2.0 / BendingTable::kWidth;
    curve.load = Number::loaded(value.at[0]);
    curve.shortening = Number::loaded(value.at[1]);
    curve.deflection = Number::loaded(value.at[2]);
    curve.load_slope = Number::loaded(slope.at[0]) * kSlopeUnit;
    curve.shortening_slope = Number::loaded(slope.at[1]) * kSlopeUnit;
    curve.deflection_slope = Number::loaded(slope.at[2]) * kSlopeUnit;
  }

  struct Vector {
    Number x, y;
  };
  /// A vector turned by an angle below 0.8 rad, by the series of sine and cosine: less than 1e-16 is left
  /// out.
  RUBATLAS_INLINE static Vector turned(const std::array<double, 2>& from, const Number& angle) {
    const Number square = angle * angle;
    const Number fourth = square * square;
    const Number sine =
        angle * (((square * (-1.0 / 6) + 1.0) + fourth * (square * (-1.0 / 5040) + 1.0 / 120)) +
                 (fourth * fourth) * ((square * (-1.0 / 39916800) + 1.0 / 362880) +
                                      fourth * (square * (-1.0 / 1307674368000.0) + 1.0 / 6227020800.0)));
    const Number cosine_less_one =
        square * (((square * (1.0 / 24) - 0.5) + fourth * (square * (1.0 / 40320) - 1.0 / 720)) +
                  (fourth * fourth) * ((square * (1.0 / 479001600) - 1.0 / 3628800) +
                                       fourth * (square * (1.0 / 20922789888000.0) - 1.0 / 87178291200.0)));
    return {(cosine_less_one * from[0] - sine * from[1]) + from[0],
            (cosine_less_one * from[1] + sine * from[0]) + from[1]};
  }

  /// Returns the largest change of a velocity [m per unit τ].
  RUBATLAS_INLINE double sweep() {
    const Contact& c = contact_;
    const Interval& in = interval_;
    const Number elapsed = chord_time_ + deviation_ * in.normal.time;
    const Number argument = chord_argument_ + deviation_ * in.normal.argument;
    const Vector er = turned(in.blade, elapsed * c.speed_ratio);
    Curve curve;
    evaluate_curve(argument, curve);

    // Pose of the blade (MODEL 2), and h = 0 with its slopes along p and along the motion (MODEL 4.1).
    const Number cy = y_ + c.misalignment;
    const Number radial = x_ * er.x + cy * er.y;
    const Number tangential = cy * er.x - x_ * er.y;
    const Number gap = (x_ * x_ + cy * cy) + (radial * (2.0 * c.reach) + c.closing);
    const Number shortening = curve.shortening * c.length;
    const Number deflection = curve.deflection * (c.slip * c.length);  // s Δ
    const Number along = radial + c.reach;
    const Number residual =
        gap + (shortening * (shortening - along * 2.0) + deflection * (deflection - tangential * 2.0));
    Number a = along - shortening;
    Number b = tangential - deflection;
    const Number shortening_slope = curve.shortening_slope * c.length;
    const Number deflection_slope = curve.deflection_slope * (c.slip * c.length);
    const Number argument_slope = (a * shortening_slope + b * deflection_slope) * -2.0;
    const Number a_rate = (vx_ * er.x + vy_ * er.y) + tangential * c.speed_ratio;
    const Number b_rate = (vy_ * er.x - vx_ * er.y) - radial * c.speed_ratio;
    const Number time_slope = (a * a_rate + b * b_rate) * 2.0;

    // One Newton step along the normal; what follows is taken at its end.
    const Number step = residual / (argument_slope * in.normal.argument + time_slope * in.normal.time);
    deviation_ = deviation_ - step;
    const Number argument_step = step * -in.normal.argument;
    const Number time_step = step * -in.normal.time;
    const Number load = (curve.load + curve.load_slope * argument_step) * c.load_unit;
    const Number less = shortening_slope * argument_step;
    const Number more = deflection_slope * argument_step;
    a = a + (a_rate * time_step - less);
    b = b + (b_rate * time_step - more);
    const Number turn = time_step * c.speed_ratio;
    const Vector er_there{er.x - er.y * turn, er.y + er.x * turn};

    // Force on the rotor (MODEL 4.3): its normal is (a, b)/R where h = 0.
    const double per_radius = c.force_unit / c.ring_radius;
    const double friction = c.slip * c.friction;
    const Number force_radial = load * ((b * friction - a) * per_radius);
    const Number force_tangential = load * ((a * friction + b) * -per_radius);
    const double damping = 2.0 * c.damping_ratio;
    ax_ = ((force_radial * er_there.x - force_tangential * er_there.y) - x_) - vx_ * damping;
    ay_ = ((force_radial * er_there.y + force_tangential * er_there.x) - y_) - vy_ * damping;
    if (c.forced) {
      const Vector forcing = turned(in.forcing, (elapsed + time_step) * c.speed_ratio);
      ax_ = ax_ + forcing.x;
      ay_ = ay_ + forcing.y;
    }

    deviation_slope_ = Number::combined(nodes_.slope, deviation_);
    time_rate_ = deviation_slope_ * in.normal.time + in.chord.time;
    const Number vx = Number::combined(nodes_.integral, ax_ * time_rate_) + in.start[2];
    const Number vy = Number::combined(nodes_.integral, ay_ * time_rate_) + in.start[3];
    x_ = Number::combined(nodes_.integral, vx * time_rate_) + in.start[0];
    y_ = Number::combined(nodes_.integral, vy * time_rate_) + in.start[1];
    const double change = larger(magnitude(vx - vx_), magnitude(vy - vy_)).largest();
    vx_ = vx;
    vy_ = vy;

    slip_velocity_ = (a * b_rate - b * a_rate) * (1.0 / c.ring_radius) + c.speed_ratio * c.ring_radius;
    const Number shortened = shortening + less;
    const Number deflected = deflection + more;
    const Number bent = larger(deflected * c.slip, Number(kUnbent * c.length));
    gap_measure_ = (b * 2.0 + deflected) * c.slip + shortened / bent * (a * 2.0 + shortened);
    blade_ = er;
    return change;
  }

  void store() const {
    Interval& in = interval_;
    deviation_.store(in.deviation);
    x_.store(in.x);
    y_.store(in.y);
    vx_.store(in.vx);
    vy_.store(in.vy);
    (chord_time_ + deviation_ * in.normal.time).store(in.elapsed);
    (chord_argument_ + deviation_ * in.normal.argument).store(in.argument);
    time_rate_.store(in.time_slope);
    (deviation_slope_ * in.normal.argument + in.chord.argument).store(in.argument_slope);
    ax_.store(in.ax);
    ay_.store(in.ay);
    blade_.x.store(in.blade_x);
    blade_.y.store(in.blade_y);
    gap_measure_.store(in.gap_measure);
    slip_velocity_.store(in.slip_velocity);
  }

  const Contact& contact_;
  const BendingTable& table_;
  const Closeness& closeness_;
  Interval& interval_;
  const NodeTables& nodes_;
  Number chord_time_, chord_argument_;
  Number deviation_, deviation_slope_, time_rate_;
  Number x_, y_, vx_, vy_, ax_, ay_;
  Vector blade_;
  Number gap_measure_, slip_velocity_;
};

}  // namespace
}  // namespace rubatlas::collocation
