/// The sweeps that solve an interval (`interval.hpp`). Compiled once for each kind of processor; everything
/// here has internal linkage, so that no other source can come to use instructions of a processor that it was
/// not compiled for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

/// `kPlain`: nothing acts but what the paper's rotor has and harmonic forcings, which takes an eighth less.
template <std::size_t kWidth, bool kPlain>
class Sweeps {
 public:
  using Number = Lanes<kWidth>;

  Sweeps(const Contact& contact, const Closeness& closeness, Interval& interval)
      : contact_(contact),
        machine_(*contact.machine),
        closeness_(closeness),
        interval_(interval),
        nodes_(node_tables()),
        chord_time_(Number(nodes_.node) * interval.chord.time),
        chord_argument_(Number(nodes_.node) * interval.chord.argument + interval.start_argument),
        deviation_(interval.deviation) {
    shaft_.start(interval.shaft, closeness.warm, elapsed());
    if (ring_moves()) ring_.start(interval.ring, closeness.warm, elapsed());
    lead_.blade = contact.blade;
    lead_.slip = contact.slip;
    for (std::size_t k = 0; k < interval.further_count; ++k) {
      further_[k].blade = interval.further[k].blade;
      further_[k].slip = interval.further[k].slip;
      further_[k].square = Number(interval.further[k].square);
    }
  }

  RUBATLAS_INLINE bool solve() {
    double before = kFirstChange;
    bool light = false;
    // With several blades changes fall unevenly, and the slopes of one that is hardly bent change too fast to
    // be kept.
    const bool several = interval_.further_count > 0;
    const int full_sweeps = several ? kMostSweeps : kFullSweeps;
    double ratio_before = kSlowest;
    for (interval_.sweeps = 1; interval_.sweeps <= kMostSweeps; ++interval_.sweeps) {
      const double change = light ? sweep<true>() : sweep<false>();
      if (!(change < kFirstChange)) return false;
      // The changes form a geometric series in the end, of which this is the rest.
      const double ratio = interval_.sweeps > 1 ? std::min(change / before, kSlowest) : kSlowest;
      const double rest = change * std::max(ratio, interval_.sweeps > 2 ? ratio_before : 0.0);
      if (rest <= closeness_.velocity && largest_step_ < largest_step_allowed()) {
        store();
        return true;
      }
      light = interval_.sweeps >= full_sweeps && change < kConverging * before;
      before = change;
      ratio_before = ratio;
    }
    return false;
  }

 private:
  static constexpr int kMostSweeps = 9;
  static constexpr std::size_t kSlopeDegree = 5;
  static constexpr int kFullSweeps = 3;        ///< with slopes of their own
  static constexpr double kConverging = 0.25;  ///< ratio of changes below which slopes may be kept
  static constexpr double kFirstChange = std::numeric_limits<double>::infinity();
  /// Of Newton's steps in w and p²: the next would be of its square. Velocities alone do not tell, where a
  /// blade is so soft that it hardly moves the shaft.
  static constexpr double kLargestStep = 1e-4;
  static constexpr double kLittleBent = 0.1;  ///< p: blades that are bent less have shorter last steps
  [[nodiscard]] double largest_step_allowed() const {
    const Number argument = chord_argument_ + deviation_ * interval_.normal.argument;
    const double largest = std::max(std::abs(interval_.start_argument), magnitude(argument).largest());
    return kLargestStep * std::min(1.0, largest / kLittleBent);
  }
  static constexpr double kSlowest = 0.5;  ///< ratio of changes, where none is known
  /// Of Δ/L: below it δ/Δ is less than rounding of what it is added to.
  static constexpr double kUnbent = 1e-9;

  /// Load, shortening and deflection of the blade at eight nodes.
  struct Bend {
    Number load, shortening, deflection;
  };

  /// The piece of each node, and the place in it, in [−1, 1].
  struct Places {
    std::array<const double*, kNodes> coefficients;
    std::array<double, kNodes> t;
  };
  RUBATLAS_INLINE static Places places(const blade::BendingTable& table, const Number& argument) {
    constexpr double kPerPiece = 1.0 / blade::BendingTable::kWidth;
    const Number place = argument * kPerPiece;
    const Number piece =
        whole(smaller(larger(place, Number(0.0)), Number(static_cast<double>(table.last_piece()))));
    Places result;
    // Not set to zero first. NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
    alignas(64) double pieces[kNodes];
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
    alignas(64) double t[kNodes];
    piece.store_to(pieces);
    ((place - piece) * 2.0 - 1.0).store_to(t);
    for (std::size_t k = 0; k < kNodes; ++k) {
      result.coefficients[k] = table.pieces()[static_cast<int>(pieces[k])].coefficients[0].data();
      result.t[k] = t[k];
    }
    return result;
  }

