#include "analysis/paper/reference_rotor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "settings/quantity.hpp"

namespace rubatlas::analysis {
namespace {

bool is_swept(const settings::Scene& scene, std::string_view pointer) {
  return std::ranges::any_of(
      scene.grid.swept, [&](const auto& axis) { return axis.pointer == pointer && axis.values.size() > 1; });
}

double number(const settings::Value& value) {
  return std::holds_alternative<int>(value) ? std::get<int>(value) : std::get<double>(value);
}

/// An effect that acts, is not swept, and does not exist in the rotors of the paper. The unbalance is not
/// among them: it is an axis of every atlas, whose values distinguish the lines.
std::string foreign_effect(const settings::Scene& scene) {
  std::string found;
  effects::for_each_effect([&]<auto Effect>() {
    using Settings = std::remove_cvref_t<decltype(*(scene.*Effect))>;
    const std::string_view section = Settings::kDescription.section;
    const bool swept = std::ranges::any_of(scene.grid.swept, [&](const auto& axis) {
      return axis.pointer.starts_with(fmt::format("{}/", section)) && axis.values.size() > 1;
    });
    if (section != "/unbalance" && !swept && effects::acts<Effect>(scene)) found = section;
  });
  return found;
}

}  // namespace

bool same_decimal(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

std::string ReferenceRotor::difference(const settings::Scene& other) const {
  for (const auto pointer : fixed) {
    if (is_swept(other, pointer)) continue;  // the value on the axis distinguishes the lines
    const auto& quantity = settings::quantity(pointer);
    const double here = number(quantity.read(other).value());
    const double there = number(quantity.read(scene).value());
    if (!agrees(pointer, here, there)) {
      return fmt::format("this is not {}: {} is {:g}, not {:g}", name, pointer, here, there);
    }
  }
  if (const auto effect = foreign_effect(other); !effect.empty()) {
    return fmt::format("this is not {}, which is without {}", name, effect);
  }
  return {};
}

bool ReferenceRotor::agrees(std::string_view pointer, double value, double own) const {
  const auto digits = std::ranges::find(rounded, pointer, &Rounded::pointer);
  return same_decimal(value, own) || (digits != rounded.end() && std::abs(value - own) <= digits->half_digit);
}

double ReferenceRotor::usual(std::string_view axis) const {
  const auto* quantity = settings::quantity_of_axis(axis);
  if (quantity == nullptr) return 0.0;
  settings::Scene own = scene;
  if (!quantity->chooser.empty()) {
    settings::quantity(quantity->chooser).write(own, std::string(quantity->readers.front()));
  }
  const auto value = quantity->read(own);
  return value ? number(*value) : 0.0;
}

ReferenceRotor default_rotor() {
  return {.name = "the paper's default rotor",
          .scene = {},
          .fixed = {"/rotor/mass", "/rotor/natural_frequency", "/rotor/misalignment", "/blades/count",
                    "/blades/length", "/blades/width", "/blades/youngs_modulus", "/blades/hub_radius",
                    "/ring/radius"},
          .open = {"direction", "ring_stiffness", "unbalance_phase"}};
}

ReferenceRotor default_rotor_of_any_count() {
  auto rotor = default_rotor();
  std::erase(rotor.fixed, "/blades/count");
  return rotor;
}

ReferenceRotor test_rig() {
  auto rotor = default_rotor();
  rotor.name = "the paper's test rig";
  std::erase(rotor.fixed, "/rotor/mass");
  rotor.open.insert(rotor.open.end(), {"friction", "rotor_mass"});
  // 30.23 Hz, 1814 rpm, 12.7 mm, 206 GPa.
  constexpr double kTurn = 2.0 * std::numbers::pi;
  rotor.rounded = {{"/rotor/natural_frequency", kTurn * 0.005},
                   {"/blades/width", 0.05e-3},
                   {"/blades/youngs_modulus", 0.5e9}};
  auto& scene = rotor.scene;
  scene.rotor.natural_frequency = kTurn * 30.23;
  scene.rotor.damping_ratio = 0.05;
  scene.rotor.misalignment = 0.36e-3;
  scene.blades.length = 40e-3;
  scene.blades.width = 12.7e-3;
  scene.blades.thickness = 0.5e-3;
  scene.blades.hub_radius = 22.15e-3;
  scene.ring.radius = 62.5e-3;
  return rotor;
}

}  // namespace rubatlas::analysis
