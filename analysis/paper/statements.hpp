/// The paper's statements (paper_statements.hpp), each judged on the results of an atlas.
///
/// A statement is a list of findings, each true, false, or not covered by the atlas, and each with the
/// numbers it rests on. The statement agrees when all covered findings are true, disagrees when all are
/// false, and else holds partly. The thresholds are below, their reasons in the README of this folder,
/// "Statements".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/paper/evidence.hpp"
#include "analysis/paper/paper_statements.hpp"

namespace rubatlas::analysis {

/// "At 1/3", "at 2/3" and "right after" mean within this distance in scaled speed.
constexpr double kSamePlace = 0.02;
/// Two regions follow each other, and a change is "local", within this distance in scaled speed, which is one
/// running window (regions.hpp).
constexpr double kNextTo = 0.05;
/// A region is periodic up to this share of aperiodic points.
constexpr double kPeriodicShare = 0.05;
/// A displacement is small compared with another if their ratio is below this value.
constexpr double kSmall = 0.1;

enum class Verdict : std::uint8_t { not_covered, agrees, partly, disagrees };
[[nodiscard]] std::string_view text_of(Verdict verdict);

/// One claim of a statement; no value: the atlas does not cover it.
struct Finding {
  std::optional<bool> holds;
  std::string evidence;
  std::string claim{};  ///< the claim, in words that are the same for every atlas; a row of the statement map
  std::string brief{};  ///< the number that it rests on, for a cell of that map; may be empty
};

struct Statement {
  std::string_view name;  ///< P1 … P16
  std::vector<Finding> findings;
  Setting setting{};  ///< the values of the open axes that it was judged at

  [[nodiscard]] std::string_view claim() const { return claim_of(name); }
  [[nodiscard]] Verdict verdict() const;
};

/// P1 to P4: one line, that of the default rotor.
std::vector<Statement> judge_default_rotor(const Evidence& evidence);
/// P5 to P8: along damping, friction and unbalance, all else as in the default rotor.
std::vector<Statement> judge_parameters(const Evidence& evidence);
/// P12: the default rotor with another number of blades.
Statement judge_blade_count(const Evidence& evidence);
/// P13: the default rotor along the ring's stiffness.
Statement judge_ring_stiffness(const Evidence& evidence);
/// P10 and P14: one line, that of the test rig.
std::vector<Statement> judge_test_rig(const Evidence& evidence);
/// P9 and P15: the test rig along thickness, clearance and misalignment.
std::vector<Statement> judge_thin_blades(const Evidence& evidence);
/// P16: the rig's blade alone, from its closed form (MODEL 3.2).
Statement judge_blade_curve(const Evidence& evidence);

/// Why the statements do not apply to a scene: it is of none of the paper's rotors. Empty where it is of one.
[[nodiscard]] std::string why_none_applies(const settings::Scene& scene);

/// P1 to P10 and P12 to P16, each once per setting of the open axes of its rotor. Statements without settings
/// come first, then setting by setting, in the order of their numbers. Empty where none
/// applies.
std::vector<Statement> judge_statements(const settings::Scene& scene, std::span<const Parameter> parameters,
                                        std::span<const LineSummary> lines, bool per_passing);

}  // namespace rubatlas::analysis
