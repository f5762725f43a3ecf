// Eight lanes.

#ifdef __AVX512F__
#include <immintrin.h>

#include "batch/lane_motion.hpp"

namespace rubatlas::batch {
namespace {

struct Avx512 {
  static constexpr int kLanes = 8;
  /// Row i in the lower half, row i + 4 in the upper one.
  static __m512d two_rows(const double* lower, const double* upper) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(lower)), _mm256_loadu_pd(upper), 1);
  }
  /// As in four lanes.
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see lane_block.hpp
  static CurveColumns<8> columns(const double* const (&rows)[8], std::size_t offset) {
    const __m512d r0 = two_rows(rows[0] + offset, rows[4] + offset);
    const __m512d r1 = two_rows(rows[1] + offset, rows[5] + offset);
    const __m512d r2 = two_rows(rows[2] + offset, rows[6] + offset);
    const __m512d r3 = two_rows(rows[3] + offset, rows[7] + offset);
    const __m512d first = _mm512_unpacklo_pd(r0, r1), second = _mm512_unpackhi_pd(r0, r1);
    const __m512d third = _mm512_unpacklo_pd(r2, r3), fourth = _mm512_unpackhi_pd(r2, r3);
    const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    return {Lanes<8>(_mm512_permutex2var_pd(first, lower, third)),
            Lanes<8>(_mm512_permutex2var_pd(second, lower, fourth)),
            Lanes<8>(_mm512_permutex2var_pd(first, upper, third))};
  }
};

}  // namespace

void attempt_avx512(LaneBlock<8>& block) {
  LaneMotion<Avx512>(block).attempt();
}

}  // namespace rubatlas::batch

#else
#include "batch/lane_block.hpp"

namespace rubatlas::batch {
void attempt_avx512(LaneBlock<8>& /*block*/) {}  // no processor of this kind asks for it
}  // namespace rubatlas::batch
#endif
