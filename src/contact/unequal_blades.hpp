/// Blades that are not alike: any contact law, with separate numbers for each blade.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rubatlas::contact {

/// `Law` is the law of one blade.
template <class Law>
class UnequalBlades {
 public:
  using OfBlade = Law;

  /// One law for each blade.
  explicit UnequalBlades(std::vector<Law> blades) : blades_(std::move(blades)) {}

  [[nodiscard]] int count() const { return static_cast<int>(blades_.size()); }
  [[nodiscard]] const Law& of(int blade) const { return blades_[static_cast<std::size_t>(blade)]; }

  /// The same blades, each shorter by what it has lost at its tip [m].
  [[nodiscard]] UnequalBlades shortened(std::span<const double> lost) const {
    UnequalBlades worn = *this;
    for (std::size_t k = 0; k < lost.size(); ++k) {
      if (lost[k] != 0.0) worn.blades_[k] = blades_[k].shortened(lost[k]);
    }
    return worn;
  }

  /// How often the curves of all blades have been evaluated.
  [[nodiscard]] std::uint64_t evaluations() const {
    std::uint64_t sum = 0;
    for (const Law& blade : blades_) sum += blade.evaluations();
    return sum;
  }

 private:
  std::vector<Law> blades_;
};

}  // namespace rubatlas::contact
