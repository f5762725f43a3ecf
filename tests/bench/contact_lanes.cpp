#include "contact_lanes.hpp"

#include <immintrin.h>

#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

namespace rubatlas::bench {
namespace {
using Pair = integrate::DormandPrince853;
using Law = contact::ElasticaContact;

// Private members that lanes read and write: naming them in an explicit instantiation is legal, and leaves
// the classes that they belong to as they are.
template <class Tag, auto kMember>
struct Opened {
  friend constexpr auto member(Tag) { return kMember; }
};
#define RUBATLAS_OPEN(Tag, Class, name) \
  struct Tag {                          \
    friend constexpr auto member(Tag);  \
  };                                    \
  template struct Opened<Tag, &Class::name>
RUBATLAS_OPEN(Pieces, blade::ElasticaCurve, pieces_);
RUBATLAS_OPEN(Index, blade::ElasticaCurve, index);
RUBATLAS_OPEN(Mirror, blade::ElasticaCurve, mirror_);
RUBATLAS_OPEN(Length, Law, length_);
RUBATLAS_OPEN(LoadUnit, Law, load_unit_);
RUBATLAS_OPEN(StrainUnit, Law, strain_unit_);
RUBATLAS_OPEN(LawEvaluations, Law, evaluations_);
RUBATLAS_OPEN(Rotor, LaneSystem, rotor_);
RUBATLAS_OPEN(Blades, LaneSystem, blades_);
RUBATLAS_OPEN(OfLaw, LaneSystem, law_);
RUBATLAS_OPEN(Contact, LaneSystem, contact_);
RUBATLAS_OPEN(AnchorTime, LaneSystem, anchor_time_);
RUBATLAS_OPEN(Anchor, LaneSystem, anchor_);
RUBATLAS_OPEN(Scale, LaneSystem, scale_);
RUBATLAS_OPEN(Last, LaneSystem, last_);
RUBATLAS_OPEN(Acceleration, LaneSystem, acceleration_);
RUBATLAS_OPEN(Evaluations, LaneSystem, evaluations_);
RUBATLAS_OPEN(StepStages, LaneStep, stages_);
RUBATLAS_OPEN(StepEnd, LaneStep, end_);
RUBATLAS_OPEN(StepSize, LaneStep, size_);
RUBATLAS_OPEN(DenseReady, LaneStep, dense_ready_);
#undef RUBATLAS_OPEN
}  // namespace

#pragma GCC push_options
#pragma GCC target("avx2,fma,avx512f,avx512dq,avx512vl,prefer-vector-width=512")

template <int kLanes>
struct ContactLanes<kLanes>::Arithmetic {
  using Batch = ContactLanes<kLanes>;

