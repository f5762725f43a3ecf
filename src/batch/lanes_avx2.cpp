// Four lanes.

#include "batch/lane_block.hpp"

#ifdef __x86_64__
#include <immintrin.h>
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#include "batch/lane_arithmetic.hpp"

namespace rubatlas::batch {
namespace {

struct Avx2 {
  static constexpr int kLanes = 4;
  using Lanes = LaneVector<4>::Type;
  __attribute__((always_inline)) static Lanes magnitude(Lanes x) {
    return static_cast<Lanes>(_mm256_andnot_pd(_mm256_set1_pd(-0.0), static_cast<__m256d>(x)));
  }
  __attribute__((always_inline)) static Lanes root(Lanes x) {
    return static_cast<Lanes>(_mm256_sqrt_pd(static_cast<__m256d>(x)));
  }
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see lane_block.hpp
  __attribute__((always_inline)) static Columns<4> columns(const double* const (&rows)[4],
                                                           std::size_t offset) {
    const __m256d r0 = _mm256_loadu_pd(rows[0] + offset), r1 = _mm256_loadu_pd(rows[1] + offset);
    const __m256d r2 = _mm256_loadu_pd(rows[2] + offset), r3 = _mm256_loadu_pd(rows[3] + offset);
    const __m256d first = _mm256_unpacklo_pd(r0, r1), second = _mm256_unpackhi_pd(r0, r1);
    const __m256d third = _mm256_unpacklo_pd(r2, r3), fourth = _mm256_unpackhi_pd(r2, r3);
    return {{static_cast<Lanes>(_mm256_permute2f128_pd(first, third, 0x20)),
             static_cast<Lanes>(_mm256_permute2f128_pd(second, fourth, 0x20)),
             static_cast<Lanes>(_mm256_permute2f128_pd(first, third, 0x31))}};
  }
};

}  // namespace

void attempt_avx2(LaneBlock<4>& block) {
  LaneArithmetic<Avx2>::attempt(block);
}

}  // namespace rubatlas::batch
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#else
namespace rubatlas::batch {
void attempt_avx2(LaneBlock<4>& /*block*/) {}  // no processor of this kind asks for it
}  // namespace rubatlas::batch
#endif
