#include "mpi/accuracy_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "mpi/exit_code.hpp"
#include "scene/nearest.hpp"
#include "scene/quantity.hpp"

namespace rubatlas::mpi {
namespace {

using atlas::AccuracySetting;

/// Which knobs a method reads.
struct MethodKnobs {
  std::string_view method;
  bool tolerance = false;
  bool force_increment = false;
  bool max_step = false;
  bool step = false;
};

constexpr std::array kMethods{
    MethodKnobs{.method = "hybrid", .tolerance = true},
};

/// The reference is this much tighter than the tightest run that is compared with it.
constexpr double kReferenceFactor = 10.0;

const MethodKnobs& knobs_of(const std::string& method) {
  const auto found = std::find_if(kMethods.begin(), kMethods.end(),
                                  [&](const MethodKnobs& entry) { return entry.method == method; });
  if (found != kMethods.end()) return *found;
  const auto names = accuracy_methods();
  throw UsageError(fmt::format("--methods {}: not one of {}; nearest: {}", method, fmt::join(names, ", "),
                               scene::nearest(method, names)));
}

/// The values, or the default ones where none are given; each within the range of its key in a scene.
std::vector<double> ladder(const std::vector<double>& values, std::vector<double> usual,
                           const std::string& option, std::string_view pointer) {
  const scene::Quantity& quantity = scene::quantity(pointer);
  for (const double value : values) {
    if (!quantity.range.contains(value)) {
      throw UsageError(
          fmt::format("{} {}: outside {}; {}", option, value, quantity.range.text(), quantity.meaning));
    }
  }
  return values.empty() ? std::move(usual) : values;
}

/// The reference has to be possible too.
void require_room_for_the_reference(const std::vector<double>& tolerances) {
  const double least = scene::quantity("/accuracy/tolerance").range.low * kReferenceFactor;
  for (const double tolerance : tolerances) {
    if (tolerance < least) {
      throw UsageError(fmt::format("--tolerances {}: below {}; the reference run is {} times tighter",
                                   tolerance, least, kReferenceFactor));
    }
  }
}

}  // namespace

std::vector<std::string_view> accuracy_methods() {
  std::vector<std::string_view> names;
  for (const auto& entry : kMethods) names.push_back(entry.method);
  return names;
}

std::vector<AccuracySetting> accuracy_settings(const AccuracyLadders& ladders, const scene::Scene& scene) {
  const auto tolerances =
      ladder(ladders.tolerances, {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}, "--tolerances",
             "/accuracy/tolerance");
  require_room_for_the_reference(tolerances);
  const double tightest = *std::min_element(tolerances.begin(), tolerances.end());

  std::vector<AccuracySetting> settings{{.method = "hybrid", .tolerance = tightest / kReferenceFactor}};
  std::vector<std::string> methods = ladders.methods;
  if (methods.empty()) {
    for (const auto name : accuracy_methods()) methods.emplace_back(name);
  }
  static_cast<void>(scene);
  for (const auto& method : methods) {
    static_cast<void>(knobs_of(method));
    for (const double tolerance : tolerances) {
      settings.push_back({.method = method, .tolerance = tolerance});
    }
  }
  return settings;
}

scene::Scene scene_with(const AccuracySetting& setting, scene::Scene scene) {
  scene.accuracy.tolerance = setting.tolerance;
  scene.observables = {"poincare", "max_displacement"};
  scene.validity.yield_strain.reset();
  return scene;
}

}  // namespace rubatlas::mpi