  __attribute__((always_inline)) static Lanes magnitude(Lanes value) {
    if constexpr (kLanes == 8) return static_cast<Lanes>(_mm512_abs_pd(static_cast<__m512d>(value)));
    if constexpr (kLanes == 4) {
      return static_cast<Lanes>(_mm256_andnot_pd(_mm256_set1_pd(-0.0), static_cast<__m256d>(value)));
    }
  }
  __attribute__((always_inline)) static Lanes root(Lanes value) {
    if constexpr (kLanes == 8) return static_cast<Lanes>(_mm512_sqrt_pd(static_cast<__m512d>(value)));
    if constexpr (kLanes == 4) return static_cast<Lanes>(_mm256_sqrt_pd(static_cast<__m256d>(value)));
  }
  /// Four numbers of each lane's own piece, side by side in memory, the last of which nobody needs. Rows are
  /// loaded and turned into columns: a gather loads one number at a time.
  struct Columns {
    Lanes column[3];
  };
  __attribute__((always_inline)) static Columns columns(const double* const (&base)[kLanes],
                                                        std::size_t offset) {
    if constexpr (kLanes == 8) {
      // Row i in the lower half, row i + 4 in the upper one.
      const auto rows = [&](int i) __attribute__((always_inline)) {
        return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(base[i] + offset)),
                                  _mm256_loadu_pd(base[i + 4] + offset), 1);
      };
      const __m512d r0 = rows(0), r1 = rows(1), r2 = rows(2), r3 = rows(3);
      const __m512d first = _mm512_unpacklo_pd(r0, r1), second = _mm512_unpackhi_pd(r0, r1);
      const __m512d third = _mm512_unpacklo_pd(r2, r3), fourth = _mm512_unpackhi_pd(r2, r3);
      const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
      const __m512i upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
      return {{static_cast<Lanes>(_mm512_permutex2var_pd(first, lower, third)),
               static_cast<Lanes>(_mm512_permutex2var_pd(second, lower, fourth)),
               static_cast<Lanes>(_mm512_permutex2var_pd(first, upper, third))}};
    }
    if constexpr (kLanes == 4) {
      const auto row = [&](int i) __attribute__((always_inline)) {
        return _mm256_loadu_pd(base[i] + offset);
      };
      const __m256d r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
      const __m256d first = _mm256_unpacklo_pd(r0, r1), second = _mm256_unpackhi_pd(r0, r1);
      const __m256d third = _mm256_unpacklo_pd(r2, r3), fourth = _mm256_unpackhi_pd(r2, r3);
      return {{static_cast<Lanes>(_mm256_permute2f128_pd(first, third, 0x20)),
               static_cast<Lanes>(_mm256_permute2f128_pd(second, fourth, 0x20)),
               static_cast<Lanes>(_mm256_permute2f128_pd(first, third, 0x31))}};
    }
  }

  /// `kEnd`: with everything that is asked of the last evaluation.
  template <bool kEnd>
  __attribute__((always_inline)) static void rhs(Batch& b, const Lanes* z, Lanes* d) {
    const Lanes angle = b.speed_ * (z[4] - b.anchor_time_);
    const Lanes square = angle * angle;
    const Lanes fourth = square * square;
    const Lanes sine = angle + (angle * square) * ((-1.0 / 6 + square * (1.0 / 120)) +
                                                   fourth * (-1.0 / 5040 + square * (1.0 / 362880)));
    const Lanes less =
        square * ((-0.5 + square * (1.0 / 24)) + fourth * (-1.0 / 720 + square * (1.0 / 40320)));
    Lanes ec = b.anchor_cosine_ + (b.anchor_cosine_ * less - b.anchor_sine_ * sine);
    Lanes es = b.anchor_sine_ + (b.anchor_sine_ * less + b.anchor_cosine_ * sine);
    const Lanes u = z[5];
    const Lanes size = magnitude(u);
    const double* base[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      if (!(square[i] < 0.0039)) [[unlikely]] {
        const LaneSystem& system = *b.request_[static_cast<std::size_t>(i)].system;
        const solve::BladeSet& blades = *(system.*member(Blades{}));
        const auto er = blades.direction((system.*member(Contact{})).blade, blades.first(z[4][i]));
        ec[i] = er.cosine;
        es[i] = er.sine;
      }
      const blade::ElasticaCurve& curve = *b.curve_[static_cast<std::size_t>(i)];
      base[i] = &(curve.*member(Pieces{}))[(curve.*member(Index{}))(size[i])].centre;
    }
    using Piece = std::remove_cvref_t<decltype((b.curve_[0]->*member(Pieces{}))[0])>;
    constexpr std::size_t kFirst = offsetof(Piece, coefficients) / sizeof(double);
    Lanes centre, inverse;
    for (int i = 0; i < kLanes; ++i) {
      centre[i] = base[i][0];
      inverse[i] = base[i][1];
    }
    const Lanes t = (size - centre) * inverse;
    const Lanes t2 = t * t;
    Columns even = columns(base, kFirst + 40), odd = columns(base, kFirst + 44);
    Lanes even_slope[3] = {}, odd_slope[3] = {}, value[3], slope[3];
#pragma GCC unroll 5
    for (std::size_t k = 10; k >= 2; k -= 2) {
      const Columns next_even = columns(base, kFirst + 4 * (k - 2));
      const Columns next_odd = columns(base, kFirst + 4 * (k - 1));
      for (std::size_t m = 0; m < 3; ++m) {
        even_slope[m] = even_slope[m] * t2 + even.column[m];
        odd_slope[m] = odd_slope[m] * t2 + odd.column[m];
        even.column[m] = even.column[m] * t2 + next_even.column[m];
        odd.column[m] = odd.column[m] * t2 + next_odd.column[m];
      }
    }
    for (std::size_t m = 0; m < 3; ++m) {
      value[m] = even.column[m] + t * odd.column[m];
      slope[m] = (odd.column[m] + (2.0 * t) * (even_slope[m] + t * odd_slope[m])) * inverse;
    }
    const Lanes one = Lanes{} + 1.0;
    const Lanes sign = u < 0.0 ? -one : one;
    const Lanes parity = u < 0.0 ? b.mirror_ : one;
    value[2] *= parity;
    slope[1] *= sign;
    slope[2] *= sign * parity;
    const Lanes cy = z[1] + b.misalignment_;
    const Lanes radial = z[0] * ec + cy * es, tangential = cy * ec - z[0] * es;
    const Lanes vr = z[2] * ec + z[3] * es, vt = z[3] * ec - z[2] * es;
    const Lanes shortening = b.length_ * value[1], deflection = b.length_ * value[2];
    const Lanes A = radial + b.reach_ - shortening;
    const Lanes B = tangential - b.slip_ * deflection;
    const Lanes bending_slope = (-2.0 * b.length_) * (A * slope[1] + b.slip_ * B * slope[2]);
    const Lanes time_slope = 2.0 * A * (vr + b.speed_ * tangential) + 2.0 * B * (vt - b.speed_ * radial);
    const Lanes inverse_distance = 1.0 / root(A * A + B * B);
    const Lanes nr = A * inverse_distance, nt = B * inverse_distance;
    const Lanes load = b.load_unit_ * value[0];
    const Lanes friction = b.slip_ * b.friction_ * load;
    const Lanes fr = -load * nr + friction * nt, ft = -load * nt - friction * nr;
    const Lanes rate = -b.scale_ * bending_slope;
    const Lanes ax = (fr * ec - ft * es) * b.force_unit_ - b.damping_ * z[2] - z[0];
    const Lanes ay = (fr * es + ft * ec) * b.force_unit_ - b.damping_ * z[3] - z[1];
    d[0] = rate * z[2];
    d[1] = rate * z[3];
    d[2] = rate * ax;
    d[3] = rate * ay;
    d[4] = rate;
    d[5] = b.scale_ * time_slope;
    if constexpr (kEnd) {
      const Lanes gap = z[0] * z[0] + cy * cy + 2.0 * b.reach_ * radial + b.closing_;
      b.force_radial_ = fr;
      b.force_tangential_ = ft;
      b.load_ = load;
      b.shortening_ = value[1];
      b.root_strain_ = b.strain_unit_ * value[0] * (value[2] + b.friction_ * (1.0 - value[1]));
      b.slip_velocity_ =
          nr * vt - nt * vr + b.speed_ * ((b.reach_ - shortening) * nr - b.slip_ * deflection * nt);
      b.residual_ = gap + shortening * (shortening - 2.0 * (radial + b.reach_)) +
                    deflection * (deflection - 2.0 * b.slip_ * tangential);
      b.bending_slope_ = bending_slope;
      b.time_slope_ = time_slope;
      b.acceleration_x_ = ax;
      b.acceleration_y_ = ay;
    }
  }

  template <std::size_t kRow>
  __attribute__((always_inline)) static void state(const Batch& b, Lanes* z) {
    for (int c = 0; c < 6; ++c) {
      Lanes sum{};
      bool first = true;
#pragma GCC unroll 12
      for (std::size_t j = 0; j < 12; ++j) {
        const double w = kRow == 12 ? Pair::kWeight[j] : Pair::kStage[kRow][j];
        if (w == 0.0) continue;
        sum = first ? w * b.stages_[j][c] : sum + w * b.stages_[j][c];
        first = false;
      }
      z[c] = b.start_[c] + b.size_ * sum;
    }
  }

  // One copy of the right-hand side for the eleven stages: twelve would not fit the instruction cache.
  __attribute__((noinline)) static void stage(Batch& b, const Lanes* z, Lanes* d) {
    rhs<false>(b, z, d);
  }

  template <std::size_t... kI>
  __attribute__((always_inline)) static void stages(Batch& b, std::index_sequence<kI...>) {
    Lanes z[6];
    ((state<kI + 1>(b, z), stage(b, z, b.stages_[kI + 1])), ...);
  }
};