  /// Each node has its own piece, of which one register holds all three quantities.
  using Row = simd::simd<double, simd::simd_abi::deduce_t<double, kWidth == 2 ? 2 : 4>>;
  static constexpr std::size_t kRows = 4 / Row::size();
  template <std::size_t kCount>
  using Rows = std::array<std::array<Row, kRows>, kCount>;

  RUBATLAS_INLINE static Row row(const double* coefficients, std::size_t power, std::size_t part) {
    return Row(coefficients + 4 * power + part * Row::size(), simd::vector_aligned);
  }
  RUBATLAS_INLINE static Bend across(const Rows<kNodes>& rows) {
    const auto quantity = [&](std::size_t q) RUBATLAS_INLINED {
      return Number::each([&](std::size_t k)
                              RUBATLAS_INLINED { return rows[k][q / Row::size()][q % Row::size()]; });
    };
    return {quantity(0), quantity(1), quantity(2)};
  }

  RUBATLAS_INLINE static Bend curve(const Places& at) {
    Rows<kNodes> sum;
    for (std::size_t k = 0; k < kNodes; ++k) {
      for (std::size_t r = 0; r < kRows; ++r)
        sum[k][r] = row(at.coefficients[k], blade::BendingTable::kDegree, r);
    }
#pragma GCC unroll 16
    for (std::size_t below = 1; below <= blade::BendingTable::kDegree; ++below) {
      for (std::size_t k = 0; k < kNodes; ++k) {
        for (std::size_t r = 0; r < kRows; ++r)
          sum[k][r] = sum[k][r] * at.t[k] + row(at.coefficients[k], blade::BendingTable::kDegree - below, r);
      }
    }
    return across(sum);
  }

