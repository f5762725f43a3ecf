/// Eight numbers, one at each node, in parts of as many as a register holds.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <experimental/simd>

#include "collocation/nodes.hpp"

namespace rubatlas::collocation {
namespace {

namespace simd = std::experimental;

// What stays a function of its own costs more than it does: a sweep is some hundred operations. (Sanitizers
// check each of these operations, and compile for minutes what is inlined throughout.)
#ifdef RUBATLAS_SANITIZED
#define RUBATLAS_INLINE inline
#define RUBATLAS_INLINED
#else
#define RUBATLAS_INLINE [[gnu::always_inline]] inline
#define RUBATLAS_INLINED __attribute__((always_inline))  // of a lambda
#endif

template <std::size_t kWidth>
class Lanes {
 public:
  using Part = simd::simd<double, simd::simd_abi::deduce_t<double, kWidth>>;
  static constexpr std::size_t kParts = kNodes / kWidth;

  Lanes() = default;
  // A number is the same at all nodes. NOLINTNEXTLINE(google-explicit-constructor)
  Lanes(double number) { part_.fill(Part(number)); }
  RUBATLAS_INLINE explicit Lanes(const AtNodes& at) : Lanes(loaded(at.value.data())) {}
  RUBATLAS_INLINE void store(AtNodes& at) const { store_to(at.value.data()); }
  /// From, and to, eight numbers on a boundary of 64 bytes.
  RUBATLAS_INLINE static Lanes loaded(const double* from) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return Part(from + i * kWidth, simd::vector_aligned); });
  }
  RUBATLAS_INLINE void store_to(double* to) const {
    for (std::size_t i = 0; i < kParts; ++i) part_[i].copy_to(to + i * kWidth, simd::vector_aligned);
  }

  RUBATLAS_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return a.part_[i] + b.part_[i]; });
  }
  RUBATLAS_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return a.part_[i] - b.part_[i]; });
  }
  RUBATLAS_INLINE friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return a.part_[i] * b.part_[i]; });
  }
  RUBATLAS_INLINE friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return a.part_[i] / b.part_[i]; });
  }
  RUBATLAS_INLINE friend Lanes larger(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return simd::max(a.part_[i], b.part_[i]); });
  }
  RUBATLAS_INLINE friend Lanes smaller(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return simd::min(a.part_[i], b.part_[i]); });
  }
  RUBATLAS_INLINE friend Lanes magnitude(const Lanes& a) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return simd::abs(a.part_[i]); });
  }
  /// The magnitude of a with the sign of b.
  RUBATLAS_INLINE friend Lanes with_sign_of(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return simd::copysign(a.part_[i], b.part_[i]); });
  }
  /// Without what follows the point. The numbers are within the range of an int.
  RUBATLAS_INLINE friend Lanes whole(const Lanes& a) {
    return of([&](std::size_t i) RUBATLAS_INLINED {
      using Whole = simd::rebind_simd_t<int, Part>;
      return simd::static_simd_cast<Part>(simd::static_simd_cast<Whole>(a.part_[i]));
    });
  }
  RUBATLAS_INLINE friend Lanes root(const Lanes& a) {
    return of([&](std::size_t i) RUBATLAS_INLINED { return simd::sqrt(a.part_[i]); });
  }
  /// The least of the eight.
  [[nodiscard]] RUBATLAS_INLINE double least() const {
    Part part = part_[0];
    for (std::size_t i = 1; i < kParts; ++i) part = simd::min(part, part_[i]);
    return simd::hmin(part);
  }
  /// The largest of the eight.
  [[nodiscard]] RUBATLAS_INLINE double largest() const {
    Part part = part_[0];
    for (std::size_t i = 1; i < kParts; ++i) part = simd::max(part, part_[i]);
    return simd::hmax(part);
  }

  /// From a function that gives the number at node j.
  template <class Function>
  RUBATLAS_INLINE static Lanes each(Function function) {
    return of([&](std::size_t i) RUBATLAS_INLINED {
      return Part([&](auto lane) RUBATLAS_INLINED { return function(i * kWidth + lane); });
    });
  }

  /// Sum over j of the columns, each times the number at node j.
  RUBATLAS_INLINE static Lanes combined(const std::array<AtNodes, kNodes>& columns, const Lanes& factors) {
    // Not set to zero first. NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
    alignas(64) double stored[kNodes];
    factors.store_to(stored);
    const double* const factor = &stored[0];
    return of([&](std::size_t i) RUBATLAS_INLINED {
      Part even = column_part(columns[0], i) * factor[0];
      Part odd = column_part(columns[1], i) * factor[1];
      for (std::size_t j = 2; j < kNodes; j += 2) {
        even += column_part(columns[j], i) * factor[j];
        odd += column_part(columns[j + 1], i) * factor[j + 1];
      }
      return even + odd;
    });
  }

 private:
  template <class Function>
  RUBATLAS_INLINE static Lanes of(Function function) {
    Lanes result;
    for (std::size_t i = 0; i < kParts; ++i) result.part_[i] = function(i);
    return result;
  }
  RUBATLAS_INLINE static Part column_part(const AtNodes& column, std::size_t part) {
    return Part(column.value.data() + part * kWidth, simd::vector_aligned);
  }

  std::array<Part, kParts> part_;
};

}  // namespace
}  // namespace rubatlas::collocation
