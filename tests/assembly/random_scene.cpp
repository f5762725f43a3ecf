#include "random_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "../support/point.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::test {
namespace {

using nlohmann::json;

/// Draws made from the generator's bits alone: the standard's distributions differ between libraries.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::clamp(std::exp(uniform(std::log(low), std::log(high))), low, high);
  }
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(bits_() % bound); }
  bool one_in(std::size_t number) { return below(number) == 0; }
  double sign() { return one_in(2) ? 1.0 : -1.0; }
  template <std::size_t N>
  double one_of(const std::array<double, N>& values) {
    return values[below(N)];
  }

 private:
  std::mt19937_64 bits_;
};

/// Upper bounds of the reader are far away; what lies this far below them is as good as zero.
constexpr double kDecades = 1e-15;

double anywhere(Draw& draw, const settings::Range& range) {
  if (draw.one_in(12)) return range.high;
  if (draw.one_in(12) && !range.low_excluded) return range.low;
  if (range.low < 0.0) {
    return draw.one_in(4) ? 0.0 : draw.sign() * draw.log_uniform(range.high * kDecades, range.high);
  }
  return draw.log_uniform(range.low > 0.0 ? range.low : range.high * kDecades, range.high);
}

/// Sections of effects that a scene may have besides the unbalance.
std::vector<std::string_view> effect_sections() {
  std::vector<std::string_view> found;
  effects::for_each_effect([&]<auto Effect>() {
    const std::string_view section = effects::Settings<Effect>::kDescription.section;
    if (section != "/unbalance") found.push_back(section);
  });
  return found;
}

bool is_in(const std::vector<std::string_view>& sections, std::string_view section) {
  return std::find(sections.begin(), sections.end(), section) != sections.end();
}

/// Every number of the reader's list over its legal range, but effects, how long a point runs, what is kept
/// of it, and in which pieces a line is swept.
json draw_anywhere(Draw& draw) {
  json scene;
  for (const settings::Quantity& quantity : settings::quantities()) {
    const bool number =
        quantity.kind == settings::Kind::number || quantity.kind == settings::Kind::whole_number;
    const bool skipped = is_in(effect_sections(), quantity.section()) || quantity.section() == "/protocol" ||
                         quantity.section() == "/spectrum" || quantity.section() == "/pieces" ||
                         (quantity.section() == "/accuracy" && quantity.key() != "tolerance");
    if (!number || skipped) continue;
    const double value = anywhere(draw, quantity.range);
    const json::json_pointer pointer{std::string(quantity.pointer)};
    if (quantity.kind == settings::Kind::whole_number) {
      scene[pointer] = static_cast<int>(value);
    } else {
      scene[pointer] = value;
    }
  }
  scene["contact"]["law"] = draw.one_in(4) ? "elastic_ring" : "elastica";
  if (scene["contact"]["law"] == "elastica") scene["ring"].erase("stiffness");
  if (draw.one_in(2)) scene.erase("unbalance");
  scene["protocol"] = {{"transient_revolutions", draw.below(2)},
                       {"sampled_revolutions", 1 + draw.below(3)},
                       {"samples_per_revolution", 2 + draw.below(40)}};
  scene["observables"] = test::observables_without_wear();
  return scene;
}

