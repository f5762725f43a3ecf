/// The arithmetic of an attempt in lanes, for one width: what `Carried` and `RungeKutta::attempt` do,
/// operation by operation and in the same order.
///
/// Included by the files `lanes_<processor>.cpp` only, behind their `#pragma GCC target`: what is defined
/// here is compiled for that processor, what other headers define is not. `Processor` knows what has no
/// operator:
///     kLanes, magnitude(x), root(x), columns(rows, offset)
#pragma once

#include <cstddef>
#include <utility>

#include "batch/lane_block.hpp"

#define RUBATLAS_INLINE __attribute__((always_inline)) static

// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see lane_block.hpp
namespace rubatlas::batch {

/// Three numbers of each lane's own piece of the blade's table. They lie side by side in memory with a fourth
/// that nobody needs; rows are loaded and turned into columns, since a gather loads one number at a time.
template <int kLanes>
struct Columns {
  typename LaneVector<kLanes>::Type column[3];
};

template <class Processor>
struct LaneArithmetic {
  static constexpr int kLanes = Processor::kLanes;
  using Block = LaneBlock<kLanes>;
  using Lanes = typename Block::Lanes;
  using Pair = integrate::DormandPrince853;
  using Curve = blade::ElasticaCurve;

  /// (cos, sin) of the blade in each lane: `BladeSet::direction_near`.
  RUBATLAS_INLINE void turn(const Block& b, Lanes time, Lanes& cosine, Lanes& sine) {
    const Lanes angle = b.speed * (time - b.anchor_time);
    const Lanes square = angle * angle;
    const Lanes fourth = square * square;
    const Lanes sine_of_angle = angle + (angle * square) * ((-1.0 / 6 + square * (1.0 / 120)) +
                                                            fourth * (-1.0 / 5040 + square * (1.0 / 362880)));
    const Lanes cosine_less_one =
        square * ((-0.5 + square * (1.0 / 24)) + fourth * (-1.0 / 720 + square * (1.0 / 40320)));
    cosine = b.anchor_cosine + (b.anchor_cosine * cosine_less_one - b.anchor_sine * sine_of_angle);
    sine = b.anchor_sine + (b.anchor_sine * cosine_less_one + b.anchor_cosine * sine_of_angle);
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (!(square[i] < rotor::BladeSet::kFarTurned)) [[unlikely]] {
        const LaneRequest& request = *b.request[i];
        const auto er = request.blades->direction_near(request.anchor, time[i]);
        cosine[i] = er.cosine;
        sine[i] = er.sine;
      }
    }
  }

