#include "mpi/accuracy/accuracy_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mpi/exit_code.hpp"
#include "settings/combinations.hpp"
#include "settings/nearest.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::mpi {
namespace {

using atlas::AccuracySetting;

/// The reference is this much tighter than the tightest run that is compared with it.
constexpr double kReferenceFactor = 10.0;
constexpr std::string_view kReferenceMethod = "hybrid";
/// The one method without error control.
constexpr std::string_view kFixedStep = "fixed";

/// Tolerance and force increment are refined together: a tolerance below the error that the increments of
/// force cause rejects most steps, and an increment smaller than the tolerance requires costs time for
/// nothing.
struct ToleranceAndIncrement {
  double tolerance;
  double force_increment;  ///< dF [N]
};
constexpr std::array kUsualWithIncrement{ToleranceAndIncrement{1e-4, 1.0}, ToleranceAndIncrement{1e-5, 1.0},
                                         ToleranceAndIncrement{1e-5, 0.1}, ToleranceAndIncrement{1e-6, 0.1}};

/// True when the table of quantities says that a method reads this number.
bool reads(std::string_view method, std::string_view pointer) {
  const auto& quantity = settings::quantity(pointer);
  return quantity.chooser.empty() ||
         std::find(quantity.readers.begin(), quantity.readers.end(), method) != quantity.readers.end();
}

void require_known(const std::string& method) {
  const auto known = accuracy_methods();
  if (std::find(known.begin(), known.end(), method) != known.end()) return;
  throw UsageError(fmt::format("--methods {}: not one of {}; nearest: {}", method, fmt::join(known, ", "),
                               settings::nearest(method, known)));
}

/// What is named twice would be computed twice.
template <typename Value>
void require_each_once(const std::vector<Value>& values, std::string_view option) {
  for (auto value = values.begin(); value != values.end(); ++value) {
    if (std::find(values.begin(), value, *value) != value)
      throw UsageError(fmt::format("{} {}: named twice", option, *value));
  }
}

/// Values that no method is run with would be left out without a word.
void require_readers(const std::vector<double>& values, std::string_view option, std::string_view pointer,
                     const std::vector<std::string>& methods) {
  const bool read = std::ranges::any_of(methods, [&](const auto& method) { return reads(method, pointer); });
  if (values.empty() || read) return;
  throw UsageError(fmt::format("{} {}: of the methods {} none reads it; {} does", option,
                               fmt::join(values, ","), fmt::join(methods, ", "),
                               fmt::join(settings::quantity(pointer).readers, ", ")));
}

/// What the reader would say of the scene with this method.
std::optional<std::string> refusal_of(std::string_view method, const settings::Scene& scene) {
  return settings::refusal_of_combination(scene_with({.method = std::string(method)}, scene));
}

/// The methods to be compared.
std::vector<std::string> methods_of(const std::vector<std::string>& named, const settings::Scene& scene) {
  require_each_once(named, "--methods");
  for (const auto& method : named) {
    require_known(method);
    if (const auto refusal = refusal_of(method, scene))
      throw UsageError(fmt::format("--methods {}: {}", method, *refusal));
  }
  if (!named.empty()) return named;
  std::vector<std::string> all;
  for (const auto method : accuracy_methods()) {
    if (!refusal_of(method, scene)) all.emplace_back(method);
  }
  return all;
}

/// The given values, or the usual ones where none are given. Each has to be within the range of its key in a
/// scene.
const std::vector<double>& ladder(const std::vector<double>& values, const std::vector<double>& usual,
                                  std::string_view option, std::string_view pointer) {
  const settings::Quantity& quantity = settings::quantity(pointer);
  for (const double value : values) {
    if (!quantity.range.contains(value)) {
      throw UsageError(
          fmt::format("{} {}: outside {}; {}", option, value, quantity.range.text(), quantity.meaning));
    }
  }
  require_each_once(values, option);
  return values.empty() ? usual : values;
}

/// The tolerance of the reference has to be legal too.
void require_room_for_the_reference(const std::vector<double>& tolerances) {
  const double least = settings::quantity("/accuracy/tolerance").range.low * kReferenceFactor;
  for (const double tolerance : tolerances) {
    if (tolerance < least) {
      throw UsageError(fmt::format("--tolerances {}: below {}; the reference run is {} times tighter",
                                   tolerance, least, kReferenceFactor));
    }
  }
}

}  // namespace

std::vector<std::string_view> accuracy_methods() {
  const auto words = settings::quantity("/accuracy/method").choices;
  return {words.begin(), words.end()};
}

std::vector<std::string_view> methods_left_out(const settings::Scene& scene) {
  auto methods = accuracy_methods();
  std::erase_if(methods, [&](std::string_view method) { return !refusal_of(method, scene); });
  return methods;
}

std::vector<AccuracySetting> accuracy_settings(const AccuracyLadders& ladders, const settings::Scene& scene) {
  static const AccuracyLadders kUsual{.methods = {},
                                      .tolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12},
                                      .force_increments = {1.0, 0.1, 0.01},
                                      .steps = {2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4}};
  const auto& tolerances =
      ladder(ladders.tolerances, kUsual.tolerances, "--tolerances", "/accuracy/tolerance");
  const auto& increments = ladder(ladders.force_increments, kUsual.force_increments, "--force-increments",
                                  "/accuracy/force_increment");
  const auto& steps = ladder(ladders.steps, kUsual.steps, "--steps", "/accuracy/step");
  require_room_for_the_reference(tolerances);
  const std::vector<std::string> methods = methods_of(ladders.methods, scene);
  require_readers(ladders.force_increments, "--force-increments", "/accuracy/force_increment", methods);
  require_readers(ladders.steps, "--steps", "/accuracy/step", methods);

  const double tightest = *std::min_element(tolerances.begin(), tolerances.end());
  std::vector<AccuracySetting> settings{
      {.method = std::string(kReferenceMethod), .tolerance = tightest / kReferenceFactor}};
  for (const auto& method : methods) {
    AccuracySetting setting{.method = method};
    if (reads(method, "/accuracy/max_step")) setting.max_step = scene.accuracy.max_step;
    if (method == kFixedStep) {
      for (const double step : steps) {
        setting.step = step;
        settings.push_back(setting);
      }
      continue;
    }
    const bool stepped_force = reads(method, "/accuracy/force_increment");
    if (stepped_force && ladders.tolerances.empty() && ladders.force_increments.empty()) {
      for (const auto& [tolerance, increment] : kUsualWithIncrement) {
        setting.tolerance = tolerance;
        setting.force_increment = increment;
        settings.push_back(setting);
      }
      continue;
    }
    const std::vector<double> not_read{AccuracySetting::kNotRead};
    for (const double increment : stepped_force ? increments : not_read) {
      setting.force_increment = increment;
      for (const double tolerance : tolerances) {
        setting.tolerance = tolerance;
        settings.push_back(setting);
      }
    }
  }
  return settings;
}

settings::Scene scene_with(const AccuracySetting& setting, settings::Scene scene) {
  settings::quantity("/accuracy/method").write(scene, setting.method);
  const auto set = [](double& knob, double value) {
    if (std::isfinite(value)) knob = value;
  };
  set(scene.accuracy.tolerance, setting.tolerance);
  set(scene.accuracy.force_increment, setting.force_increment);
  set(scene.accuracy.max_step, setting.max_step);
  set(scene.accuracy.step, setting.step);
  scene.observables = {"poincare", "max_displacement"};
  scene.validity.yield_strain.reset();
  return scene;
}

}  // namespace rubatlas::mpi