/// Lengths in proportion to the ring.
void fit_into_ring(Draw& draw, json& scene) {
  const double radius = draw.log_uniform(1e-4, 1e3);
  const double clearance = draw.one_in(20) ? 0.0 : radius * draw.log_uniform(1e-6, 0.7);
  const double reach = radius - clearance;
  const double length = draw.one_in(3) ? reach : reach * draw.uniform(0.05, 1.0);
  scene["ring"]["radius"] = radius;
  scene["blades"]["length"] = length;
  scene["blades"]["hub_radius"] = reach - length;
  scene["blades"]["thickness"] = length * draw.log_uniform(1e-4, 0.3);
  // Just above or below the clearance, or some way beyond it.
  const double scale = clearance > 0.0 ? clearance : 1e-3 * radius;
  const double offset = draw.one_in(2) ? scale * (1.0 + draw.sign() * draw.log_uniform(1e-15, 0.3))
                                       : scale + radius * draw.log_uniform(1e-6, 0.4);
  scene["rotor"]["misalignment"] = draw.one_in(5) ? 0.0 : draw.sign() * offset;
  for (const char* component : {"x", "y", "vx", "vy"}) {
    scene["initial"][component] = draw.one_in(2) ? 0.0 : draw.sign() * scale * draw.log_uniform(1e-6, 3.0);
  }
}

/// Blades and shaft that are a match for each other; speeds and dampings at which formulas change.
void make_it_rub(Draw& draw, json& scene) {
  auto& rotor = scene["rotor"];
  auto& blades = scene["blades"];
  rotor["mass"] = draw.log_uniform(1e-3, 1e3);
  rotor["natural_frequency"] = draw.log_uniform(1.0, 1e3);
  const double shaft = rotor["mass"].get<double>() * std::pow(rotor["natural_frequency"].get<double>(), 2);
  const double length = blades["length"];
  blades["width"] = length * draw.log_uniform(1e-2, 1.0);
  const double section =
      blades["width"].get<double>() * std::pow(blades["thickness"].get<double>(), 3) / 12.0;
  const double stiffness = shaft * draw.log_uniform(1e-3, 1e4);
  blades["youngs_modulus"] = std::clamp(stiffness * length * length * length / (3.0 * section), 1e-3, 1e15);
  if (scene["ring"].contains("stiffness")) scene["ring"]["stiffness"] = std::min(stiffness, 1e15);
  rotor["damping_ratio"] = draw.one_in(2)
                               ? draw.log_uniform(1e-3, 1.0)
                               : draw.one_of(std::array{0.0, 1e-4, 0.1, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 5.0});
  scene["grid"]["speed_ratio"] = draw.one_in(2)
                                     ? draw.log_uniform(5e-3, 5.0)
                                     : draw.one_of(std::array{0.005, 1.0 / 3, 0.5, 2.0 / 3, 1.0, 5.0});
  scene["contact"]["friction"] =
      draw.one_in(3) ? draw.uniform(0.0, 2.0) : draw.one_of(std::array{0.0, 1e-6, 0.01, 0.1, 0.2, 0.5, 2.0});
  if (scene.contains("unbalance")) {
    const double clearance =
        scene["ring"]["radius"].get<double>() - length - blades["hub_radius"].get<double>();
    scene["unbalance"]["moment"] =
        std::min(1e6, rotor["mass"].get<double>() * std::max(clearance, 1e-6) * draw.log_uniform(1e-4, 3.0));
  }
  scene["accuracy"]["tolerance"] = draw.log_uniform(1e-13, 1e-3);
  scene["validity"]["max_shortening"] = 0.5;
}

/// A number of an effect: over its legal range, or in proportion to the machine by its unit.
double strength(Draw& draw, const settings::Quantity& quantity, const json& scene, bool in_proportion) {
  if (!in_proportion) return anywhere(draw, quantity.range);
  const double mass = scene["rotor"]["mass"];
  const double square = std::pow(scene["rotor"]["natural_frequency"].get<double>(), 2);
  const double clearance =
      std::max(1e-6, scene["ring"]["radius"].get<double>() - scene["blades"]["length"].get<double>() -
                         scene["blades"]["hub_radius"].get<double>());
  const double share = draw.log_uniform(1e-4, 1.0);
  const double size = quantity.unit == "m"       ? clearance * share
                      : quantity.unit == "N"     ? mass * square * clearance * share
                      : quantity.unit == "m/s2"  ? square * clearance * share
                      : quantity.unit == "N/m"   ? mass * square * share
                      : quantity.unit == "N s/m" ? mass * std::sqrt(square) * share
                      : quantity.unit == "kg"    ? mass * share
                      : quantity.unit == "rad"   ? 4.0 * share
                                                 : std::min(quantity.range.high, 10.0) * share;
  const double signed_size = quantity.range.low < 0.0 ? draw.sign() * size : size;
  return std::clamp(signed_size, quantity.range.low, quantity.range.high);
}