  /// With the slopes by p, of the powers up to `kSlopeDegree`: they are for Newton's steps only. Four nodes
  /// at a time: as many as registers hold.
  RUBATLAS_INLINE static Bend curve_with_slopes(const Places& at, Bend& slope) {
    constexpr std::size_t kAtOnce = 4;
    Rows<kNodes> sum;
    Rows<kNodes> rate;
    for (std::size_t i = 0; i < kNodes; i += kAtOnce) {
      for (std::size_t k = i; k < i + kAtOnce; ++k) {
        for (std::size_t r = 0; r < kRows; ++r)
          sum[k][r] = row(at.coefficients[k], blade::BendingTable::kDegree, r);
      }
#pragma GCC unroll 16
      for (std::size_t below = 1; below <= blade::BendingTable::kDegree; ++below) {
        const std::size_t power = blade::BendingTable::kDegree - below;
        for (std::size_t k = i; k < i + kAtOnce; ++k) {
          for (std::size_t r = 0; r < kRows; ++r) {
            if (power + 1 == kSlopeDegree) rate[k][r] = sum[k][r];
            if (power + 1 < kSlopeDegree) rate[k][r] = rate[k][r] * at.t[k] + sum[k][r];
            sum[k][r] = sum[k][r] * at.t[k] + row(at.coefficients[k], power, r);
          }
        }
      }
    }
    constexpr double kSlopeUnit = 2.0 / blade::BendingTable::kWidth;
    slope = across(rate);
    slope = {slope.load * kSlopeUnit, slope.shortening * kSlopeUnit, slope.deflection * kSlopeUnit};
    return across(sum);
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

  /// A vector turned by a small angle, of which powers above the eighth are left out.
  struct Turn {
    Number sine, cosine_less_one;
    RUBATLAS_INLINE explicit Turn(const Number& angle) {
      const Number square = angle * angle;
      sine = angle * (square * (square * (square * (-1.0 / 5040) + 1.0 / 120) - 1.0 / 6) + 1.0);
      cosine_less_one = square * (square * (square * (square * (1.0 / 40320) - 1.0 / 720) + 1.0 / 24) - 0.5);
    }
    RUBATLAS_INLINE Vector operator()(const Vector& from) const {
      return {(from.x * cosine_less_one - from.y * sine) + from.x,
              (from.y * cosine_less_one + from.x * sine) + from.y};
    }
  };

  /// Shaft or ring at the nodes.
  struct Motion {
    Number x, y, vx, vy, ax, ay;

    RUBATLAS_INLINE void start(const Body& body, bool warm, const Number& elapsed) {
      if (warm) {
        x = Number(body.x);
        y = Number(body.y);
        vx = Number(body.vx);
        vy = Number(body.vy);
        return;
      }
      const auto taylor = [&](std::size_t i, Number& place, Number& velocity) RUBATLAS_INLINED {
        const double acceleration = body.acceleration[i];
        const double jerk = body.jerk[i];
        velocity = elapsed * (elapsed * (0.5 * jerk) + acceleration) + body.start[2 + i];
        place =
            elapsed * (elapsed * (elapsed * (jerk * (1.0 / 6)) + 0.5 * acceleration) + body.start[2 + i]) +
            body.start[i];
      };
      taylor(0, x, vx);
      taylor(1, y, vy);
    }
    /// Integrates the accelerations; `time_rate`: dτ/dθ. Returns the largest change of a velocity.
    RUBATLAS_INLINE double integrate(const Body& body, const NodeTables& nodes, const Number& time_rate) {
      const Number vx_next = Number::combined(nodes.integral, ax * time_rate) + body.start[2];
      const Number vy_next = Number::combined(nodes.integral, ay * time_rate) + body.start[3];
      x = Number::combined(nodes.integral, vx_next * time_rate) + body.start[0];
      y = Number::combined(nodes.integral, vy_next * time_rate) + body.start[1];
      const double change = larger(magnitude(vx_next - vx), magnitude(vy_next - vy)).largest();
      vx = vx_next;
      vy = vy_next;
      return change;
    }
    /// Squares of Legendre's coefficients of the velocity's slope by θ.
    RUBATLAS_INLINE Number squares(const NodeTables& nodes, const Number& time_rate) const {
      const Number along_x = Number::combined(nodes.legendre, ax * time_rate);
      const Number along_y = Number::combined(nodes.legendre, ay * time_rate);
      return along_x * along_x + along_y * along_y;
    }
    RUBATLAS_INLINE void store(Body& body) const {
      x.store(body.x);
      y.store(body.y);
      vx.store(body.vx);
      vy.store(body.vy);
      ax.store(body.ax);
      ay.store(body.ay);
    }
  };

  /// A blade in contact.
  struct Tip {
    const Blade* blade;
    double slip;                        ///< s = ±1
    Number shortening, deflection;      ///< δ and s Δ [m]
    Number a, b, a_rate, b_rate;        ///< of the tip against the ring's centre in (er, ep) [m], and by τ
    Bend slope;                         ///< of load, δ and s Δ by p
    Number argument_slope, time_slope;  ///< of h by p, and along the motion (MODEL 4.1)
    Number yielding;                    ///< F/kr of the ring under the tip [m]
  };
  /// A further one, of which h = 0 is solved for p².
  struct FurtherTip : Tip {
    Number square;
  };

  [[nodiscard]] bool ring_moves() const {
    return !kPlain && machine_.ring.moves;
  }
  [[nodiscard]] bool ripples() const {
    return !kPlain && machine_.ripples();
  }
  [[nodiscard]] bool is_isotropic() const {
    return kPlain || machine_.support.isotropic;
  }
  [[nodiscard]] static bool yields(const Blade& blade) {
    return !kPlain && blade.yield_unit != 0.0;
  }

  RUBATLAS_INLINE Number elapsed() const {
    return chord_time_ + deviation_ * interval_.normal.time;
  }
  RUBATLAS_INLINE Number angular_speed() const {
    return kPlain ? Number(machine_.speed_ratio) : angular_speed_;
  }
  /// Shaft's centre and velocity as seen from the ring's.
  RUBATLAS_INLINE Vector seen() const {
    const Vector centre{shaft_.x, shaft_.y + machine_.misalignment};
    return ring_moves() ? Vector{centre.x - ring_.x, centre.y - ring_.y} : centre;
  }
  RUBATLAS_INLINE Vector seen_velocity() const {
    return ring_moves() ? Vector{shaft_.vx - ring_.vx, shaft_.vy - ring_.vy} : Vector{shaft_.vx, shaft_.vy};
  }

  /// Direction of the leading blade, and how fast it turns, at these times.
  RUBATLAS_INLINE void take_direction(const Number& elapsed) {
    const Machine& m = machine_;
    Number angle = elapsed * m.speed_ratio;
    angular_speed_ = m.speed_ratio;
    if (ripples()) {
      const Vector ripple = turned(interval_.ripple, elapsed * m.ripple.frequency);
      angle = angle + (ripple.y - interval_.ripple[1]) * m.ripple.depth;
      angular_speed_ = ripple.x * (m.speed_ratio * m.ripple.amplitude) + m.speed_ratio;
    }
    er_ = turned(interval_.blade, angle);
  }
  /// Adds the acceleration by the forcings to that of the shaft.
  RUBATLAS_INLINE void add_forcings() {
    const std::array<double, 2>& blade = interval_.blade;
    for (std::size_t j = 0; j < machine_.forcing_count; ++j) {
      const std::array<double, 2>& start = interval_.forcing[j];
      const double frequency = machine_.frequency[j];
      Vector term;
      if (frequency == 0.0) {
        term = {Number(start[0]), Number(start[1])};
      } else if (frequency == machine_.speed_ratio && !ripples()) {
        // It stands still against the blade.
        term = offset_by(
            er_, {start[0] * blade[0] + start[1] * blade[1], start[1] * blade[0] - start[0] * blade[1]});
      } else {
        term = turned(start, elapsed() * frequency);
      }
      shaft_.ax = shaft_.ax + term.x;
      shaft_.ay = shaft_.ay + term.y;
    }
  }

  /// Load, shortening and deflection of a tip, with their slopes unless those are kept.
  template <bool kLight>
  RUBATLAS_INLINE static Bend bend_of(Tip& tip, const Number& argument) {
    const Places at = places(*tip.blade->table, argument);
    if constexpr (kLight) return curve(at);
    const Bend bend = curve_with_slopes(at, tip.slope);
    tip.slope.shortening = tip.slope.shortening * tip.blade->length;
    tip.slope.deflection = tip.slope.deflection * (tip.slip * tip.blade->length);
    return bend;
  }

  /// Pose of the blade (MODEL 2), and its residual of h = 0 (MODEL 4.1) with the slopes.
  template <bool kLight>
  RUBATLAS_INLINE Number residual_of(Tip& tip, const Bend& bend, const Vector& er) const {
    const Blade& blade = *tip.blade;
    const Vector c = seen();
    const Number radial = c.x * er.x + c.y * er.y;
    const Number tangential = c.y * er.x - c.x * er.y;
    const Number gap = (c.x * c.x + c.y * c.y) + (radial * (2.0 * blade.reach) + blade.closing);
    tip.shortening = bend.shortening * blade.length;
    tip.deflection = bend.deflection * (tip.slip * blade.length);  // s Δ
    const Number along = radial + blade.reach;
    Number residual = gap + (tip.shortening * (tip.shortening - along * 2.0) +
                             tip.deflection * (tip.deflection - tangential * 2.0));
    tip.a = along - tip.shortening;
    tip.b = tangential - tip.deflection;
    if constexpr (!kLight) {
      const Vector v = seen_velocity();
      tip.argument_slope = (tip.a * tip.slope.shortening + tip.b * tip.slope.deflection) * -2.0;
      tip.a_rate = (v.x * er.x + v.y * er.y) + tangential * angular_speed();
      tip.b_rate = (v.y * er.x - v.x * er.y) - radial * angular_speed();
      tip.time_slope = (tip.a * tip.a_rate + tip.b * tip.b_rate) * 2.0;
    }
    if (yields(blade)) {
      const Number yielding = bend.load * blade.yield_unit;
      residual = residual - yielding * (yielding + 2.0 * machine_.ring_radius);
      if constexpr (!kLight)
        tip.argument_slope = tip.argument_slope -
                             (yielding + machine_.ring_radius) * tip.slope.load * (2.0 * blade.yield_unit);
    }
    return residual;
  }

  /// Moves a tip on by steps in p and τ, and gives what it does to the shaft, as an acceleration (MODEL 4.3).
  /// `er`: at the end of the steps. The force's normal is (a, b)/(R + F/kr) where h = 0.
  RUBATLAS_INLINE Vector push_of(Tip& tip, const Bend& bend, const Number& argument_step,
                                 const Number& time_step, const Vector& er) const {
    const Blade& blade = *tip.blade;
    const Number of_unit = bend.load + tip.slope.load * argument_step;
    const Number load = of_unit * blade.load_unit;
    const Number less = tip.slope.shortening * argument_step;
    const Number more = tip.slope.deflection * argument_step;
    tip.shortening = tip.shortening + less;
    tip.deflection = tip.deflection + more;
    tip.a = tip.a + (tip.a_rate * time_step - less);
    tip.b = tip.b + (tip.b_rate * time_step - more);
    Number per_radius = machine_.force_unit / machine_.ring_radius;
    if (yields(blade)) {
      tip.yielding = of_unit * blade.yield_unit;
      per_radius = Number(machine_.force_unit) / (tip.yielding + machine_.ring_radius);
    }
    const double friction = tip.slip * blade.friction;
    const Number radial = load * ((tip.b * friction - tip.a) * per_radius);
    const Number tangential = load * ((tip.a * friction + tip.b) * (per_radius * -1.0));
    return {radial * er.x - tangential * er.y, radial * er.y + tangential * er.x};
  }

  RUBATLAS_INLINE static Vector offset_by(const Vector& from, const std::array<double, 2>& offset) {
    return {from.x * offset[0] - from.y * offset[1], from.y * offset[0] + from.x * offset[1]};
  }

  /// The same for a further blade, with a step of its own: one of Newton's for p², of which h is nearly
  /// linear where the blade is hardly bent.
  template <bool kLight>
  RUBATLAS_INLINE Vector push_of_further(std::size_t k, const Vector& er_before, const Number& time_step) {
    constexpr double kLeastLeft = 0.01;  // of p², in one step
    FurtherTip& tip = further_[k];
    const std::array<double, 2>& offset = interval_.further[k].offset;
    const Number argument = root(tip.square);
    const Bend bend = bend_of<kLight>(tip, argument);
    const Number residual = residual_of<kLight>(tip, bend, offset_by(er_before, offset));
    const Number step = argument * -2.0 * ((residual + tip.time_slope * time_step) / tip.argument_slope);
    tip.square = larger(tip.square + step, tip.square * kLeastLeft);
    largest_step_ = std::max(largest_step_, magnitude(step).largest());
    return push_of(tip, bend, root(tip.square) - argument, time_step, offset_by(er_, offset));
  }

  /// Returns the largest change of a velocity [m per unit τ].
  ///
  /// A `light` sweep keeps the slopes of the sweep before, and turns its directions on: changes are small by
  /// then, and the solution does not depend on the slopes.
  template <bool kLight>
  RUBATLAS_INLINE double sweep() {
    const Machine& m = machine_;
    const Interval& in = interval_;
    if constexpr (!kLight) take_direction(elapsed());
    const Bend bend = bend_of<kLight>(lead_, chord_argument_ + deviation_ * in.normal.argument);
    const Number residual = residual_of<kLight>(lead_, bend, er_);
    if constexpr (!kLight) {
      per_residual_ =
          Number(-1.0) / (lead_.argument_slope * in.normal.argument + lead_.time_slope * in.normal.time);
    }

    // One Newton step along the normal; what follows is taken at its end.
    const Number step = residual * per_residual_;
    deviation_ = deviation_ + step;
    largest_step_ = magnitude(step).largest();
    const Number time_step = step * in.normal.time;
    const Vector er_before = er_;
    if (ripples()) {
      take_direction(elapsed());
    } else {
      er_ = Turn(time_step * m.speed_ratio)(er_);
    }
    Vector push = push_of(lead_, bend, step * in.normal.argument, time_step, er_);
    for (std::size_t k = 0; k < in.further_count; ++k) {
      const Vector more = push_of_further<kLight>(k, er_before, time_step);
      push = {push.x + more.x, push.y + more.y};
    }
    if (is_isotropic()) {
      const double damping = 2.0 * m.damping_ratio;
      shaft_.ax = (push.x - shaft_.x) - shaft_.vx * damping;
      shaft_.ay = (push.y - shaft_.y) - shaft_.vy * damping;
    } else {
      const auto& [kxx, kxy, kyx, kyy] = m.support.stiffness;
      const auto& [cxx, cxy, cyx, cyy] = m.support.damping;
      shaft_.ax = (push.x - (shaft_.x * kxx + shaft_.y * kxy)) - (shaft_.vx * cxx + shaft_.vy * cxy);
      shaft_.ay = (push.y - (shaft_.x * kyx + shaft_.y * kyy)) - (shaft_.vx * cyx + shaft_.vy * cyy);
    }
    add_forcings();

    deviation_slope_ = Number::combined(nodes_.slope, deviation_);
    time_rate_ = deviation_slope_ * in.normal.time + in.chord.time;
    double change = shaft_.integrate(in.shaft, nodes_, time_rate_);
    if (ring_moves()) {
      const double share = -m.ring.force_unit / m.force_unit;
      ring_.ax = (push.x * share - ring_.x * m.ring.stiffness) - ring_.vx * m.ring.damping;
      ring_.ay = (push.y * share - ring_.y * m.ring.stiffness) - ring_.vy * m.ring.damping;
      change = std::max(change, ring_.integrate(in.ring, nodes_, time_rate_));
    }
    return change;
  }

  /// g/Δ of a tip [m], as h = 0 has it. Next to the unbent blade δ and F/kr are Δ's share there.
  RUBATLAS_INLINE static Number gap_measure_of(const Tip& tip, double ring_radius) {
    const Blade& blade = *tip.blade;
    const double unbent = kUnbent * blade.length;
    const Number bent = larger(tip.deflection * tip.slip, Number(unbent));
    const Number shorter = larger(tip.shortening, Number(blade.first_shortening * unbent));
    const Number measure =
        (tip.b * 2.0 + tip.deflection) * tip.slip + shorter / bent * (tip.a * 2.0 + tip.shortening);
    if (!yields(blade)) return measure;
    const Number yields = larger(tip.yielding, Number(blade.first_yielding * unbent));
    return measure + yields / bent * (tip.yielding + 2.0 * ring_radius);
  }
  /// v of a tip (MODEL 4.4), of the velocities that have been found: light sweeps keep the tip's rates.
  RUBATLAS_INLINE Number slip_velocity_of(const Tip& tip, const Vector& er) const {
    const double radius = machine_.ring_radius;
    const Vector v = seen_velocity();
    const Number along = (v.x * er.x + v.y * er.y) + (tip.b + tip.deflection) * angular_speed();
    const Number across =
        (v.y * er.x - v.x * er.y) - (tip.a + tip.shortening - tip.blade->reach) * angular_speed();
    const Number moment = tip.a * across - tip.b * along;
    if (!yields(*tip.blade)) return moment * (1.0 / radius) + angular_speed() * radius;
    const Number yielded = tip.yielding + radius;
    return moment / yielded + angular_speed() * yielded;
  }

  void store() const {
    Interval& in = interval_;
    deviation_.store(in.deviation);
    shaft_.store(in.shaft);
    if (ring_moves()) ring_.store(in.ring);
    elapsed().store(in.elapsed);
    (chord_argument_ + deviation_ * in.normal.argument).store(in.argument);
    time_rate_.store(in.time_slope);
    (deviation_slope_ * in.normal.argument + in.chord.argument).store(in.argument_slope);
    er_.x.store(in.blade_x);
    er_.y.store(in.blade_y);
    angular_speed().store(in.angular_speed);
    gap_measure_of(lead_, machine_.ring_radius).store(in.gap_measure);
    slip_velocity_of(lead_, er_).store(in.slip_velocity);
    for (std::size_t k = 0; k < in.further_count; ++k) {
      further_[k].square.store(in.further[k].square);
      gap_measure_of(further_[k], machine_.ring_radius).store(in.further[k].gap_measure);
      slip_velocity_of(further_[k], offset_by(er_, in.further[k].offset)).store(in.further[k].slip_velocity);
    }
    Number squares = shaft_.squares(nodes_, time_rate_);
    if (ring_moves()) squares = squares + ring_.squares(nodes_, time_rate_);
    root(squares).store(in.coefficients);
  }

  const Contact& contact_;
  const Machine& machine_;
  const Closeness& closeness_;
  Interval& interval_;
  const NodeTables& nodes_;
  Number chord_time_, chord_argument_;
  Number deviation_, deviation_slope_, time_rate_;
  Motion shaft_, ring_;
  Vector er_;             ///< direction of the leading blade
  Number angular_speed_;  ///< φ'
  Tip lead_;
  std::array<FurtherTip, kMostFurther> further_;
  Number per_residual_;  ///< Newton's step along the normal for a residual of h
  double largest_step_ = 0.0;
};

template <std::size_t kWidth>
bool solved(const Contact& contact, const Closeness& closeness, Interval& interval) {
  const Machine& machine = *contact.machine;
  bool plain = machine.support.isotropic && !machine.ripples() && !machine.ring.moves &&
               contact.blade->yield_unit == 0.0;
  for (std::size_t k = 0; k < interval.further_count; ++k)
    plain = plain && interval.further[k].blade->yield_unit == 0.0;
  return plain ? Sweeps<kWidth, true>(contact, closeness, interval).solve()
               : Sweeps<kWidth, false>(contact, closeness, interval).solve();
}

}  // namespace
}  // namespace rubatlas::collocation
