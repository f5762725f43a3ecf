// The same motion in other units: lengths, masses and times times any factors are the same rotor, whose every
// figure follows by its unit. A constant in the program that has a unit shows here.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "effect_scene.hpp"
#include "observables/list.hpp"
#include "settings/observable_names.hpp"

namespace rubatlas::test {
namespace {

/// How many of a new unit make the old one.
struct Units {
  double mass;
  double length;
  double time;

  [[nodiscard]] double of(std::string_view unit) const {
    const double force = mass * length / (time * time);
    const std::map<std::string_view, double> factors = {{"", 1.0},
                                                        {"1", 1.0},
                                                        {"rad", 1.0},
                                                        {"kg", mass},
                                                        {"m", length},
                                                        {"kg m", mass * length},
                                                        {"rad/s", 1.0 / time},
                                                        {"m/s", length / time},
                                                        {"m/s2", length / (time * time)},
                                                        {"N", force},
                                                        {"N m", force * length},
                                                        {"N s", force * time},
                                                        {"N/m", force / length},
                                                        {"m/N", length / force},
                                                        {"N s/m", force * time / length},
                                                        {"m/J", 1.0 / force},
                                                        {"Pa", force / (length * length)},
                                                        {"W", force * length / time}};
    return factors.at(unit);
  }
};

settings::Scene in_units(settings::Scene scene, const Units& units) {
  for (const settings::Quantity& quantity : settings::quantities()) {
    if (quantity.read == nullptr) continue;
    auto value = quantity.read(scene);
    if (!value) continue;
    const double factor = units.of(quantity.unit);
    if (auto* number = std::get_if<double>(&*value)) *number *= factor;
    if (auto* numbers = std::get_if<std::vector<double>>(&*value)) {
      for (double& number : *numbers) number *= factor;
    }
    quantity.write(scene, *value);
  }
  for (const settings::GridAxis& axis : settings::grid_axes()) {
    for (double& value : scene.grid.*axis.values) value *= units.of(settings::quantity(axis.quantity).unit);
  }
  return scene;
}

/// The scene with every observable that it takes, but exponents: their residual is rounding.
settings::Scene with_its_observables(nlohmann::json scene) {
  std::vector<std::string> taken;
  for (const std::string_view name : settings::observable_names()) {
    if (name.starts_with("lyapunov")) continue;
    scene["observables"] = {name};
    try {
      parsed(scene);
      taken.emplace_back(name);
    } catch (const settings::SceneError&) {
    }
  }
  scene["observables"] = taken;
  return parsed(scene);
}

/// Largest value of the rows of each unit; a number without one stands for itself.
std::vector<double> sizes(const std::vector<observables::Description>& descriptions,
                          const observables::Rows& rows) {
  std::map<std::string, double> of_unit;
  std::vector<double> own;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double largest = 0.0;
    for (const double value : rows[i]) largest = std::fmax(largest, std::abs(value));
    own.push_back(largest);
    double& most = of_unit[descriptions[i].units];
    most = std::max(most, largest);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (descriptions[i].units != std::string("1")) own[i] = of_unit[descriptions[i].units];
  }
  return own;
}

void expect_the_same_in_other_units(const nlohmann::json& content, std::mt19937_64& generator) {
  constexpr double kCloseness = 1e-7;  // of the largest figure of a unit
  constexpr int kUnits = 20;
  const settings::Scene scene = with_its_observables(content);
  const auto descriptions = observables::descriptions(scene);
  const point::PointOutcome own = run(scene);
  ASSERT_EQ(own.status, ending::PointStatus::done) << ending::text_of(own.detail);
  ASSERT_GT(own.work.touchdowns, 0U);
  const auto size = sizes(descriptions, own.rows);
  const auto factor = [&] {
    return std::pow(10.0, 6.0 * static_cast<double>(generator() >> 11U) * 0x1p-53 - 3.0);
  };
  for (int i = 0; i < kUnits; ++i) {
    const Units units{factor(), factor(), factor()};
    SCOPED_TRACE(::testing::Message()
                 << "mass " << units.mass << ", length " << units.length << ", time " << units.time);
    const point::PointOutcome other = run(in_units(scene, units));
    ASSERT_EQ(other.status, own.status) << ending::text_of(other.detail);
    for (std::size_t row = 0; row < own.rows.size(); ++row) {
      const double unit = units.of(descriptions[row].units);
      for (std::size_t j = 0; j < own.rows[row].size(); ++j) {
        const double expected = own.rows[row][j];
        const double found = other.rows[row][j] / unit;
        if (std::isnan(expected) && std::isnan(found)) continue;
        EXPECT_LE(std::abs(found - expected), kCloseness * size[row])
            << descriptions[row].name << '[' << j << "]: " << found << " for " << expected;
      }
    }
  }
}

TEST(EveryEffect, MovesTheSameInOtherUnitsOfLengthMassAndTime) {
  std::mt19937_64 generator(25);
  for (const effects::Listed& effect : effects::listed()) {
    SCOPED_TRACE(name_of(effect));
    for (const double speed_ratio : {0.35, 0.75})
      expect_the_same_in_other_units(effect_scene(name_of(effect), speed_ratio, 7), generator);
  }
}

TEST(PaperSRotor, MovesTheSameInOtherUnitsByEveryMethodAndLaw) {
  std::mt19937_64 generator(26);
  for (const char* law : {"elastica", "elastic_ring", "beam_column"}) {
    for (const char* method : {"hybrid", "collocation"}) {
      SCOPED_TRACE(std::string(law) + " by " + method);
      const nlohmann::json scene = {{"contact", {{"law", law}}},
                                    {"accuracy", {{"method", method}, {"tolerance", 1e-11}}},
                                    {"grid", {{"speed_ratio", 0.62}}},
                                    {"protocol", {{"transient_revolutions", 0}, {"sampled_revolutions", 4}}}};
      expect_the_same_in_other_units(scene, generator);
    }
  }
}

}  // namespace
}  // namespace rubatlas::test