/// Each effect in one scene of eight, whatever effects there are.
void draw_effects(Draw& draw, json& scene, bool in_proportion) {
  for (const std::string_view section : effect_sections()) {
    if (!draw.one_in(8)) continue;
    json& drawn = scene[json::json_pointer(std::string(section))] = json::object();
    for (const settings::Quantity& quantity : settings::quantities()) {
      if (quantity.section() != section || draw.one_in(4)) continue;
      json& value = drawn[std::string(quantity.key())];
      const auto number = [&] { return strength(draw, quantity, scene, in_proportion); };
      if (quantity.kind == settings::Kind::number) {
        value = number();
      } else if (quantity.kind == settings::Kind::whole_number) {
        value = static_cast<int>(std::ceil(number()));
      } else if (quantity.kind == settings::Kind::flag) {
        value = draw.one_in(2);
      } else if (quantity.kind == settings::Kind::choice) {
        value = quantity.choices[draw.below(quantity.choices.size())];
      } else if (quantity.kind == settings::Kind::numbers) {
        value = json::array();
        for (int k = 0; k < scene["blades"]["count"].get<int>(); ++k) value.push_back(number());
      }
    }
  }
}

/// Takes out the observable that the reader names as one without a meaning in this scene; false where it
/// names none.
bool take_out_observable(json& scene, std::string_view said) {
  constexpr std::string_view kBegin = "/observables: \"";
  if (!said.starts_with(kBegin)) return false;
  said.remove_prefix(kBegin.size());
  const std::string name(said.substr(0, said.find('"')));
  json& observables = scene["observables"];
  const auto named = std::ranges::find(observables, json(name));
  if (named == observables.end()) return false;
  observables.erase(named);
  return true;
}

/// An effect that does not go with the rest of a scene (errors that leave nothing of a blade, two laws of
/// friction) is taken out again, and so is an observable. Any other word of the reader is a test's failure.
std::string without_what_does_not_fit(json scene) {
  while (true) {
    std::string text = scene.dump();
    try {
      settings::parse_scene(text);
      return text;
    } catch (const settings::SceneError& error) {
      const std::string said = error.what();
      if (take_out_observable(scene, said)) continue;
      const auto sections = effect_sections();
      const auto blamed = std::ranges::find_if(sections, [&](std::string_view section) {
        return said.starts_with(section) && said.find("is outside") == std::string::npos;
      });
      if (blamed == sections.end()) throw;
      const json::json_pointer pointer{std::string(*blamed)};
      scene.at(pointer.parent_pointer()).erase(pointer.back());
    }
  }
}

}  // namespace

std::string random_scene_text(std::uint64_t index) {
  Draw draw(0x5275624174'6c6173ULL + index);
  Draw of_effects(0x456666656374'73ULL + index);
  while (true) {
    json scene = draw_anywhere(draw);
    if (index % 3 > 0) fit_into_ring(draw, scene);
    if (index % 3 > 1) make_it_rub(draw, scene);
    // The one condition between quantities of the machine: blades fit into the ring.
    const double reach =
        scene["blades"]["hub_radius"].get<double>() + scene["blades"]["length"].get<double>();
    if (reach > scene["ring"]["radius"].get<double>()) continue;
    draw_effects(of_effects, scene, index % 3 > 1);
    return without_what_does_not_fit(scene);
  }
}

settings::Scene random_scene(std::uint64_t index) {
  return settings::parse_scene(random_scene_text(index));
}

}  // namespace rubatlas::test
