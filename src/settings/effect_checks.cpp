#include "settings/effect_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "settings/combinations.hpp"
#include "settings/document.hpp"
#include "settings/linearisation.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::settings {
namespace {

/// Divisor of quantities of a unit in the dimensionless equations of motion (MODEL 1), for the least mass and
/// frequency of the grid; none for units without such a divisor.
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

/// Each quantity is in its own range already. In the dimensionless equations it must also be a finite number
/// whose square is finite.
void check_scaled(const Scene& scene) {
  constexpr double kLargest = 1e150;
  const double mass = std::ranges::min(values_in(scene, "/rotor/mass"));
  const double frequency = std::ranges::min(values_in(scene, "/rotor/natural_frequency"));
  for (const auto& entry : quantities()) {
    const auto scale = scale_of(entry.unit, mass, frequency);
    if (!scale || entry.kind != Kind::number || entry.read == nullptr) continue;
    for (const double value : values_in(scene, entry.pointer)) {
      if (value == 0.0 || std::abs(value) / scale->size <= kLargest) continue;
      fail(place_of(scene, entry.pointer),
           fmt::format("{} {}, divided by {} = {:.3g}, is more than {:g}, with which nothing can be computed",
                       value, entry.unit, scale->text, scale->size, kLargest));
    }
  }
}

void check_unequal_blades(const Scene& scene) {
  if (!scene.unequal_blades) return;
  const auto& blades = scene.blades;
  const auto check = [&](std::string_view pointer, const std::vector<double>& errors) {
    if (!errors.empty() && std::ssize(errors) != blades.count)
      fail(pointer,
           fmt::format("{} numbers for {} blades; one a blade, or none", errors.size(), blades.count));
  };
  check("/unequal_blades/length_errors", scene.unequal_blades->length_errors);
  check("/unequal_blades/thickness_errors", scene.unequal_blades->thickness_errors);
  check("/unequal_blades/angle_errors", scene.unequal_blades->angle_errors);
  if (scene.contact.law == ContactLaw::elastic_ring) {
    const auto refuse_thickness = [&scene](std::string_view pointer, bool given) {
      if (given)
        fail(place_of(scene, pointer),
             R"(has no effect under the contact law "elastic_ring", whose blades are rigid)");
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
  // Errors grow with their spreads, so that the ends of axes tell.
  for (const bool largest : {false, true}) {
    effects::UnequalBlades drawn = *scene.unequal_blades;
    const auto end = [&](std::string_view pointer) {
      const auto [least, most] = std::ranges::minmax(values_in(scene, pointer));
      return largest ? most : least;
    };
    drawn.length_spread = end("/unequal_blades/length_spread");
    drawn.thickness_spread = end("/unequal_blades/thickness_spread");
    for (const auto& error : drawn.errors(blades.count)) {
      if (!(length + error.length > 0.0) || !(thickness + error.thickness > 0.0))
        fail("/unequal_blades", fmt::format("a blade would be {:g} m long and {:g} m thick; both are above 0",
                                            length + error.length, thickness + error.thickness));
    }
  }
}

void check_wear(const Scene& scene) {
  if (scene.observes("clearance_growth") && !scene.wear)
    fail("/observables", R"("clearance_growth" is that of blades that wear; there is no section /wear)");
  if (!scene.wear) return;
  if (scene.wear->carries_over && scene.sweep == Sweep::independent)
    fail("/wear/carries_over", R"(the sweep is "independent"; no point comes after another)");
}

/// What an observable has no meaning beside.
void check_observables(const Scene& scene) {
  struct Meaningless {
    std::string_view observable;
    bool applies;
    std::string_view sentence;
  };
  const bool supported = scene.support.has_value();
  const bool ripples = scene.speed_ripple.has_value();
  constexpr std::string_view kOtherDamping = "does not know what the matrices of /support take and give";
  constexpr std::string_view kConstantSpeed = "is that of a constant speed, not of /speed_ripple";
  const std::array refusals{
      Meaningless{"viscous_power", supported, kOtherDamping},
      Meaningless{"drive_torque", supported, kOtherDamping},
      Meaningless{"drive_torque", ripples, kConstantSpeed},
      Meaningless{"deformation_power", ripples, kConstantSpeed},
      Meaningless{"max_root_stress", scene.contact.law == ContactLaw::elastic_ring,
                  R"(is that of blades that bend; under the contact law "elastic_ring" they are rigid)"},
  };
  for (const Meaningless& refusal : refusals) {
    if (refusal.applies && scene.observes(refusal.observable))
      fail("/observables", fmt::format("\"{}\" {}", refusal.observable, refusal.sentence));
  }
}

/// The speed at the end of a ramp over all sampled revolutions must be one that a grid may have.
void check_speed_ramp(const Scene& scene) {
  if (!scene.speed_ramp) return;
  const Range legal = quantity("/grid/speed_ratio").range;
  const auto rates = values_in(scene, "/speed_ramp/rate");
  const int ramped = scene.protocol.sampled_revolutions - 1;
  for (const double rate : {std::ranges::min(rates), std::ranges::max(rates)}) {
    for (const double first : {scene.grid.speed_ratio.front(), scene.grid.speed_ratio.back()}) {
      const double last = first + ramped * rate;
      if (legal.contains(last)) continue;
      fail(place_of(scene, "/speed_ramp/rate"),
           fmt::format(
               "from speed ratio {} on {} leads to {:.6g} in the last sampled revolution; speed ratios "
               "are {}",
               first, rate, last, legal.text()));
    }
  }
}

void check_exponents(const Scene& scene) {
  if (!scene.observes("lyapunov")) return;
  if (const auto refusal = refusal_of_linearisation(scene))
    fail("/observables", fmt::format("\"lyapunov\" is not to be had; {}", *refusal));
}

}  // namespace

void check_effects(const Scene& scene) {
  check_scaled(scene);
  if (const auto refusal = refusal_of_combination(scene)) throw SceneError(*refusal);
  check_unequal_blades(scene);
  check_wear(scene);
  check_speed_ramp(scene);
  check_exponents(scene);
  check_observables(scene);
}

}  // namespace rubatlas::settings
