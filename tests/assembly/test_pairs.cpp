// All pairs of effects: each is refused with a sentence that names one of the two, or moves differently from
// either effect alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "../effects/effect_scene.hpp"
#include "../settings/scene_error_text.hpp"

namespace rubatlas::test {
namespace {

using ending::PointStatus;
using nlohmann::json;
using point::PointOutcome;

constexpr int kRevolutions = 6;

/// An effect's name, and its section as in `jobs/effect_<name>.json`.
using Section = std::pair<std::string, json>;

std::vector<Section> sections() {
  std::vector<Section> found;
  for (const effects::Listed& effect : effects::listed()) {
    json scene = effect_scene(name_of(effect), 0.5, 1);
    // In a ring as soft as that scene's no tip is held beyond the ring: `release` would have nothing to act
    // on.
    if (name_of(effect) == "yielding_ring") scene["yielding_ring"]["compliance"] = 1e-6;
    found.emplace_back(name_of(effect), scene.at(name_of(effect)));
  }
  return found;
}

json base_scene(const json& machine, double speed_ratio) {
  json scene = machine;
  scene["grid"] = {{"speed_ratio", speed_ratio}};
  scene["protocol"] = {{"transient_revolutions", 0}, {"sampled_revolutions", kRevolutions}};
  scene["observables"] = {"poincare"};
  scene["accuracy"] = {{"tolerance", 1e-10}};
  return scene;
}

/// The default rotor where it meets the ring on either side of a blade, and rotors whose friction is enough
/// to make tips stick.
std::vector<json> bases(const std::string& law) {
  const json plain = {{"contact", {{"law", law}}}};
  json rough = {{"contact", {{"law", law}, {"friction", 0.5}}}};
  if (law == "elastic_ring") {
    // Short blades, whose tips are slow.
    rough["ring"] = {{"radius", 0.03}};
    rough["blades"] = {{"length", 0.02}};
  }
  std::vector<json> result;
  for (const double speed : {0.45, 0.62, 0.3, 0.8, 0.33, 0.5, 0.55, 0.42, 0.9}) {
    for (const double velocity : {0.0, 0.01, -0.01}) {
      for (const json& machine : {plain, rough}) {
        result.push_back(base_scene(machine, speed));
        result.back()["initial"] = {{"vx", velocity}};
      }
    }
  }
  return result;
}

/// Runs a base with some sections, and keeps what it has run.
class Runs {
 public:
  explicit Runs(std::vector<json> rotors) : rotors_(std::move(rotors)) {}

  [[nodiscard]] std::size_t count() const { return rotors_.size(); }
  [[nodiscard]] json scene(std::size_t base, const std::vector<Section>& with) const {
    json result = rotors_[base];
    for (const auto& [name, content] : with) result[name] = content;
    return result;
  }
  const PointOutcome& outcome(std::size_t base, const std::vector<Section>& with) {
    std::string key = std::to_string(base);
    for (const auto& [name, content] : with) key += "/" + name;
    const auto known = outcomes_.find(key);
    if (known != outcomes_.end()) return known->second;
    return outcomes_.emplace(key, run(parsed(scene(base, with)))).first->second;
  }

 private:
  std::vector<json> rotors_;
  std::map<std::string, PointOutcome> outcomes_;
};

/// A thousand times what the tolerance lets a step err by, and far below what an effect of these strengths
/// does.
constexpr double kDifferent = 1e-9;  // m

/// The sections are apart, or one of the two leaves the model's validity earlier than the other.
bool differ(const PointOutcome& one, const PointOutcome& other) {
  if (one.status != other.status || one.failed_revolution != other.failed_revolution) return true;
  return one.status == PointStatus::done && largest_difference(one.rows.at(0), other.rows.at(0)) > kDifferent;
}

class Pairs : public testing::TestWithParam<const char*> {};

TEST_P(Pairs, AreRefusedWithASentenceOrMoveDifferentlyFromEitherEffectAlone) {
  const auto effects = sections();
  Runs runs(bases(GetParam()));
  int refused = 0;
  int moved = 0;
  for (std::size_t a = 0; a < effects.size(); ++a) {
    for (std::size_t b = a + 1; b < effects.size(); ++b) {
      const std::string pair = effects[a].first + " and " + effects[b].first;
      const std::string said = settings::refusal(runs.scene(0, {effects[a], effects[b]}).dump());
      if (said != "accepted") {
        const bool names_one =
            said.starts_with("/" + effects[a].first) || said.starts_with("/" + effects[b].first);
        EXPECT_TRUE(names_one) << pair << ": " << said;
        EXPECT_GT(said.size(), said.find(": ") + 20) << pair << ": " << said;
        ++refused;
        continue;
      }
      bool differs = false;
      for (std::size_t base = 0; base < runs.count() && !differs; ++base) {
        const PointOutcome& both = runs.outcome(base, {effects[a], effects[b]});
        // An effect that needs another one beside it is refused alone.
        const auto differs_from = [&](const Section& alone) {
          return settings::refusal(runs.scene(base, {alone}).dump()) != "accepted" ||
                 differ(both, runs.outcome(base, {alone}));
        };
        differs = differs_from(effects[a]) && differs_from(effects[b]);
      }
      EXPECT_TRUE(differs) << pair << " move as one of them alone";
      ++moved;
    }
  }
  EXPECT_EQ(refused + moved, 17 * 16 / 2);
  EXPECT_GT(refused, 20);
  EXPECT_GT(moved, 50);
}

INSTANTIATE_TEST_SUITE_P(Law, Pairs, testing::Values("elastica", "elastic_ring", "beam_column"),
                         [](const auto& law) { return std::string(law.param); });

TEST(Combinations, WithoutFrictionNothingSticksAndNothingIsRegularised) {
  for (const std::string law : {"elastica", "elastic_ring"}) {
    for (const Section& effect :
         {Section{"stick", json::object()}, Section{"regularised_friction", {{"velocity", 0.1}}}}) {
      for (const double speed : {0.3, 0.45, 0.62}) {
        json scene = base_scene({{"contact", {{"law", law}, {"friction", 0.0}}}}, speed);
        const PointOutcome without = run(parsed(scene));
        scene[effect.first] = effect.second;
        const PointOutcome with = run(parsed(scene));
        EXPECT_EQ(with.rows, without.rows) << law << ", " << effect.first;
        EXPECT_EQ(with.status, without.status);
        EXPECT_GT(with.work.right_hand_sides, 0U);
      }
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
