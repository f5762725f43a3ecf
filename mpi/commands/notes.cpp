#include "mpi/commands/notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "analysis/report_parts.hpp"
#include "analysis/rules/free_shaft.hpp"
#include "mpi/commands/explain_text.hpp"
#include "mpi/commands/reach.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::mpi {
namespace {

/// Largest amplitude of the rotor without contact under the scene's unbalance [m] (MODEL 4.5), over the grid.
double largest_free_amplitude(const settings::Scene& scene) {
  double largest = 0.0;
  const double eccentricity = scene.grid.unbalance.back() / scene.rotor.mass;
  const double damping = scene.grid.damping_ratio.front();
  for (const double speed : scene.grid.speed_ratio) {
    const double detuning = std::hypot(1.0 - speed * speed, 2.0 * damping * speed);
    if (eccentricity > 0.0) largest = std::max(largest, eccentricity * speed * speed / detuning);
  }
  return largest;
}

/// Range of Young's modulus of any blade material [Pa]: from soft rubber to above diamond.
constexpr double kSoftest = 1e6;
constexpr double kHardest = 1.5e12;
/// A blade thicker than this share of its length is no slender beam.
constexpr double kSlender = 0.2;
/// A damping ratio above this value was probably meant in per cent.
constexpr double kPerCent = 2.0;

/// The power of a thousand by which a Young's modulus in another unit has to be multiplied to be that of a
/// metal.
std::string other_unit(double modulus) {
  for (const auto& [factor, unit] : {std::pair{1e9, "GPa"}, std::pair{1e6, "MPa"}}) {
    if (modulus * factor >= 1e9 && modulus * factor <= kHardest) {
      return fmt::format("; is it {:g} {}, that is {:g} Pa?", modulus, unit, modulus * factor);
    }
  }
  return {};
}

void doubt_modulus(const settings::Scene& scene, std::vector<std::string>& doubts) {
  if (scene.contact.law == settings::ContactLaw::elastic_ring) return;
  const auto moduli = settings::values_in(scene, "/blades/youngs_modulus");
  const auto [lowest, highest] = std::ranges::minmax(moduli);
  if (lowest < kSoftest) {
    doubts.push_back(fmt::format("E = {:g} Pa is far below any solid{}", lowest, other_unit(lowest)));
  } else if (highest > kHardest) {
    doubts.push_back(fmt::format("E = {:g} Pa is above any solid; youngs_modulus is in Pa", highest));
  }
}

void doubt_slenderness(const settings::Scene& scene, std::vector<std::string>& doubts) {
  if (scene.contact.law == settings::ContactLaw::elastic_ring) return;
  const double thickness = scene.grid.thickness.back();
  const double blade = std::ranges::min(settings::values_in(scene, "/blades/length"));
  if (thickness <= kSlender * blade) return;
  doubts.push_back(fmt::format(
      "h = {} is more than a fifth of L = {}: such a blade is no slender beam, as which it is computed",
      length(thickness), length(blade)));
}

void doubt_damping(const settings::Scene& scene, std::vector<std::string>& doubts) {
  const double damping = scene.grid.damping_ratio.back();
  if (damping <= kPerCent) return;
  doubts.push_back(fmt::format(
      "ζ = {:g} is a share of critical damping, beyond 1 the shaft creeps back without vibrating; "
      "{:g} % is {:g}",
      damping, damping, damping / 100.0));
}

void doubt_sag(const settings::Scene& scene, std::vector<std::string>& doubts) {
  const double sag = analysis::largest_sag(scene, 1.0);
  if (sag == 0.0) return;
  doubts.push_back(
      fmt::format("the static load alone moves the shaft by {}, more than the clearance", length(sag)));
}

void doubt_contact(const settings::Scene& scene, std::vector<std::string>& doubts) {
  const auto reach = reach_without_contact(scene);
  if (!reach) return;
  if (reach->displacement == 0.0) {
    doubts.emplace_back("the blades never reach the ring: nothing moves, every row is zero");
    return;
  }
  doubts.push_back(fmt::format(
      "the blades never reach the ring: the shaft moves by no more than {}, and at equilibrium they pass the "
      "ring at a distance of {}{}",
      length(reach->displacement), length(reach->distance),
      settings::values_in(scene, "/rotor/misalignment").size() > 1 ? " or more" : ""));
}

// --- contact at the points that were tried ---

/// "none of the 40 points tried ... touched the ring, in 60 revolutions or fewer each from `initial`"
std::string none_touched(std::ptrdiff_t count, std::string_view where, const CostEstimate& cost) {
  return fmt::format(
      "none of the {} point{} tried{} touched the ring, in {} revolution{} each from `initial`", count,
      count == 1 ? "" : "s", where, cost.most_revolutions, cost.most_revolutions == 1 ? "" : "s or fewer");
}

/// The points, in order of speed from one end of the range, that lie before the first speed at which a blade
/// touched.
void note_end_without_contact(const std::vector<TriedPoint>& points, std::string_view end,
                              const CostEstimate& cost, std::vector<std::string>& notes) {
  // With fewer points, spread over all axes, the next point might well touch.
  constexpr std::ptrdiff_t kFewest = 10;
  const auto touching = std::ranges::find_if(points, &TriedPoint::touched);
  const auto limit = std::ranges::find(points, touching->speed_ratio, &TriedPoint::speed_ratio);
  const auto count = limit - points.begin();
  if (count < kFewest) return;
  const auto [low, high] = std::minmax(points.front().speed_ratio, std::prev(limit)->speed_ratio);
  notes.push_back(
      fmt::format("the {} speeds may be without any contact: {}", end,
                  none_touched(count, fmt::format(" from Ω = {:.4g} to {:.4g}", low, high), cost)));
}

void note_contacts(const settings::Scene& scene, const CostEstimate& cost, std::vector<std::string>& notes) {
  if (cost.points.empty() || reach_without_contact(scene)) return;
  if (std::ranges::none_of(cost.points, &TriedPoint::touched)) {
    notes.push_back(none_touched(std::ssize(cost.points), "", cost) +
                    ": are misalignment, clearance and loads as intended?");
    return;
  }
  auto points = cost.points;
  std::ranges::sort(points, {}, &TriedPoint::speed_ratio);
  note_end_without_contact(points, "lower", cost, notes);
  std::ranges::reverse(points);
  note_end_without_contact(points, "upper", cost, notes);
}

/// The largest overlap at equilibrium over the grid [m]; 0 where there is none, or none is known.
double largest_overlap(const settings::Scene& scene) {
  double largest = 0.0;
  for (const double misalignment : settings::values_in(scene, "/rotor/misalignment"))
    largest = std::max(largest, overlap_at_equilibrium(scene, misalignment).value_or(0.0));
  return largest;
}

/// How far beyond the ring a blade reaches where `initial` puts the shaft [m], over the grid; none where it
/// does not, or no farther than where the shaft rests.
std::optional<double> start_beyond_ring(const settings::Scene& scene) {
  const double start = farthest_start(scene, -scene.rotor.misalignment);
  if (farthest_start(scene, 0.0) == 0.0 || start <= std::abs(scene.rotor.misalignment)) return std::nullopt;
  const double beyond = start - scene.clearance();
  return beyond > 0.0 ? std::optional(beyond) : std::nullopt;
}

/// Axes of what only bends blades, under a law whose blades are rigid.
void note_idle_axes(const settings::Scene& scene, std::vector<std::string>& notes) {
  if (scene.contact.law != settings::ContactLaw::elastic_ring) return;
  for (const settings::Axis& axis : settings::axes_of(scene)) {
    const std::string_view pointer = axis.quantity->pointer;
    const bool is_idle = pointer == "/blades/width" || pointer == "/blades/thickness" ||
                         pointer == "/blades/youngs_modulus" || pointer == "/validity/yield_strain";
    if (is_idle && axis.values.size() > 1)
      notes.push_back(fmt::format(
          "{} has no effect under the contact law \"elastic_ring\", whose blades are rigid: points that "
          "differ in it alone are the same motion",
          axis.name));
  }
}

}  // namespace