  /// Load, shortening and deflection of the blade, and their slopes: `ElasticaCurve::at`.
  RUBATLAS_INLINE void bend(const Block& b, Lanes u, Lanes (&value)[3], Lanes (&slope)[3]) {
    const Lanes size = Processor::magnitude(u);
    const double* rows[kLanes];
    Lanes centre, inverse;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Curve::Piece& piece = b.curve[i]->piece(size[i]);
      rows[i] = piece.coefficients[0].data();
      centre[i] = piece.centre;
      inverse[i] = piece.inverse_half_width;
    }
    const Lanes t = (size - centre) * inverse;
    const Lanes square = t * t;
    constexpr std::size_t kDegree = Curve::kDegree;
    Columns<kLanes> even = Processor::columns(rows, 4 * (kDegree - 1));
    Columns<kLanes> odd = Processor::columns(rows, 4 * kDegree);
    Lanes even_slope[3] = {}, odd_slope[3] = {};
#pragma GCC unroll 5
    for (std::size_t k = kDegree - 1; k >= 2; k -= 2) {
      const Columns<kLanes> next_even = Processor::columns(rows, 4 * (k - 2));
      const Columns<kLanes> next_odd = Processor::columns(rows, 4 * (k - 1));
      for (std::size_t m = 0; m < 3; ++m) {
        even_slope[m] = even_slope[m] * square + even.column[m];
        odd_slope[m] = odd_slope[m] * square + odd.column[m];
        even.column[m] = even.column[m] * square + next_even.column[m];
        odd.column[m] = odd.column[m] * square + next_odd.column[m];
      }
    }
    for (std::size_t m = 0; m < 3; ++m) {
      value[m] = even.column[m] + t * odd.column[m];
      slope[m] = (odd.column[m] + (2.0 * t) * (even_slope[m] + t * odd_slope[m])) * inverse;
    }
    const Lanes one = Lanes{} + 1.0;
    const Lanes sign = u < 0.0 ? -one : one;
    const Lanes parity = u < 0.0 ? b.mirror : one;
    value[2] *= parity;
    slope[0] *= sign;
    slope[1] *= sign;
    slope[2] *= sign * parity;
  }

  /// Adds the unbalance of the lanes that have one. To the others it adds −0, which changes no number.
  RUBATLAS_INLINE void unbalance(const Block& b, Lanes time, Lanes& ax, Lanes& ay) {
    Lanes x = Lanes{} - 0.0, y = x;
    for (std::size_t i = 0; i < kLanes; ++i) {
      x[i] = y[i] = -0.0;
      if (b.request[i]->unbalance == nullptr) continue;
      const std::complex<double> acceleration = b.request[i]->unbalance->acceleration(time[i]);
      x[i] = acceleration.real();
      y[i] = acceleration.imag();
    }
    ax += x;
    ay += y;
  }

  /// `Carried::operator()`. `kEnd`: with everything that is asked of the last evaluation.
  template <bool kEnd>
  RUBATLAS_INLINE void derivative(Block& b, const Lanes* z, Lanes* d) {
    Lanes ec, es, value[3], slope[3];
    turn(b, z[4], ec, es);
    bend(b, z[5], value, slope);
    // contact::pose
    const Lanes cy = z[1] + b.misalignment;
    const Lanes radial = z[0] * ec + cy * es, tangential = cy * ec - z[0] * es;
    const Lanes vr = z[2] * ec + z[3] * es, vt = z[3] * ec - z[2] * es;
    // ElasticaContact::constraint
    const Lanes shortening = b.length * value[1], deflection = b.length * value[2];
    const Lanes A = radial + b.reach - shortening;
    const Lanes B = tangential - b.slip * deflection;
    const Lanes bending_slope = (-2.0 * b.length) * (A * slope[1] + b.slip * B * slope[2]);
    const Lanes time_slope = 2.0 * A * (vr + b.speed * tangential) + 2.0 * B * (vt - b.speed * radial);
    const Lanes inverse_distance = 1.0 / Processor::root(A * A + B * B);
    const Lanes nr = A * inverse_distance, nt = B * inverse_distance;
    const Lanes load = b.load_unit * value[0];
    const Lanes friction = b.slip * b.friction * load;
    const Lanes fr = -load * nr + friction * nt, ft = -load * nt - friction * nr;
    const Lanes rate = -b.scale * bending_slope;
    Lanes ax = (fr * ec - ft * es) * b.force_unit - b.damping * z[2] - z[0];
    Lanes ay = (fr * es + ft * ec) * b.force_unit - b.damping * z[3] - z[1];
    if (b.any_unbalance) unbalance(b, z[4], ax, ay);
    d[0] = rate * z[2];
    d[1] = rate * z[3];
    d[2] = rate * ax;
    d[3] = rate * ay;
    d[4] = rate;
    d[5] = b.scale * time_slope;
    if constexpr (kEnd) {
      const Lanes gap = z[0] * z[0] + cy * cy + 2.0 * b.reach * radial + b.closing;
      b.force_radial = fr;
      b.force_tangential = ft;
      b.load = load;
      b.shortening = value[1];
      b.root_strain = b.strain_unit * value[0] * (value[2] + b.friction * (1.0 - value[1]));
      b.slip_velocity =
          nr * vt - nt * vr + b.speed * ((b.reach - shortening) * nr - b.slip * deflection * nt);
      b.residual = gap + shortening * (shortening - 2.0 * (radial + b.reach)) +
                   deflection * (deflection - 2.0 * b.slip * tangential);
      b.bending_slope = bending_slope;
      b.time_slope = time_slope;
      b.acceleration_x = ax;
      b.acceleration_y = ay;
    }
  }

  /// State of stage `kRow`; the last row is the end.
  template <std::size_t kRow>
  RUBATLAS_INLINE void state(const Block& b, Lanes* z) {
    for (std::size_t c = 0; c < 6; ++c) {
      Lanes sum{};
      bool first = true;
#pragma GCC unroll 12
      for (std::size_t j = 0; j < Pair::kStages; ++j) {
        const double w = kRow == Pair::kStages ? Pair::kWeight[j] : Pair::kStage[kRow][j];
        if (w == 0.0) continue;
        sum = first ? w * b.stages[j][c] : sum + w * b.stages[j][c];
        first = false;
      }
      z[c] = b.start[c] + b.size * sum;
    }
  }

  // One copy of the right-hand side for the eleven stages: twelve would not fit the instruction cache.
  __attribute__((noinline)) static void stage(Block& b, const Lanes* z, Lanes* d) {
    derivative<false>(b, z, d);
  }

  template <std::size_t... kI>
  RUBATLAS_INLINE void stages(Block& b, std::index_sequence<kI...>) {
    Lanes z[6];
    ((state<kI + 1>(b, z), stage(b, z, b.stages[kI + 1])), ...);
  }

  RUBATLAS_INLINE void attempt(Block& b) {
    stages(b, std::make_index_sequence<Pair::kStages - 1>{});
    state<Pair::kStages>(b, b.end);
    derivative<true>(b, b.end, b.stages[Pair::kStages]);
  }
};

}  // namespace rubatlas::batch
// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)

#undef RUBATLAS_INLINE
