#include "mpi/commands/explain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "atlas/free_space.hpp"
#include "atlas/schema.hpp"
#include "mpi/commands/estimate.hpp"
#include "mpi/commands/explain_effects.hpp"
#include "mpi/commands/explain_observables.hpp"
#include "mpi/commands/explain_text.hpp"
#include "mpi/commands/memory_need.hpp"
#include "mpi/commands/notes.hpp"
#include "mpi/commands/reach.hpp"
#include "mpi/job/point_runner.hpp"
#include "mpi/job/progress.hpp"
#include "plan/grid.hpp"
#include "plan/pieces.hpp"
#include "settings/combinations.hpp"
#include "settings/linearisation.hpp"
#include "settings/methods.hpp"
#include "settings/printable.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::mpi {
namespace {

double revolutions_per_minute(double radians_per_second) {
  return 60.0 * radians_per_second / (2.0 * std::numbers::pi);
}

// --- the machine ---

/// Bending stiffness E b h³/12 [N m²] (MODEL 3.1).
double bending_stiffness(const settings::Blades& blades, double thickness) {
  return blades.youngs_modulus * blades.width * thickness * thickness * thickness / 12.0;
}

/// Load at which a cantilever buckles, (π/2)² EI/L² [N] (MODEL 3.2).
double euler_load(const settings::Blades& blades, double thickness) {
  const double half_pi = 0.5 * std::numbers::pi;
  return half_pi * half_pi * bending_stiffness(blades, thickness) / (blades.length * blades.length);
}

void describe_machine(const settings::Scene& scene, Text& text) {
  const auto& [mass, frequency, damping, misalignment] = scene.rotor;
  const auto& blades = scene.blades;
  const auto& speeds = scene.grid.speed_ratio;
  const auto& thicknesses = scene.grid.thickness;
  const double clearance = scene.clearance();

  text.heading("Machine");
  if (!scene.grid.swept.empty()) {
    std::vector<std::string_view> names;
    for (const auto& swept : scene.grid.swept) names.push_back(swept.pointer);
    text.line("swept",
              fmt::format("{}: here with the first value, under Grid with all", fmt::join(names, ", ")));
  }
  text.line("shaft", fmt::format("m {:.6g} kg, ωn {:.6g} rad/s ({:.4g} Hz), k {:.4g} N/m", mass, frequency,
                                 frequency / (2.0 * std::numbers::pi), mass * frequency * frequency));
  text.line("spin", fmt::format("Ω {}, that is {}", between(speeds.front(), speeds.back(), ""),
                                between(revolutions_per_minute(speeds.front() * frequency),
                                        revolutions_per_minute(speeds.back() * frequency), "rpm")));
  text.line("blades",
            fmt::format("{} of {} × {}, h {}, on a hub of radius {}", blades.count, length(blades.length),
                        length(blades.width),
                        thicknesses.size() == 1 ? length(thicknesses.front())
                                                : fmt::format("{} to {}", length(thicknesses.front()),
                                                              length(thicknesses.back())),
                        length(blades.hub_radius)));
  if (scene.contact.law != settings::ContactLaw::elastic_ring) {
    text.line("Euler load",
              between(euler_load(blades, thicknesses.front()), euler_load(blades, thicknesses.back()), "N"));
  }
  text.line("ring", fmt::format("R {}, clearance δc {}, misalignment y0 {}", length(scene.ring.radius),
                                length(clearance), length(misalignment)));
  if (const auto overlap = overlap_at_equilibrium(scene, misalignment)) {
    text.line("at equilibrium",
              *overlap > 0.0 ? fmt::format("a passing blade overlaps the ring by {}: it rubs at every speed",
                                           length(*overlap))
                             : fmt::format("blades pass the ring at a distance of {}", length(-*overlap)));
  }
  text.line("triggers", fmt::format("look near Ω = 1/n = {:.4g} and 2/n = {:.4g} (n = {})",
                                    1.0 / blades.count, 2.0 / blades.count, blades.count));
}

// --- method ---

/// Combinations of a scene's lines that differ in nothing but effects.
struct Motion {
  settings::Combination combination;  ///< with the effects that act on all of these lines
  settings::EffectSet on_some;        ///< those that act on some of them only
};

std::vector<Motion> motions_of(const settings::Scene& scene) {
  std::vector<Motion> motions;
  for (const auto& one : settings::combinations_in(scene)) {
    const auto same = std::ranges::find_if(motions, [&](const Motion& motion) {
      return motion.combination.family == one.family && motion.combination.machine == one.machine;
    });
    if (same == motions.end()) {
      motions.push_back({one, {}});
      continue;
    }
    const settings::EffectSet everywhere = same->combination.consumed & one.consumed;
    same->on_some = (same->on_some | same->combination.consumed | one.consumed) - everywhere;
    same->combination.consumed = everywhere;
  }
  return motions;
}

std::string names_text(settings::EffectSet effects) {
  std::vector<std::string> names;
  for (const auto section : effects.sections()) names.push_back(settings::axis_name(section));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string motion_text(const Motion& motion) {
  const auto& [family, machine, consumed] = motion.combination;
  return fmt::format(
      "{}{}{}", family->name, consumed.empty() ? "" : fmt::format("; with {}", names_text(consumed)),
      motion.on_some.empty() ? "" : fmt::format("; on some lines with {}", names_text(motion.on_some)));
}

/// The steps of a method that has no closed form for flight.
std::string steps_text(const settings::Scene& scene) {
  if (settings::method_of(scene).keeps_tolerance) {
    return fmt::format("of at most {:g} in τ", scene.accuracy.max_step);
  }
  return fmt::format("of {:g} in τ, shortened to a whole number of them a revolution", scene.accuracy.step);
}

std::string flight_text(const settings::Scene& scene, const settings::Combination& combination) {
  const auto& method = settings::method_of(scene);
  if (!method.flies_in_closed_form) {
    return fmt::format("no closed form: {}, in steps {} over flight and contact alike", method.pair,
                       steps_text(scene));
  }
  return fmt::format("closed form: {}{}{}; no touch-down can be jumped over",
                     combination.machine == settings::Machine::any_linear_support
                         ? "the exponential of the matrix of shaft and support"
                         : "complex exponentials of the isotropic shaft",
                     combination.family->flight.empty() ? "" : ", ", combination.family->flight);
}

std::string contact_text(const settings::Scene& scene, const settings::Combination& combination) {
  const auto& method = settings::method_of(scene);
  const settings::ContactText& contact = combination.family->contact;
  if (method.method == settings::Method::collocation)
    return fmt::format("{}; {}", method.pair, contact.on_arcs);
  if (method.flies_in_closed_form) {
    return fmt::format("{}; {}", method.pair, contact.in_steps);
  }
  if (scene.contact.law == settings::ContactLaw::elastic_ring) {
    return fmt::format("in the same steps; {}", contact.in_steps);
  }
  return fmt::format("in the same steps; the force of each blade: {}{}", method.force,
                     scene.accuracy.method == settings::Method::paper
                         ? fmt::format(", dF = {:g} N", scene.accuracy.force_increment)
                         : "");
}

void describe_kernel(const settings::Scene& scene, Text& text) {
  const bool bending = scene.contact.law != settings::ContactLaw::elastic_ring;
  const double scale = scene.clearance() > 0.0 ? scene.clearance() : 0.1 * scene.blades.length;
  const auto& method = settings::method_of(scene);
  text.heading("Kernel");
  text.line("method", std::get<std::string>(*settings::quantity("/accuracy/method").read(scene)));
  for (const Motion& motion : motions_of(scene)) {
    text.line("motion", motion_text(motion));
    text.line("flight", flight_text(scene, motion.combination));
    text.line("contact", contact_text(scene, motion.combination));
  }
  text.line("touch-down, lift-off", method.guards);
  text.line("accuracy",
            method.keeps_tolerance
                ? fmt::format("{:g} of {}: {:.3g} m a step, {:.3g} m per unit τ in velocity",
                              scene.accuracy.tolerance,
                              scene.clearance() > 0.0 ? "the clearance" : "L/10 (the clearance is 0)",
                              scene.accuracy.tolerance * scale, scene.accuracy.tolerance * scale)
                : "whatever equal steps give: no error is estimated, `accuracy.tolerance` is not read");
  text.line(
      "a point ends",
      fmt::format("after {}{} + {} revolutions, or with a status: {}shaft at the ring",
                  scene.protocol.transient_revolutions,
                  settings::may_settle(scene) ? " (fewer where it has certainly settled on a cycle)" : "",
                  scene.protocol.sampled_revolutions,
                  bending ? fmt::format("δ/L above {}, no root of the contact equation, ",
                                        scene.validity.max_shortening)
                          : ""));
}

// --- grid and file ---

void describe_grid(const settings::Scene& scene, const plan::Grid& grid, Text& text) {
  text.heading("Grid");
  for (const auto& axis : grid.axes()) {
    const std::string unit = axis.units == "1" ? "" : fmt::format(" {}", axis.units);
    text.line(axis.name, fmt::format("{:>6}  {}{}", axis.values.size(), values_text(axis.values), unit));
  }
  const std::string_view start = !grid.points_depend_on_each_other()
                                     ? "every point from `initial`"
                                     : "each point from the end of its neighbour, the first from `initial`";
  text.line("points", fmt::format("{:>6}  on {} line{} along speed_ratio; sweep {}: {}", grid.point_count(),
                                  grid.line_count(), grid.line_count() == 1 ? "" : "s",
                                  std::get<std::string>(*settings::quantity("/sweep").read(scene)), start));
  const plan::Pieces pieces(scene);
  if (pieces.per_line() > 1) {
    const auto more =
        static_cast<double>(pieces.computed_per_line()) / static_cast<double>(grid.speed_count()) - 1.0;
    const std::string behind =
        scene.pieces->lead_in > 0 ? fmt::format(" {} points ahead", scene.pieces->lead_in) : "";
    text.line("pieces",
              fmt::format("{:>6}  a line, of up to {} points, begun from `initial`{}, and replaced up to "
                          "where they go on as what leads to them: {:.1f} % more points to compute, at least",
                          pieces.per_line(), scene.pieces->points, behind, 100.0 * more));
    text.line("undecided",
              "        behind a seam in aperiodic motion (`/seam` 3) last digits choose what follows, as in "
              "any sweep");
  }
}

void describe_file(const settings::Scene& scene, Text& text) {
  const atlas::Schema schema = atlas::schema_of(scene);
  text.heading("Atlas");
  for (const auto* dataset : schema.row_datasets()) {
    const std::uint64_t bytes = schema.bytes_per_point(*dataset) * plan::Grid(scene).point_count();
    text.line(fmt::format("{}{}", dataset->name.starts_with('/') ? "" : "/", dataset->name),
              fmt::format("{:>9}  {}", atlas::readable_bytes(bytes), fmt::join(dataset->shape, " × ")));
  }
  text.line("together",
            fmt::format("{:>9}  {} points × {} a row", atlas::readable_bytes(schema.byte_count()),
                        plan::Grid(scene).point_count(), atlas::readable_bytes(schema.bytes_per_point())));
  const MemoryNeed need = memory_need(scene, PointRunner::kSolversKept);
  const auto memory = memory_of_process();
  text.line(
      "memory",
      fmt::format("{:>9}  {}{}", atlas::readable_bytes(static_cast<std::uint64_t>(need.together())),
                  memory_text(need),
                  need.together() > static_cast<double>(memory)
                      ? fmt::format(": TOO LARGE for the {} that there are", atlas::readable_bytes(memory))
                      : ""));
}

// --- time ---

/// Milliseconds where they are few.
std::string duration(double seconds) {
  return seconds < 1.0 ? fmt::format("{:.3g} ms", 1e3 * seconds) : readable_duration(seconds);
}

/// What several ranks make of the time. Points of a run come one after the other, on one rank.
std::string on_more_ranks(const settings::Scene& scene, const plan::Grid& grid) {
  const plan::Pieces pieces(scene);
  const bool one_by_one = grid.points_depend_on_each_other();
  const std::size_t most = one_by_one ? grid.line_count() * pieces.per_line() : grid.point_count();
  if (most == 1) {
    return fmt::format("; more ranks do not help with one {}, and are idle", one_by_one ? "line" : "point");
  }
  return fmt::format(", divided by the number of ranks, of which {} at most have work", most);
}

/// What was tried, and what of it came to its end.
std::string trials_text(const CostEstimate& cost) {
  if (cost.trials == 0) {
    return fmt::format(
        "{:.0f} revolution{} of {} point{}, none of which came to its end in the time; {} a point",
        cost.revolutions, cost.revolutions == 1.0 ? "" : "s", cost.given_up, cost.given_up == 1 ? "" : "s",
        duration(cost.seconds_per_point));
  }
  std::string text = fmt::format("{} point{} tried from `initial`: {} each, {} to {}", cost.trials,
                                 cost.trials == 1 ? "" : "s", duration(cost.seconds_per_point),
                                 duration(cost.fastest), duration(cost.slowest));
  if (cost.given_up > 0) {
    text += fmt::format("; {} more did not come to {} end in the time, and would cost more", cost.given_up,
                        cost.given_up == 1 ? "its" : "their");
  }
  return text;
}

/// The time on 2, 4, ... ranks, as far as more ranks make it shorter.
std::string times_on_ranks(double seconds, double longest_run) {
  std::string text;
  for (int ranks = 2; ranks <= 1024; ranks *= 2) {
    const bool last = seconds / ranks <= longest_run;
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", ranks,
                        duration(std::max(seconds / ranks, longest_run)));
    if (last) return text + ", and no less";
  }
  return text;
}

void describe_time(const settings::Scene& scene, const plan::Grid& grid, const CostEstimate& cost,
                   Text& text) {
  const plan::Pieces pieces(scene);
  if (cost.seconds_per_point <= 0.0) {
    text.heading("Time");
    text.line("on one rank",
              "not one revolution was completed while it was tried; --measure SECONDS tries for longer");
    return;
  }
  const bool chained = grid.points_depend_on_each_other();
  const std::size_t points = chained ? grid.line_count() * pieces.computed_per_line() : grid.point_count();
  const double seconds = static_cast<double>(points) * cost.seconds_per_point;
  const bool all_tried = cost.trials == grid.point_count();
  const double uncertainty = std::min(100.0, 100.0 * cost.standard_error / cost.seconds_per_point);
  text.heading("Time (an estimate, on this machine)");
  text.line(
      "on one rank",
      fmt::format("{} of CPU time{}{}", seconds < 0.1 ? "under 0.1 s" : readable_duration(seconds),
                  all_tried ? "" : fmt::format(" ± {:.0f} %", uncertainty), on_more_ranks(scene, grid)));
  const std::size_t longest_run = chained ? pieces.longest_run() : 1;
  if (points > longest_run) {
    text.line("on more ranks",
              times_on_ranks(seconds, static_cast<double>(longest_run) * cost.seconds_per_point));
  }
  text.line("from", trials_text(cost));
  const auto touchdowns = static_cast<double>(cost.work.touchdowns);
  if (touchdowns > 0.0) {
    text.line("they had", fmt::format("{:.3g} touch-downs a revolution, {:.0f} right-hand sides each",
                                      touchdowns / std::max(1.0, cost.revolutions),
                                      static_cast<double>(cost.work.right_hand_sides) / touchdowns));
  } else {
    text.line("they had", "no touch-down at all");
  }
  text.line("another tolerance", "`rubatlas accuracy` shows what each costs in time, and what it is worth");
}

}  // namespace

std::string explain(const settings::Scene& scene, double measured_for, const Clock& clock) {
  // Points end within three quarters of the time; effects have what is left of it.
  constexpr double kShareOfPoints = 0.6;
  const double begin = clock();
  const modes::GoOn go_on = [&] { return clock() - begin < measured_for; };
  const plan::Grid grid(scene);
  const CostEstimate cost = estimate_cost(scene, kShareOfPoints * measured_for, clock);

  Text text;
  describe_machine(scene, text);
  describe_effects(scene, go_on, text);
  describe_kernel(scene, text);
  describe_observables(scene, go_on, text);
  describe_grid(scene, grid, text);
  describe_file(scene, text);
  describe_time(scene, grid, cost, text);
  const auto remarks = notes_on(scene, cost);
  if (!remarks.empty()) text.heading("Notes");
  for (const auto& remark : remarks) text.note(remark);

  const std::string title =
      scene.title.empty() ? "(a scene without a title)" : settings::printable(scene.title);
  return fmt::format("{}\n{}{}", title,
                     scene.reference.empty() ? "" : settings::printable(scene.reference) + "\n", text.take());
}

}  // namespace rubatlas::mpi