std::vector<std::string> doubts_about(const settings::Scene& scene) {
  std::vector<std::string> doubts;
  doubt_modulus(scene, doubts);
  doubt_slenderness(scene, doubts);
  doubt_damping(scene, doubts);
  doubt_sag(scene, doubts);
  doubt_contact(scene, doubts);
  return doubts;
}

std::string likely_reason_to_leave(const settings::Scene& scene) {
  const double start = farthest_start(scene, -scene.rotor.misalignment);
  if (start >= scene.ring.radius) {
    const bool starts_far = farthest_start(scene, 0.0) >= scene.ring.radius;
    return fmt::format("`{}` puts the shaft {} from the ring's centre, and the ring has a radius of {}",
                       starts_far ? "initial" : "misalignment", length(start), length(scene.ring.radius));
  }
  const double overlap = largest_overlap(scene);
  const double limit = scene.validity.max_shortening * scene.blades.length;
  const auto beyond = start_beyond_ring(scene);
  const auto of_start = [&] {
    return fmt::format("`initial` puts the shaft where a blade reaches {} beyond the ring", length(*beyond));
  };
  if (beyond > limit) return of_start();
  if (scene.contact.law != settings::ContactLaw::elastic_ring && overlap > limit) {
    return fmt::format(
        "a blade that passes overlaps the ring by {}, and may be shortened by {} (max_shortening {:g} of L)",
        length(overlap), length(limit), scene.validity.max_shortening);
  }
  if (const double amplitude = largest_free_amplitude(scene); amplitude > 10.0 * scene.clearance()) {
    return fmt::format("the unbalance alone moves the shaft by up to {}, with a clearance of {}",
                       length(amplitude), length(scene.clearance()));
  }
  if (const auto doubts = doubts_about(scene); !doubts.empty()) return doubts.front();
  if (beyond) return of_start();
  if (scene.grid.speed_ratio.front() > 1.0) {
    return "all speeds are beyond Ω = 1, where blades can no longer push a rotor back that leaves";
  }
  return {};
}

