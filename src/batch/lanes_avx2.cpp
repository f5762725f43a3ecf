// Four lanes.

#ifdef __AVX2__
#include <immintrin.h>

#include "batch/lane_motion.hpp"

namespace rubatlas::batch {
namespace {

struct Avx2 {
  static constexpr int kLanes = 4;
  /// Rows of four, the fourth of no interest, are loaded and turned into columns: a gather loads one number
  /// at a time.
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see lane_block.hpp
  static CurveColumns<4> columns(const double* const (&rows)[4], std::size_t offset) {
    const __m256d r0 = _mm256_loadu_pd(rows[0] + offset), r1 = _mm256_loadu_pd(rows[1] + offset);
    const __m256d r2 = _mm256_loadu_pd(rows[2] + offset), r3 = _mm256_loadu_pd(rows[3] + offset);
    const __m256d first = _mm256_unpacklo_pd(r0, r1), second = _mm256_unpackhi_pd(r0, r1);
    const __m256d third = _mm256_unpacklo_pd(r2, r3), fourth = _mm256_unpackhi_pd(r2, r3);
    return {Lanes<4>(_mm256_permute2f128_pd(first, third, 0x20)),
            Lanes<4>(_mm256_permute2f128_pd(second, fourth, 0x20)),
            Lanes<4>(_mm256_permute2f128_pd(first, third, 0x31))};
  }
};

}  // namespace

void attempt_avx2(LaneBlock<4>& block) {
  LaneMotion<Avx2>(block).attempt();
}

}  // namespace rubatlas::batch

#else
#include "batch/lane_block.hpp"

namespace rubatlas::batch {
void attempt_avx2(LaneBlock<4>& /*block*/) {}  // no processor of this kind asks for it
}  // namespace rubatlas::batch
#endif
