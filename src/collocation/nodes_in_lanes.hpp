/// Eight numbers, one at each node, in parts of as many as a register holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "collocation/nodes.hpp"

/// Of a function whose calls are a few operations on registers each: all of them in one function take a sixth
/// fewer instructions. Registers of two numbers are too few to hold what that keeps in them: it would gain a
/// fiftieth, and take five times as much of the compiler's time.
#ifdef __AVX2__
#define RUBATLAS_IN_ONE_FUNCTION [[gnu::flatten]]
#else
#define RUBATLAS_IN_ONE_FUNCTION
#endif

namespace rubatlas::collocation {
namespace {

/// The vectors of the compiler, GCC or Clang, which has them for every processor.
template <class Value, std::size_t kWidth>
struct VectorOf {
  using Type [[gnu::vector_size(kWidth * sizeof(Value))]] = Value;
  /// In an array of such values, on a boundary of its size.
  using Place [[gnu::vector_size(kWidth * sizeof(Value)), gnu::may_alias]] = Value;
};
template <std::size_t kWidth>
auto loaded_part(const double* from) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): what the attribute is for
  return typename VectorOf<double, kWidth>::Type(
      *reinterpret_cast<const typename VectorOf<double, kWidth>::Place*>(from));
}

template <std::size_t kWidth>
class Lanes {
 public:
  using Part = typename VectorOf<double, kWidth>::Type;
  static constexpr std::size_t kParts = kNodes / kWidth;

  Lanes() = default;
  // A number is the same at all nodes. NOLINTNEXTLINE(google-explicit-constructor)
  Lanes(double number) {
    for (Part& part : part_) part = number - Part{};
  }
  explicit Lanes(const AtNodes& at) : Lanes(loaded(at.value.data())) {}
  void store(AtNodes& at) const { store_to(at.value.data()); }
  /// From, and to, eight numbers on a boundary of 64 bytes.
  static Lanes loaded(const double* from) {
    return of([&](std::size_t i) { return loaded_part<kWidth>(from + i * kWidth); });
  }
  void store_to(double* to) const {
    for (std::size_t i = 0; i < kParts; ++i) {
      // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): what the attribute is for
      *reinterpret_cast<typename VectorOf<double, kWidth>::Place*>(to + i * kWidth) = part_[i];
    }
  }

  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) { return a.part_[i] + b.part_[i]; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) { return a.part_[i] - b.part_[i]; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) { return a.part_[i] * b.part_[i]; });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) { return a.part_[i] / b.part_[i]; });
  }
  friend Lanes larger(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) { return larger_of(a.part_[i], b.part_[i]); });
  }
  friend Lanes smaller(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) { return smaller_of(a.part_[i], b.part_[i]); });
  }
  friend Lanes magnitude(const Lanes& a) {
    return of([&](std::size_t i) { return Part(Bits(a.part_[i]) & ~sign_bits()); });
  }
  /// The magnitude of a with the sign of b.
  friend Lanes with_sign_of(const Lanes& a, const Lanes& b) {
    return of([&](std::size_t i) {
      return Part((Bits(a.part_[i]) & ~sign_bits()) | (Bits(b.part_[i]) & sign_bits()));
    });
  }
  /// Without what follows the point. The numbers are within the range of an int.
  friend Lanes whole(const Lanes& a) {
    return of([&](std::size_t i) {
      return __builtin_convertvector(__builtin_convertvector(a.part_[i], Whole), Part);
    });
  }
  friend Lanes root(const Lanes& a) {
    return of([&](std::size_t i) {
      Part result = a.part_[i];
      for (std::size_t k = 0; k < kWidth; ++k) result[k] = __builtin_sqrt(result[k]);
      return result;
    });
  }
  /// The least of the eight.
  [[nodiscard]] double least() const {
    return of_all([](const auto& a, const auto& b) { return a < b ? a : b; });
  }
  /// The largest of the eight.
  [[nodiscard]] double largest() const {
    return of_all([](const auto& a, const auto& b) { return a > b ? a : b; });
  }

  /// The numbers of a register.
  Part& part(std::size_t number) { return part_[number]; }

  /// From a function that gives the number at node j.
  template <class Function>
  static Lanes each(Function function) {
    return of([&](std::size_t i) {
      Part result{};
      for (std::size_t k = 0; k < kWidth; ++k) result[k] = function(i * kWidth + k);
      return result;
    });
  }

  /// Sum over j of the columns, each times the number at node j.
  static Lanes combined(const std::array<AtNodes, kNodes>& columns, const Lanes& factors) {
    // Not set to zero first. NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
    alignas(64) double stored[kNodes];
    factors.store_to(stored);
    const double* const factor = &stored[0];
    return of([&](std::size_t i) {
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
  using Bits = typename VectorOf<std::int64_t, kWidth>::Type;
  using Whole = typename VectorOf<std::int32_t, kWidth>::Type;
  static Bits sign_bits() { return std::numeric_limits<std::int64_t>::min() - Bits{}; }
  static Part larger_of(const Part& a, const Part& b) { return a > b ? a : b; }
  static Part smaller_of(const Part& a, const Part& b) { return a < b ? a : b; }
  template <class OfTwo>
  double of_all(OfTwo of_two) const {
    Part part = part_[0];
    for (std::size_t i = 1; i < kParts; ++i) part = of_two(part, part_[i]);
    return of_halves(part, of_two);
  }
  template <class Register, class OfTwo>
  static double of_halves(const Register& all, OfTwo of_two) {
    if constexpr (sizeof all == 8 * sizeof(double)) {
      return of_halves(of_two(__builtin_shufflevector(all, all, 0, 1, 2, 3),
                              __builtin_shufflevector(all, all, 4, 5, 6, 7)),
                       of_two);
    } else if constexpr (sizeof all == 4 * sizeof(double)) {
      return of_halves(
          of_two(__builtin_shufflevector(all, all, 0, 1), __builtin_shufflevector(all, all, 2, 3)), of_two);
    } else {
      return of_two(all[0], all[1]);
    }
  }
  template <class Function>
  static Lanes of(Function function) {
    Lanes result;
    for (std::size_t i = 0; i < kParts; ++i) result.part_[i] = function(i);
    return result;
  }
  static Part column_part(const AtNodes& column, std::size_t part) {
    return loaded_part<kWidth>(column.value.data() + part * kWidth);
  }

  // Each [] of a std::array is a call to be inlined, of which a sweep has thousands: half of the compiler's
  // time. NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
  Part part_[kParts];
};

}  // namespace
}  // namespace rubatlas::collocation
