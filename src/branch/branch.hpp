/// A branch of periodic orbits, and the bifurcations on it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "observables/grazing.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::branch {

/// A closed orbit.
struct Orbit {
  motion::SectionState section{};  ///< at phase 0: x, y [m], x', y' [m per unit τ]
  std::vector<double> quantities;  ///< that vary, in their units
  int period = 1;                  ///< in revolutions
  int passings = 1;                ///< of blades, after which the section repeats itself
  point::SectionMap map;           ///< from where the orbit is cut to the next cut
  Eigen::Vector4d mismatch;        ///< by how much it does not close [clearances, and clearances per unit τ]
  bool admissible = true;          ///< every tip that touches does so where the orbit says
  Eigen::Vector4cd multipliers;    ///< Floquet, the largest first
  int cuts = 1;  ///< in a period, after each of which the motion repeats itself with other blades
  /// A small difference δ of the scaled unknowns at a cut has become δ' at the next, forward δ = backward δ'.
  /// Both are finite at a grazing, where a multiplier is not.
  Eigen::Matrix4d forward;
  Eigen::Matrix4d backward = Eigen::Matrix4d::Identity();

  [[nodiscard]] bool is_stable() const { return std::abs(multipliers[0]) < 1.0; }
};

enum class EventKind : std::uint8_t {
  fold = 1,             ///< a multiplier passes +1, and the branch turns back
  period_doubling = 2,  ///< a multiplier from cut to cut passes −1
  neimark_sacker = 3,   ///< a pair of complex multipliers passes the unit circle
  grazing = 4,          ///< a tip that passes touches, or a contact vanishes
  lost = 5              ///< the branch cannot be followed beyond, and it is none of these
};
inline constexpr std::string_view kEventKinds = "fold period_doubling neimark_sacker grazing lost";

inline constexpr std::array<std::string_view, 5> kEventWords{"fold", "period_doubling", "neimark_sacker",
                                                             "grazing", "lost"};
/// The word of a kind, as `--curve` names it.
inline std::string_view word_of(EventKind kind) {
  return kEventWords[static_cast<std::size_t>(kind) - 1];
}
inline std::optional<EventKind> kind_of(std::string_view word) {
  const auto* const found = std::ranges::find(kEventWords, word);
  if (found == kEventWords.end()) return std::nullopt;
  return static_cast<EventKind>(found - kEventWords.begin() + 1);
}

struct Event {
  EventKind kind;
  Orbit orbit;  ///< there, or the last that was found before a branch is lost
  observables::GrazingSide side = observables::GrazingSide::none;  ///< of a grazing
  double uncertainty = 0.0;  ///< of the first quantity: where it lies between two orbits, their distance
};

struct Branch {
  std::vector<Orbit> orbits;  ///< along the arclength
  std::vector<Event> events;
  bool goes_on = false;  ///< beyond its last orbit: no more orbits were asked for
};

/// Whether a branch that has so many orbits, of which this is the last, is followed further.
using GoOn = std::function<bool(std::size_t orbits, const Orbit& last)>;

}  // namespace rubatlas::branch
