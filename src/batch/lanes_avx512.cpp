// Eight lanes.

#include "batch/lane_block.hpp"

#ifdef __x86_64__
#include <immintrin.h>
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,prefer-vector-width=512")
#endif
#include "batch/lane_arithmetic.hpp"

namespace rubatlas::batch {
namespace {

struct Avx512 {
  static constexpr int kLanes = 8;
  using Lanes = LaneVector<8>::Type;
  __attribute__((always_inline)) static Lanes magnitude(Lanes x) {
    return static_cast<Lanes>(_mm512_abs_pd(static_cast<__m512d>(x)));
  }
  __attribute__((always_inline)) static Lanes root(Lanes x) {
    return static_cast<Lanes>(_mm512_sqrt_pd(static_cast<__m512d>(x)));
  }
  /// Row i in the lower half, row i + 4 in the upper one.
  __attribute__((always_inline)) static __m512d two_rows(const double* lower, const double* upper) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(lower)), _mm256_loadu_pd(upper), 1);
  }
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see lane_block.hpp
  __attribute__((always_inline)) static Columns<8> columns(const double* const (&rows)[8],
                                                           std::size_t offset) {
    const __m512d r0 = two_rows(rows[0] + offset, rows[4] + offset);
    const __m512d r1 = two_rows(rows[1] + offset, rows[5] + offset);
    const __m512d r2 = two_rows(rows[2] + offset, rows[6] + offset);
    const __m512d r3 = two_rows(rows[3] + offset, rows[7] + offset);
    const __m512d first = _mm512_unpacklo_pd(r0, r1), second = _mm512_unpackhi_pd(r0, r1);
    const __m512d third = _mm512_unpacklo_pd(r2, r3), fourth = _mm512_unpackhi_pd(r2, r3);
    const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    return {{static_cast<Lanes>(_mm512_permutex2var_pd(first, lower, third)),
             static_cast<Lanes>(_mm512_permutex2var_pd(second, lower, fourth)),
             static_cast<Lanes>(_mm512_permutex2var_pd(first, upper, third))}};
  }
};

}  // namespace

void attempt_avx512(LaneBlock<8>& block) {
  LaneArithmetic<Avx512>::attempt(block);
}

}  // namespace rubatlas::batch
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#else
namespace rubatlas::batch {
void attempt_avx512(LaneBlock<8>& /*block*/) {}  // no processor of this kind asks for it
}  // namespace rubatlas::batch
#endif
