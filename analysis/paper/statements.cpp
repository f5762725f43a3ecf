#include "analysis/paper/statements.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

#include "analysis/paper/findings_along.hpp"

namespace rubatlas::analysis {
namespace {

int number_of(std::string_view name) {
  int number = 0;
  std::from_chars(name.data() + 1, name.data() + name.size(), number);
  return number;
}

}  // namespace

std::string_view text_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::partly:
      return "partly";
    case Verdict::disagrees:
      return "disagrees";
    case Verdict::not_covered:
      break;
  }
  return "not covered";
}

Verdict Statement::verdict() const {
  const auto count = [&](bool value) {
    return std::ranges::count_if(findings, [=](const Finding& f) { return f.holds && *f.holds == value; });
  };
  const auto yes = count(true);
  const auto no = count(false);
  if (yes + no == 0) return Verdict::not_covered;
  if (no == 0) return Verdict::agrees;
  return yes == 0 ? Verdict::disagrees : Verdict::partly;
}

std::vector<Statement> judge_parameters(const Evidence& evidence) {
  return {{"P5", low_damping_findings(evidence)},
          {"P6", high_damping_findings(evidence)},
          {"P7", friction_findings(evidence)},
          {"P8", unbalance_findings(evidence)}};
}

std::string why_none_applies(const settings::Scene& scene) {
  const std::string difference = default_rotor_of_any_count().difference(scene);
  if (difference.empty() || test_rig().difference(scene).empty()) return {};
  return difference + "; nor is it the paper's test rig";
}

std::vector<Statement> judge_statements(const settings::Scene& scene, std::span<const Parameter> parameters,
                                        std::span<const LineSummary> lines, bool per_passing) {
  std::vector<Statement> statements;
  if (!why_none_applies(scene).empty()) return statements;
  const auto judge = [&](const ReferenceRotor& rotor, std::string_view along, const auto& judgement) {
    std::vector<Statement> own;
    for (auto& setting : settings(rotor, scene, parameters, along)) {
      const Evidence evidence(scene, parameters, lines, per_passing, rotor, setting);
      for (auto& statement : judgement(evidence)) {
        statement.setting = setting;
        own.push_back(std::move(statement));
      }
    }
    for (auto& statement : own) {  // a statement that no setting covers is reported once
      const auto covered = [&](const Statement& other) {
        return other.name == statement.name && other.verdict() != Verdict::not_covered;
      };
      const auto said = [&](const Statement& other) { return other.name == statement.name; };
      const bool nowhere = std::ranges::none_of(own, covered);
      if (nowhere && std::ranges::any_of(statements, said)) continue;
      if (nowhere) statement.setting = {};
      // a copy instead of a move, since `own` is still read for names and verdicts
      statements.push_back(statement);
    }
  };
  const auto one = [](Statement (*judgement)(const Evidence&)) {
    return [judgement](const Evidence& evidence) { return std::vector{judgement(evidence)}; };
  };
  judge(default_rotor(), {}, judge_default_rotor);
  judge(default_rotor(), {}, judge_parameters);
  judge(test_rig(), {}, judge_thin_blades);
  judge(test_rig(), {}, judge_test_rig);
  judge(default_rotor_of_any_count(), {}, one(judge_blade_count));
  judge(default_rotor(), "ring_stiffness", one(judge_ring_stiffness));
  judge(test_rig(), {}, one(judge_blade_curve));

  std::map<std::string, std::size_t> rank{{"", 0}};  // settings in the order of their first statement
  for (const auto& statement : statements) rank.try_emplace(statement.setting.text, rank.size());
  std::ranges::stable_sort(statements, {}, [&](const Statement& statement) {
    return std::pair(rank.at(statement.setting.text), number_of(statement.name));
  });
  return statements;
}

}  // namespace rubatlas::analysis
