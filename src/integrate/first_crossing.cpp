#include "integrate/first_crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "integrate/root_between.hpp"

namespace rubatlas::integrate {
namespace {

/// The polynomial of degree 7 through samples of a function in an interval, at the zeros of a Chebyshev
/// polynomial. The ends are not among them, so that a function may be a quotient that is 0/0 there.
class SampledFunction {
 public:
  static constexpr std::size_t kSamples = 8;

  SampledFunction(FunctionView function, double low, double high) {
    std::array<double, kSamples> samples{};
    for (std::size_t j = 0; j < kSamples; ++j) {
      const double sample = function(0.5 * ((low + high) + (high - low) * cosine(2 * j + 1)));
      samples[j] = sample;
      if (std::isfinite(sample)) ++count_;
      largest_ = std::max(largest_, std::abs(sample));
    }
    for (std::size_t k = 0; k < kSamples; ++k) {
      double sum = 0.0;
      for (std::size_t j = 0; j < kSamples; ++j) sum += samples[j] * cosine(k * (2 * j + 1));
      coefficients_[k] = (k == 0 ? 1.0 : 2.0) / kSamples * sum;
    }
    for (std::size_t k = 1; k < kSamples; ++k) {
      const double size = std::abs(coefficients_[k]);
      swing_ += size;
      if (k > 1) bend_ += static_cast<double>(k * k) * size;
      if (k + 2 >= kSamples) doubt_ += size;
    }
  }

  /// How many samples are finite numbers.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// The largest |sample|.
  [[nodiscard]] double largest() const { return largest_; }
  /// Upper bound of the function.
  [[nodiscard]] double greatest() const { return coefficients_[0] + swing_ + doubt_; }
  /// Whether the function rises throughout the interval, or falls throughout.
  [[nodiscard]] bool monotonic() const {
    return std::abs(coefficients_[1]) > bend_ + static_cast<double>(kSamples * kSamples) * doubt_;
  }
  /// The polynomial at the lower end; the function may differ from it by `doubt`.
  [[nodiscard]] double at_low() const {
    double value = 0.0;
    for (std::size_t k = kSamples; k-- > 0;) value = coefficients_[k] - value;
    return value;
  }
  [[nodiscard]] double doubt() const { return doubt_; }

 private:
  /// cos(π i / 16).
  static double cosine(std::size_t i) {
    static const auto kCosines = [] {
      std::array<double, 4 * kSamples> table{};
      for (std::size_t j = 0; j < table.size(); ++j) {
        table[j] = std::cos(std::numbers::pi * static_cast<double>(j) / (2.0 * kSamples));
      }
      return table;
    }();
    return kCosines[i % kCosines.size()];
  }

  std::array<double, kSamples> coefficients_{};
  std::size_t count_ = 0;
  double largest_ = 0.0;
  double swing_ = 0.0;  ///< Σ |a_k| from k = 1
  double bend_ = 0.0;   ///< Σ k² |a_k| from k = 2
  double doubt_ = 0.0;  ///< the last two |a_k|: how far the function may be from its polynomial
};

/// The search in one step: see `first_crossing`.
class CrossingSearch {
 public:
  /// An interval and the values of the guard at its ends.
  struct Interval {
    double low;
    double high;
    double at_low;
    double at_high;
  };

  CrossingSearch(FunctionView guard, const Interval& whole, double rounding)
      : guard_(guard), shortest_(kResolution * (whole.high - whole.low)), rounding_(rounding) {}

  /// The first part of an interval between whose ends the guard passes from negative to positive. The guard
  /// must be negative at the start of the interval.
  std::optional<Interval> find(const Interval& interval) {
    const auto [low, high, at_low, at_high] = interval;
    const auto by_its_ends = [&interval] {
      return interval.at_high > 0.0 ? std::optional(interval) : std::nullopt;
    };
    if (high - low <= shortest_ || ++count_ > kMostIntervals) return by_its_ends();
    const SampledFunction sampled(guard_, low, high);
    if (sampled.count() == 0) return std::nullopt;
    if (sampled.count() == SampledFunction::kSamples) {
      rounding_ = std::max(rounding_, kRounding * sampled.largest());
      if (sampled.greatest() <= rounding_ || sampled.monotonic()) return by_its_ends();
    }
    const double middle = 0.5 * (low + high);
    const double at_middle = guard_(middle);
    const auto first = find({low, middle, at_low, at_middle});
    return first ? first : find({middle, high, at_middle, at_high});
  }

 private:
  /// Of the step: a guard that passes zero and comes back within this length is not seen.
  static constexpr double kResolution = 1.0 / (1 << 20);
  static constexpr double kRounding = 1e-15;  ///< of the largest sample
  /// Some tens are enough near a double root; more are needed only where a guard consists of rounding.
  static constexpr int kMostIntervals = 1000;

  FunctionView guard_;
  double shortest_;
  double rounding_;
  int count_ = 0;
};

}  // namespace

std::optional<double> first_crossing(FunctionView guard, double low, double high, double at_low,
                                     double at_high, double rounding) {
  if (at_low > 0.0) return low;
  if (!(low < high)) return std::nullopt;
  std::optional<double> root;
  CrossingSearch::Interval before{low, high, at_low, at_high};
  if (at_high > 0.0) {
    // The signs show that there is a root; the search below finds out whether it is the first.
    root = root_between(guard, low, high, at_low, at_high);
    before = {low, *root, at_low, 0.0};
    if (!(low < *root)) return root;
  }
  const auto found = CrossingSearch(guard, before, rounding).find(before);
  if (!found) return root;
  return root_between(guard, found->low, found->high, found->at_low, found->at_high);
}

std::optional<double> first_sign_change(FunctionView function, double low, double high, double at_high) {
  constexpr int kHalvings = 20;
  double at_low = 0.0;
  double end = high;
  for (int i = 0; i < kHalvings; ++i) {
    const SampledFunction start(function, low, end);
    at_low = start.at_low();
    if (std::abs(at_low) > 4.0 * start.doubt()) break;
    end = 0.5 * (low + end);
  }
  const double sign = at_low > 0.0 ? -1.0 : 1.0;
  const auto guard = [&](double place) { return sign * function(place); };
  return first_crossing(guard, low, high, sign * at_low, sign * at_high);
}

std::optional<double> first_top(FunctionView slope, double low, double high, double at_low, double at_high) {
  if (at_low > 0.0) {
    return first_crossing([&](double place) { return -slope(place); }, low, high, -at_low, -at_high);
  }
  const auto bottom = first_crossing(slope, low, high, at_low, at_high);
  if (!bottom || !(*bottom < high)) return std::nullopt;
  const auto mean = [&](double place) { return slope(place) / (place - *bottom); };
  return first_sign_change(mean, *bottom, high, at_high / (high - *bottom));
}

}  // namespace rubatlas::integrate