template <int kLanes>
void ContactLanes<kLanes>::pack(std::span<const LaneRequest> requests) {
  count_ = static_cast<int>(requests.size());
  for (int i = 0; i < kLanes; ++i) {
    const LaneRequest& r = requests[i < count_ ? static_cast<std::size_t>(i) : 0];
    const LaneSystem& system = *r.system;
    const Law& law = *(system.*member(OfLaw{}));
    const solve::RotorConstants& rotor = *(system.*member(Rotor{}));
    const auto& anchor = system.*member(Anchor{});
    request_[static_cast<std::size_t>(i)] = r;
    curve_[static_cast<std::size_t>(i)] = &law.curve();
    for (int c = 0; c < 6; ++c) {
      start_[c][i] = r.step->start()[c];
      stages_[0][c][i] = r.step->start_derivative()[c];
    }
    size_[i] = r.size;
    speed_[i] = rotor.speed_ratio;
    damping_[i] = 2.0 * rotor.damping_ratio;
    force_unit_[i] = rotor.force_unit;
    misalignment_[i] = rotor.misalignment;
    reach_[i] = law.geometry().reach;
    closing_[i] = law.geometry().closing();
    length_[i] = law.*member(Length{});
    load_unit_[i] = law.*member(LoadUnit{});
    strain_unit_[i] = law.*member(StrainUnit{});
    friction_[i] = law.curve().friction();
    mirror_[i] = law.curve().*member(Mirror{});
    scale_[i] = system.*member(Scale{});
    slip_[i] = (system.*member(Contact{})).slip;
    anchor_time_[i] = system.*member(AnchorTime{});
    anchor_cosine_[i] = anchor.cosine;
    anchor_sine_[i] = anchor.sine;
  }
}

