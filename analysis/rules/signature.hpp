/// Signs of rubbing blades in the spectrum, and whether they come before the displacement passes a limit.
///
/// The rule is in the README of this folder, "Signature". The Python package measures spectra by the same
/// rule (`rubatlas.signature`), and a test holds one against the other.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

/// Half width of a line at a whole order [orders]; no less than this many bins, over which a window spreads a
/// line.
constexpr double kLineHalfWidth = 0.05;
constexpr double kLineBins = 2.0;
/// Widest distance of two orders at which something is left between the lines.
constexpr double kCoarsestOrders = 0.125;
/// A sign is raised where a height grows by this factor (8 dB) from one stretch of kTriggerStretch to the
/// next.
constexpr double kSignRise = 2.5;
/// Share of the limit below which heights count as equal: a monitor with a range of 60 dB sees no less.
constexpr double kSeenShareOfLimit = 1e-3;

/// In the order of `SignHeights`.
constexpr std::array<std::string_view, 3> kSignNames{"passing_line", "broad_band", "subharmonic"};
/// Height [m] of the n× line, of the broad band, and of the highest line between the whole orders.
using SignHeights = std::array<double, kSignNames.size()>;

/// Whether a spectrum over these orders, which ascend evenly from 0, resolves the lines and reaches 2n×.
[[nodiscard]] bool shows_signs(std::span<const double> orders, int blades);

/// The heights in one spectrum, NaN in one that is not known.
[[nodiscard]] SignHeights sign_heights(std::span<const double> orders, std::span<const double> amplitudes,
                                       int blades);

/// All spans have one entry per speed, ascending in Ω.
struct SignLine {
  std::span<const double> speed_ratio;  ///< Ω [-]
  std::span<const double>
      displacement;  ///< [m]; infinite where the motion left the model, NaN where not known
  std::span<const SignHeights> heights;  ///< NaN where not known
};

struct Announcement {
  double speed_ratio =
      kNotANumber;              ///< Ω [-] at which the sign was raised that stands at the limit; NaN: none
  std::size_t false_signs = 0;  ///< raised and withdrawn before, or with no passing of the limit after it
  bool is_judged = false;       ///< levels that could show a sign are known somewhere below the limit
};

struct LineSignature {
  double limit = kNotANumber;              ///< [m]
  double limit_speed_ratio = kNotANumber;  ///< first Ω [-] known to be beyond it; NaN: none
  std::array<Announcement, kSignNames.size()> signs{};
  Announcement displacement{};  ///< the same rule on the displacement itself, for comparison
  /// The point right below the passing is known and below the limit: else the limit may be passed earlier.
  bool passing_is_seen = false;
  bool is_kept = false;  ///< the displacement is known everywhere, and nowhere beyond the limit

  /// Ω [-] of the earliest sign that stands at the limit; NaN where none does.
  [[nodiscard]] double announced() const;
};

[[nodiscard]] LineSignature find_signs(const SignLine& line, double limit, SpeedScale scale);

}  // namespace rubatlas::analysis