std::vector<std::string> notes_on(const settings::Scene& scene, const CostEstimate& cost) {
  std::vector<std::string> result = doubts_about(scene);
  note_contacts(scene, cost, result);
  note_idle_axes(scene, result);
  if (cost.left_validity > 0) {
    result.push_back(
        fmt::format("{} of the {} points tried left the model: their rows will be NaN, with status 2",
                    cost.left_validity, cost.trials));
  }
  if (cost.integrator_failed > 0) {
    result.push_back(fmt::format(
        "{} of the {} points tried could not be integrated: their rows will be NaN, with status 3",
        cost.integrator_failed, cost.trials));
  }
  if (const double overlap = largest_overlap(scene); overlap > 0.0) {
    result.push_back(fmt::format(
        "y0 is above the clearance δc, by {}: blades rub at every speed, even while the shaft stands at "
        "equilibrium; a rotor that is to run free has y0 below δc",
        length(overlap)));
  }
  if (start_beyond_ring(scene)) {
    result.push_back(
        fmt::format("`initial` puts the shaft {} from the ring's centre, farther than the clearance of {}: "
                    "blades may begin "
                    "in contact",
                    length(farthest_start(scene, -scene.rotor.misalignment)), length(scene.clearance())));
  }
  std::ranges::move(analysis::notes_on_effects(scene), std::back_inserter(result));
  if (scene.grid.speed_ratio.back() > 1.0) {
    result.emplace_back(
        "speeds beyond Ω = 1 reach the border of the model, where blades can no longer push a rotor back "
        "that leaves. Near the border the very revolution of escape depends on the last digits");
  }
  if (const double amplitude = largest_free_amplitude(scene); std::isinf(amplitude)) {
    result.emplace_back("Ω = 1 without damping: under its unbalance the free shaft moves out without bound");
  } else if (amplitude > 0.0) {
    result.push_back(
        fmt::format("without contact the unbalance alone would move the shaft by up to {}, {} clearances",
                    length(amplitude),
                    scene.clearance() > 0.0 ? fmt::format("{:.3g}", amplitude / scene.clearance()) : "many"));
  }
  if (scene.grid.damping_ratio.front() == 0.0) {
    result.emplace_back("ζ = 0: free motion never decays, a transient of any length leaves it as it is");
  }
  if (scene.protocol.transient_revolutions == 0) {
    result.emplace_back("no transient: the sections begin with the very first revolution");
  }
  const bool has_passing = std::find(scene.observables.begin(), scene.observables.end(),
                                     "poincare_blade_passing") != scene.observables.end();
  const bool repeats_every_passing =
      !scene.unbalance && !scene.unequal_blades && !scene.wear && !scene.speed_ripple && !scene.speed_ramp;
  if (!has_passing && repeats_every_passing && scene.blades.count > 1) {
    result.push_back(
        fmt::format("without unbalance the natural period is a blade passing, T/{}: the observable "
                    "`poincare_blade_passing` would show period doublings that once-per-revolution "
                    "sections hide",
                    scene.blades.count));
  }
  return result;
}

}  // namespace rubatlas::mpi
