#include "settings/effect_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::settings {
namespace {

/// What quantities of a unit are divided by in the dimensionless equations of motion (MODEL 1), at its least
/// over the grid; none for other units.
struct Scale {
  double size = 0.0;
  std::string_view text;
};
std::optional<Scale> scale_of(std::string_view unit, double mass, double frequency) {
  if (unit == "N/m" || unit == "N") return Scale{mass * frequency * frequency, "mass × natural_frequency²"};
  if (unit == "N s/m") return Scale{mass * frequency, "mass × natural_frequency"};
  if (unit == "kg m") return Scale{mass, "mass"};
  if (unit == "m/s2") return Scale{frequency * frequency, "natural_frequency²"};
  return std::nullopt;
}

/// Each quantity is in its range; together with mass and frequency it must leave numbers, too, with squares
/// that are numbers.
void check_scaled(const Scene& scene) {
  constexpr double kLargest = 1e150;
  const double mass = std::ranges::min(values_in(scene, "/rotor/mass"));
  const double frequency = std::ranges::min(values_in(scene, "/rotor/natural_frequency"));
  for (const auto& entry : quantities()) {
    const auto scale = scale_of(entry.unit, mass, frequency);
    if (!scale || entry.kind != Kind::number || entry.read == nullptr) continue;
    for (const double value : values_in(scene, entry.pointer)) {
      if (value == 0.0 || std::abs(value) / scale->size <= kLargest) continue;
      throw SceneError(fmt::format(
          "{}: {} {}, divided by {} = {:.3g}, is more than {:g}, with which nothing can be computed",
          entry.pointer, value, entry.unit, scale->text, scale->size, kLargest));
    }
  }
}

/// Only the program's own method knows effects; the others are there to be compared on the paper's rotor.
void check_method(const Scene& scene) {
  if (scene.accuracy.method == Method::hybrid) return;
  effects::for_each_effect([&]<auto Effect>() {
    using Settings = std::remove_cvref_t<decltype(*(std::declval<Scene>().*Effect))>;
    if constexpr (!std::is_same_v<Settings, effects::Unbalance>) {
      if (!(scene.*Effect)) return;
      throw SceneError(fmt::format(
          R"({}: the method "{}" computes the paper's rotor and its unbalance; effects need "hybrid")",
          Settings::kDescription.section, std::get<std::string>(*quantity("/accuracy/method").read(scene))));
    }
  });
}

void check_unequal_blades(const Scene& scene) {
  if (!scene.unequal_blades) return;
  const auto& blades = scene.blades;
  const auto check = [&](std::string_view pointer, const std::vector<double>& errors) {
    if (!errors.empty() && std::ssize(errors) != blades.count) {
      throw SceneError(fmt::format("{}: {} numbers for {} blades; one a blade, or none", pointer,
                                   errors.size(), blades.count));
    }
  };
  check("/unequal_blades/length_errors", scene.unequal_blades->length_errors);
  check("/unequal_blades/thickness_errors", scene.unequal_blades->thickness_errors);
  check("/unequal_blades/angle_errors", scene.unequal_blades->angle_errors);
  if (scene.contact.law == ContactLaw::elastic_ring) {
    const auto refuse_thickness = [](std::string_view pointer, bool given) {
      if (!given) return;
      throw SceneError(fmt::format(
          R"({}: has no effect under the contact law "elastic_ring", whose blades are rigid)", pointer));
    };
    const auto& errors = scene.unequal_blades->thickness_errors;
    refuse_thickness("/unequal_blades/thickness_errors",
                     std::ranges::any_of(errors, [](double error) { return error != 0.0; }));
    refuse_thickness("/unequal_blades/thickness_spread",
                     std::ranges::max(values_in(scene, "/unequal_blades/thickness_spread")) > 0.0);
  }
  const auto smallest = [&](std::string_view pointer) { return std::ranges::min(values_in(scene, pointer)); };
  const double length = smallest("/blades/length");
  const double thickness = smallest("/blades/thickness");
  for (const auto& error : scene.unequal_blades->errors(blades.count)) {
    if (!(length + error.length > 0.0) || !(thickness + error.thickness > 0.0)) {
      throw SceneError(fmt::format(
          "/unequal_blades: a blade {} m shorter and {} m thinner than it should be; nothing of it is left",
          -error.length, -error.thickness));
    }
  }
}

void check_wear(const Scene& scene) {
  const bool kept = std::ranges::count(scene.observables, "clearance_growth") > 0;
  if (kept && !scene.wear) {
    throw SceneError(
        "/observables: \"clearance_growth\" is that of blades that wear; there is no section /wear");
  }
  if (!scene.wear) return;
  if (scene.protocol.stop_when_periodic) {
    throw SceneError("/wear: /protocol/stop_when_periodic leaves out revolutions, in which blades wear too");
  }
  if (scene.wear->carries_over && scene.sweep == Sweep::independent) {
    throw SceneError(R"(/wear/carries_over: the sweep is "independent"; no point comes after another)");
  }
}

/// A ramp that goes on over all sampled revolutions stays within the speeds that a grid may have.
void check_speed_ramp(const Scene& scene) {
  if (!scene.speed_ramp) return;
  const Range legal = quantity("/grid/speed_ratio").range;
  const auto rates = values_in(scene, "/speed_ramp/rate");
  const int ramped = scene.protocol.sampled_revolutions - 1;
  for (const double rate : {std::ranges::min(rates), std::ranges::max(rates)}) {
    for (const double first : {scene.grid.speed_ratio.front(), scene.grid.speed_ratio.back()}) {
      const double last = first + ramped * rate;
      if (legal.contains(last)) continue;
      throw SceneError(fmt::format(
          "/speed_ramp/rate: from speed ratio {} on {} leads to {} in the last sampled revolution; "
          "speed ratios are {}",
          first, rate, last, legal.text()));
    }
  }
}

/// A ring that moves is compiled for the plain laws, and for a machine that stays as it is.
void check_ring_body(const Scene& scene) {
  if (!scene.ring_body) return;
  const auto refuse_beside = [](bool there, std::string_view section) {
    if (!there) return;
    throw SceneError(
        fmt::format("/ring_body: stands beside {}; the ring moves as one body without it only", section));
  };
  refuse_beside(scene.yielding_ring.has_value(), "/yielding_ring");
  refuse_beside(scene.release.has_value(), "/release");
  refuse_beside(scene.load_direction.has_value(), "/load_direction");
  refuse_beside(scene.regularised_friction.has_value(), "/regularised_friction");
  refuse_beside(scene.stribeck.has_value(), "/stribeck");
  refuse_beside(scene.wear.has_value(), "/wear");
  refuse_beside(scene.speed_ramp.has_value(), "/speed_ramp");
  refuse_beside(scene.stick.has_value(), "/stick");
  if (std::ranges::min(values_in(scene, "/ring_body/mass")) > 0.0) return;
  if (scene.contact.law != ContactLaw::elastic_ring) {
    throw SceneError(
        R"(/ring_body/mass: 0 goes with the contact law "elastic_ring" only; under elastic blades )"
        "/yielding_ring is a ring without mass");
  }
  const double damping = std::ranges::max(values_in(scene, "/ring_body/damping"));
  if (damping > 0.0) {
    throw SceneError(fmt::format(
        "/ring_body/damping: {} beside a mass of 0; a ring without mass has no damping here", damping));
  }
}

/// Effects of elastic blades say nothing of rigid ones, and a load of its own direction has no table.
void check_blades(const Scene& scene) {
  const auto refuse = [](std::string_view section, std::string_view why) {
    throw SceneError(fmt::format("{}: {}", section, why));
  };
  const bool rigid = scene.contact.law == ContactLaw::elastic_ring;
  constexpr std::string_view kRigid =
      R"(has no effect under the contact law "elastic_ring", whose blades are rigid)";
  if (rigid && scene.axial_compliance) refuse("/axial_compliance", kRigid);
  if (rigid && scene.yielding_ring)
    refuse("/yielding_ring",
           R"(the contact law "elastic_ring" has a ring that yields already: /ring/stiffness)");
  if (rigid && scene.release) refuse("/release", kRigid);
  if (rigid && scene.load_direction) refuse("/load_direction", kRigid);
  if (scene.stribeck && scene.regularised_friction)
    refuse("/stribeck", "stands beside /regularised_friction; friction has one law");
  if (scene.stick && (scene.stribeck || scene.regularised_friction))
    refuse("/stick", fmt::format("stands beside {}; friction has one law",
                                 scene.stribeck ? "/stribeck" : "/regularised_friction"));
  if (scene.stick && (scene.wear || scene.speed_ramp))
    refuse("/stick", fmt::format("stands beside {}, whose changes between revolutions would tear tips loose",
                                 scene.wear ? "/wear" : "/speed_ramp"));
  if (scene.stick && scene.load_direction)
    refuse("/stick", "holds tips under the axial load only, not beside /load_direction");
  const bool directed =
      !rigid && (scene.load_direction || scene.stribeck || scene.regularised_friction || scene.stick);
  if (!directed) return;
  constexpr std::string_view kPlain =
      R"(combines with inextensible elastica in a rigid ring only: no axial_compliance, yielding_ring, release or law "beam_column")";
  if (scene.axial_compliance || scene.yielding_ring || scene.release ||
      scene.contact.law == ContactLaw::beam_column)
    refuse(scene.load_direction         ? "/load_direction"
           : scene.stribeck             ? "/stribeck"
           : scene.regularised_friction ? "/regularised_friction"
                                        : "/stick",
           kPlain);
}

}  // namespace

void check_effects(const Scene& scene) {
  check_scaled(scene);
  check_method(scene);
  check_blades(scene);
  check_unequal_blades(scene);
  check_wear(scene);
  check_speed_ramp(scene);
  check_ring_body(scene);
}

}  // namespace rubatlas::settings
