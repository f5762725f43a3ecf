/// What a motion starts from: the state of the shaft, and the memory of effects.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

namespace rubatlas::motion {

/// What effects remember from point to point besides the state, in the order of `observables::memories`.
/// Small enough to be part of any message.
class Memory {
 public:
  static constexpr std::size_t kMost = 64;  ///< numbers: enough for fifty blades and a ring

  Memory() = default;
  explicit Memory(std::span<const double> values) : count_(static_cast<std::uint32_t>(values.size())) {
    if (values.size() > kMost) throw std::length_error("effects remember too much");
    std::copy(values.begin(), values.end(), values_.begin());
  }
  [[nodiscard]] std::span<const double> view() const { return {values_.data(), count_}; }
  /// Bytes at the end of a Memory that hold no value.
  [[nodiscard]] std::size_t unused_bytes() const { return sizeof(double) * (kMost - count_); }

 private:
  std::uint32_t count_ = 0;
  std::array<double, kMost> values_{};
};

/// x, y [m], dx/dτ, dy/dτ [m]: the shaft centre at phase 0, from its own equilibrium (MODEL 1).
using SectionState = std::array<double, 4>;

/// What a point starts from.
struct PointStart {
  PointStart() = default;
  // A state alone is a start. NOLINTNEXTLINE(google-explicit-constructor)
  PointStart(const SectionState& from, const Memory& remembered = {}) : state(from), memory(remembered) {}
  SectionState state{};
  Memory memory;  ///< empty: as new
  // At phase 0, or where another blade is in the place of the first, or at a touch-down: `state` is that of
  // the shaft there, as the tip of the blade comes to the ring.
  double time = 0.0;  ///< τ of the first revolution
  int blade = -1;     ///< that touches down, from 0; −1: none
};

}  // namespace rubatlas::motion
