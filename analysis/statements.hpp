/// The paper's statements about its default rotor (MODEL 6.3, P1 to P8), each judged on what an atlas shows.
///
/// A statement is a list of findings, each true, false, or not covered by the atlas, and each with the
/// numbers it rests on. It agrees when all findings that are covered are true, disagrees when all are false,
/// else it holds partly. The thresholds are below, their reasons in the README of this folder, "Statements".
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/line.hpp"
#include "analysis/line_summary.hpp"
#include "analysis/parameter.hpp"
#include "scene/scene.hpp"

namespace rubatlas::analysis {

/// "At 1/3", "at 2/3", "right after": within this of it, in scaled speed.
constexpr double kSamePlace = 0.02;
/// Regions follow on each other, and "locally" is, within this scaled speed: one running window
/// (regions.hpp).
constexpr double kNextTo = 0.05;
/// A region is periodic up to this share of aperiodic points.
constexpr double kPeriodicShare = 0.05;
/// A displacement is small next to another below this ratio.
constexpr double kSmall = 0.1;

enum class Verdict : std::uint8_t { not_covered, agrees, partly, disagrees };
[[nodiscard]] std::string_view text_of(Verdict verdict);

/// One claim of a statement; no value: the atlas does not cover it.
struct Finding {
  std::optional<bool> holds;
  std::string evidence;
};

struct Statement {
  std::string_view name;   ///< P1 … P8
  std::string_view claim;  ///< the statement, in short
  std::vector<Finding> findings;

  [[nodiscard]] Verdict verdict() const;
};

/// All lines of an atlas, as the statements need them.
class Evidence {
 public:
  Evidence(const scene::Scene& scene, std::span<const Parameter> parameters,
           std::span<const LineSummary> lines, bool per_passing);

  /// Why the atlas says nothing about the default rotor; empty when its fixed quantities are those of
  /// MODEL 6.1.
  [[nodiscard]] const std::string& other_rotor() const { return other_rotor_; }
  /// The lines whose parameters, but for the named one, are those of the default rotor, ascending in the
  /// named one; those of an upward sweep where the atlas has both directions.
  [[nodiscard]] std::vector<const LineSummary*> lines_along(std::string_view name) const;
  /// The line of the default rotor; null where the grid has none.
  [[nodiscard]] const LineSummary* default_line() const;
  [[nodiscard]] double value(const LineSummary& line, std::string_view name) const;
  /// "ζ = 0.1".
  [[nodiscard]] std::string value_text(const LineSummary& line, std::string_view name) const;
  [[nodiscard]] SpeedScale scale() const { return scale_; }
  /// The doublings are those of the map over a blade passing.
  [[nodiscard]] bool per_passing() const { return per_passing_; }

 private:
  [[nodiscard]] std::size_t position(std::string_view name) const;

  std::span<const Parameter> parameters_;
  std::span<const LineSummary> lines_;
  SpeedScale scale_;
  bool per_passing_;
  std::string other_rotor_;
};

/// P1 to P4: one line, that of the default rotor.
std::vector<Statement> judge_default_rotor(const Evidence& evidence);
/// P5 to P8: along damping, friction and unbalance, all else as in the default rotor.
std::vector<Statement> judge_parameters(const Evidence& evidence);
/// P1 to P8.
std::vector<Statement> judge_statements(const Evidence& evidence);

}  // namespace rubatlas::analysis
