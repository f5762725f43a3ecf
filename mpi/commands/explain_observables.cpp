#include "mpi/commands/explain_observables.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "mpi/commands/effect_cost.hpp"

namespace rubatlas::mpi {
namespace {

std::optional<double> seconds_with(settings::Scene scene, std::vector<std::string> observables,
                                   const modes::GoOn& go_on) {
  scene.observables = std::move(observables);
  return seconds_per_right_hand_side(scene, go_on);
}

std::string share_text(double share) {
  constexpr double kNoise = 0.02;  // of what is measured in milliseconds
  return share < kNoise ? "next to nothing" : fmt::format("{:+.0f} %", 100.0 * share);
}

}  // namespace

void describe_observables(const settings::Scene& scene, const modes::GoOn& go_on, Text& text) {
  text.heading("Observables");
  const auto without = seconds_with(scene, {}, go_on);
  bool measured = without.has_value();
  for (const auto& observable : scene.observables) {
    const auto with = measured ? seconds_with(scene, {observable}, go_on) : std::nullopt;
    if (!with) {
      measured = false;
      break;
    }
    text.line(observable, share_text(*with / *without - 1.0));
  }
  text.line("each", measured ? "measured: what it alone adds to the time of a sampled revolution"
                    : go_on()
                        ? "not measured: no blade comes into contact where it was to be"
                        : "those that are not listed were not measured: motions take too long for that here");
}

}  // namespace rubatlas::mpi