template <int kLanes>
void ContactLanes<kLanes>::attempt() {
  Arithmetic::stages(*this, std::make_index_sequence<11>{});
  Arithmetic::template state<12>(*this, end_);
  Arithmetic::template rhs<true>(*this, end_, stages_[12]);
}

template <int kLanes>
std::array<bool, kLanes> ContactLanes<kLanes>::unpack() {
  std::array<bool, kLanes> finite{};
  for (int i = 0; i < count_; ++i) {
    const LaneRequest& r = request_[static_cast<std::size_t>(i)];
    auto& stages = r.step->*member(StepStages{});
    for (std::size_t s = 1; s < 13; ++s) {
      for (int c = 0; c < 6; ++c) stages[s][c] = stages_[s][c][i];
    }
    auto& end = r.step->*member(StepEnd{});
    bool all = true;
    for (int c = 0; c < 6; ++c) {
      end[c] = end_[c][i];
      all = all && std::isfinite(end[c]);
    }
    finite[static_cast<std::size_t>(i)] = all;
    r.step->*member(StepSize{}) = r.size;
    r.step->*member(DenseReady{}) = false;
    LaneSystem& system = *r.system;
    system.*member(Last{}) = {{force_radial_[i], force_tangential_[i], load_[i], shortening_[i],
                               root_strain_[i], slip_velocity_[i]},
                              residual_[i],
                              bending_slope_[i],
                              time_slope_[i]};
    system.*member(Acceleration{}) = {acceleration_x_[i], acceleration_y_[i]};
    system.*member(Evaluations{}) += 12;
    const_cast<Law&>(*(system.*member(OfLaw{}))).*member(LawEvaluations{}) += 12;
  }
  return finite;
}

template class ContactLanes<4>;
template class ContactLanes<8>;
#pragma GCC pop_options

}  // namespace rubatlas::bench
