/// The results of the analysis of one atlas, from which the text, the Markdown and MAPS.h5 are written.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/rules/basins.hpp"
#include "analysis/rules/borders.hpp"
#include "analysis/rules/class.hpp"
#include "analysis/rules/exponent_check.hpp"
#include "analysis/rules/hysteresis.hpp"
#include "analysis/rules/line_summary.hpp"
#include "analysis/rules/margin_map.hpp"
#include "analysis/rules/parameter.hpp"
#include "analysis/rules/sensitivity.hpp"
#include "analysis/rules/signature.hpp"
#include "plan/grid.hpp"
#include "settings/scene.hpp"

namespace rubatlas::analysis {

/// The attribute of maps and edges that keeps `Findings::points_finished`.
constexpr const char* kPointsFinished = "points_finished";

struct Findings {
  settings::Scene scene;
  std::vector<plan::Axis> axes;  ///< of the atlas, `speed_ratio` last
  std::vector<Parameter> parameters;
  std::vector<ClosingTolerance> tolerance;    ///< one per line, since lengths may be swept
  std::array<std::size_t, 4> status_count{};  ///< points pending, done, left validity, integrator failed
  std::vector<std::uint8_t> motion;           ///< class per revolution, one per point
  std::vector<std::uint8_t>
      motion_per_passing;                ///< class per blade passing; empty where there are no sections
  std::vector<double> max_displacement;  ///< [m] one per point; empty where the atlas has none
  /// Attractor of every point, numbered among the points that differ in their start only; empty where there
  /// are no such points, or where the atlas lacks sections or displacements.
  std::vector<std::int32_t> attractor;
  std::vector<Basin> basins;             ///< empty where the initial state is no axis
  std::optional<Hysteresis> hysteresis;  ///< of a sweep both ways
  bool sweeps_initial_state = false;     ///< the initial state is an axis
  bool has_sections = false;             ///< the atlas keeps `poincare`
  bool keeps_nearest_miss = false;       ///< the atlas keeps `nearest_miss`
  std::vector<LineSummary> lines;
  std::vector<Sensitivity> sensitivities;  ///< of lines from one initial state: empty where that is an axis
  std::optional<Margins> margins{};        ///< where motions have classes
  std::vector<ExponentCheck> exponent_check{};  ///< one per point; empty where the atlas has no exponents
  /// Signs in the spectrum: per point, and per line against the limit. Empty where the initial state is an
  /// axis, or where the atlas lacks displacements or spectra that resolve the lines up to 2n×.
  std::vector<SignHeights> sign_heights{};
  std::vector<LineSignature> signatures{};
  std::optional<EdgeTable> edges{};  ///< where they have been computed (`rubatlas edges`)

  /// Points of the atlas that have rows: what is found of fewer points is not what the atlas shows.
  [[nodiscard]] std::int64_t points_finished() const {
    const auto& [pending, done, left, failed] = status_count;
    return static_cast<std::int64_t>(done + left + failed);
  }
};

}  // namespace rubatlas::analysis
