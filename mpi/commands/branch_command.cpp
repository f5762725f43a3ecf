#include "mpi/commands/branch_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "assembly/make_line_solver.hpp"
#include "atlas/branch_file.hpp"
#include "atlas/output.hpp"
#include "branch/continuation.hpp"
#include "branch/curve.hpp"
#include "mpi/commands/place.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/job/signals.hpp"
#include "mpi/say.hpp"
#include "mpi/version.hpp"
#include "plan/grid.hpp"
#include "settings/linearisation.hpp"
#include "settings/nearest.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::mpi {
namespace {

/// Newton's method closes orbits to 1e-12 of the clearance: their motions have to be as accurate.
constexpr double kTightest = 1e-12;
/// Of the size of a quantity, or of how far it may go where that is more: what arclengths are counted in.
constexpr double kShare = 0.1;

/// The place of an axis that `option` names.
std::size_t axis_of(const std::vector<settings::Axis>& axes, const std::string& name,
                    std::string_view option) {
  std::vector<std::string_view> names;
  names.reserve(axes.size());
  for (const auto& axis : axes) names.push_back(axis.name);
  const auto found = std::ranges::find_if(
      axes, [&](const settings::Axis& axis) { return axis.name == name || axis.quantity->pointer == name; });
  if (found == axes.end()) {
    throw UsageError(fmt::format("{} {}: no quantity of the scene's grid; they are {}; nearest: {}", option,
                                 name, fmt::join(names, ", "), settings::nearest(name, names)));
  }
  return static_cast<std::size_t>(found - axes.begin());
}

/// A quantity may go as far as a scene may have it, or to the limits of the command.
branch::Varied varied(const settings::Axis& axis, std::size_t place, double value,
                      const std::vector<double>& within) {
  const settings::Range& range = axis.quantity->range;
  double size = std::abs(value);
  for (const double limit : within) size = std::max(size, std::abs(limit - value));
  if (size == 0.0) size = std::min(1e-3 * range.high, 1.0);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  branch::Varied result{place, kShare * size,
                        range.low_excluded ? std::nextafter(range.low, kInfinite) : range.low,
                        range.high_excluded ? std::nextafter(range.high, -kInfinite) : range.high};
  if (!within.empty()) {
    result.lowest = std::max(result.lowest, within.front());
    result.highest = std::min(result.highest, within.back());
  }
  return result;
}

double limit_of(const settings::Axis& axis, double limit, std::string_view option) {
  if (axis.quantity->range.contains(limit)) return limit;
  throw UsageError(
      fmt::format("{} {}: {} is a number in {}", option, limit, axis.name, axis.quantity->range.text()));
}

std::string sentence_of(const branch::Event& event, std::string_view name, int blades) {
  const double value = event.orbit.quantities.front();
  std::string text = fmt::format("{} at {} = {:.10g}", branch::word_of(event.kind), name, value);
  constexpr double kLastDigit = 1e-10;  // of the value
  if (event.uncertainty > kLastDigit * std::abs(value)) text += fmt::format(" ± {:.1g}", event.uncertainty);
  text += fmt::format(", period {}", event.orbit.period);
  const int whole = event.orbit.period * blades;
  if (event.orbit.passings < whole)
    text += fmt::format(", repeated after {} of {} blade passings", event.orbit.passings, whole);
  if (event.kind == branch::EventKind::grazing) {
    text += event.side == observables::GrazingSide::receding ? ", on the receding side"
                                                             : ", on the approaching side";
  }
  return text;
}

/// Ends a branch where `--points` or a signal asks for it, and shows on a terminal how far it is.
class Watch {
 public:
  Watch(std::string_view name, int points) : name_(name), points_(static_cast<std::size_t>(points)) {
    note_stop_signals();
  }

  branch::GoOn go_on() {
    return [this](std::size_t orbits, const branch::Orbit& last) {
      const auto now = std::chrono::steady_clock::now();
      if (is_terminal_ && now >= next_) {
        constexpr std::chrono::milliseconds kPeriod{200};
        next_ = now + kPeriod;
        line_.show(fmt::format("{} orbits, period {}, {} = {:.10g}", orbits, last.period, name_,
                               last.quantities.front()));
      }
      return orbits < points_ && !stop_requested();
    };
  }
  /// A branch that has been ended says where; `end` is where it would have ended else.
  void say_where_it_stopped(const branch::Branch& branch, std::string_view end) {
    line_.leave();
    if (!branch.goes_on) return;
    say_sentence(fmt::format("stopped after {} orbits at {} = {:.10g}, before {}{}", branch.orbits.size(),
                             name_, branch.orbits.back().quantities.front(), end,
                             stop_requested() ? "" : "; a larger --points goes on"));
  }

 private:
  std::string_view name_;
  std::size_t points_;
  bool is_terminal_ = ::isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point next_;
  RewrittenLine line_;
};

/// A curve of bifurcations in two quantities.
struct CurveRequest {
  branch::EventKind kind;
  std::size_t in;           ///< the place of the second quantity's axis
  branch::Varied quantity;  ///< the second one
};

void require_within(const std::vector<double>& within, const settings::Axis& axis, double start) {
  if (within.empty()) return;
  for (const double limit : within) static_cast<void>(limit_of(axis, limit, "--within"));
  const std::string option = fmt::format("--within {}", fmt::join(within, " "));
  if (within.front() >= within.back())
    throw UsageError(option + ": the lower limit comes first, and the upper one is above it");
  if (start < within.front() || start > within.back())
    throw UsageError(
        fmt::format("{}: the curve starts at {} = {}, which is outside", option, axis.name, start));
}

/// What the call says of a curve, checked before anything is computed; none where it asks for none.
std::optional<CurveRequest> curve_request(const BranchCommand& command,
                                          const std::vector<settings::Axis>& axes,
                                          const std::vector<double>& parameters) {
  if (command.curve.has_value() != command.in.has_value())
    throw UsageError("--curve and --in belong together: a curve of bifurcations lies in two quantities");
  if (!command.curve) {
    if (command.within.empty()) return std::nullopt;
    throw UsageError("--within: limits of a curve's second quantity, which --curve and --in ask for");
  }
  const auto kind = branch::kind_of(*command.curve);
  if (!kind || *kind > branch::EventKind::neimark_sacker) {
    throw UsageError(
        fmt::format("--curve {}: allowed: fold, period_doubling, neimark_sacker", *command.curve));
  }
  const std::size_t in = axis_of(axes, *command.in, "--in");
  if (in == axis_of(axes, command.along, "--along"))
    throw UsageError("--in: the same quantity as --along; a curve lies in two");
  require_within(command.within, axes[in], parameters[in]);
  return CurveRequest{*kind, in, varied(axes[in], in, parameters[in], command.within)};
}

/// The event of a kind, of an orbit of at least so many passings of blades, that lies nearest to where the
/// branch was begun; null: there is none.
const branch::Event* nearest_event(const std::vector<branch::Event>& events, branch::EventKind kind,
                                   double value, int least_passings = 1) {
  const branch::Event* nearest = nullptr;
  const auto distance = [&](const branch::Event& event) {
    return std::abs(event.orbit.quantities.front() - value);
  };
  for (const branch::Event& event : events) {
    if (event.kind != kind || event.orbit.passings < least_passings) continue;
    if (nearest == nullptr || distance(event) < distance(*nearest)) nearest = &event;
  }
  return nearest;
}

/// A branch both ways from its first orbit, as one.
branch::Branch joined(branch::Branch down, branch::Branch up) {
  if (down.orbits.empty()) return up;
  std::ranges::reverse(down.orbits);
  if (!up.orbits.empty()) down.orbits.pop_back();  // the first orbit of both
  std::ranges::move(up.orbits, std::back_inserter(down.orbits));
  std::ranges::reverse(down.events);
  std::ranges::move(up.events, std::back_inserter(down.events));
  down.goes_on = down.goes_on || up.goes_on;
  return down;
}

}  // namespace

int follow_branch(const BranchCommand& command) {
  const std::string text = settings::read_text(command.scene);
  settings::Scene scene = settings::parse_scene(text, command.scene.string());
  if (const auto refusal = settings::refusal_of_shooting(scene))
    throw UsageError(fmt::format("{}: {}", command.scene.string(), *refusal));
  const Place place = place_of(scene, command.from, "--from");
  if (place.direction)
    throw UsageError("--from direction: a branch has none; it is followed both ways by --both");
  const atlas::Output output = atlas::permitted(
      {command.output, atlas::FileKind::branch, atlas::existing(command.overwrite)}, {command.scene});

  const auto axes = settings::axes_of(scene);
  const std::vector<double> parameters = plan::values_of(place.parameters);
  const std::size_t along = axis_of(axes, command.along, "--along");
  const double value = parameters[along];
  std::vector<double> within;
  if (command.to) {
    const double to = limit_of(axes[along], *command.to, "--to");
    if (to == value) throw UsageError(fmt::format("--to {}: that is where the branch starts", to));
    const double other = command.both ? 2.0 * value - to : value;
    within = {std::min(other, to), std::max(other, to)};
  } else if (axes[along].values.size() > 1) {
    const auto [low, high] = std::ranges::minmax(axes[along].values);
    within = {std::min(value, low), std::max(value, high)};
  }
  const branch::Varied first = varied(axes[along], along, value, within);
  const std::optional<CurveRequest> curve = curve_request(command, axes, parameters);
  scene.accuracy.tolerance = std::min(scene.accuracy.tolerance, kTightest);
  scene.observables.clear();

  branch::Shooting shooting(scene, parameters, {first});
  branch::Continuation continuation(shooting);
  const auto start = continuation.settle(assembly::initial_state(scene, place.parameters), {value},
                                         scene.protocol.transient_revolutions);
  if (!start) {
    throw UsageError(
        fmt::format("--from {}: the motion from /initial does not settle on a periodic orbit within {} "
                    "revolutions, or leaves the model, as `rubatlas orbit` shows; choose another place, or a "
                    "longer /protocol/transient_revolutions",
                    fmt::join(command.from, ","), scene.protocol.transient_revolutions));
  }
  const double direction = command.to && *command.to < value ? -1.0 : 1.0;
  const std::string end = command.to && !command.both
                              ? fmt::format("--to {}", *command.to)
                              : fmt::format("an end of {} to {}", first.lowest, first.highest);
  Watch watch(command.along, command.points);

  atlas::BranchContents contents{
      {axes[along].quantity}, {}, std::nullopt, scene.accuracy.tolerance, parameters};
  branch::Branch followed = continuation.follow(*start, direction, watch.go_on());
  watch.say_where_it_stopped(followed, end);
  if ((command.both || !command.to) && !stop_requested()) {
    branch::Branch back = continuation.follow(*start, -direction, watch.go_on());
    watch.say_where_it_stopped(back, end);
    followed = joined(std::move(back), std::move(followed));
  }
  contents.branches.reserve(2);  // `events` stay where they are
  contents.branches.push_back(std::move(followed));
  const std::vector<branch::Event>& events = contents.branches.front().events;
  for (const branch::Event& event : events)
    say_sentence(sentence_of(event, command.along, scene.blades.count));

  if (command.doubled && !stop_requested()) {
    // The branch's own end is the doubling of an orbit of half its passings, which leads back to it.
    const branch::Event* doubling =
        nearest_event(events, branch::EventKind::period_doubling, value, start->passings);
    if (doubling == nullptr)
      throw UsageError("--switch: no period doubling among the orbits that were followed to switch at");
    auto doubled = continuation.follow_doubled(*doubling, watch.go_on());
    if (!doubled) throw UsageError("--switch: the branch of doubled period could not be found");
    watch.say_where_it_stopped(*doubled, end);
    for (const branch::Event& event : doubled->events)
      say_sentence(sentence_of(event, command.along, scene.blades.count));
    contents.branches.push_back(std::move(*doubled));
  }
  if (curve && !stop_requested()) {
    const branch::Event* event = nearest_event(events, curve->kind, value);
    if (event == nullptr)
      throw UsageError(
          fmt::format("--curve {}: there is none among the orbits that were followed", *command.curve));
    branch::Shooting both(scene, parameters, {varied(axes[along], along, value, {}), curve->quantity});
    branch::Orbit from = event->orbit;
    from.quantities.push_back(parameters[curve->in]);
    branch::Branch found = branch::follow_curve(both, curve->kind, from, watch.go_on());
    if (found.orbits.empty()) throw UsageError("--curve: the curve could not be followed from there");
    watch.say_where_it_stopped(found, "an end of the curve");
    for (const branch::Event& lost : found.events)
      say_sentence(sentence_of(lost, command.along, scene.blades.count));
    contents.quantities.push_back(axes[curve->in].quantity);
    contents.curve_of = curve->kind;
    contents.branches = {std::move(found)};
  }
  std::size_t count = 0;
  for (const branch::Branch& each : contents.branches) count += each.orbits.size();
  atlas::write_branch(output, scene, text, contents, software());
  say_sentence(fmt::format("{} periodic orbits in {}", count, command.output.string()));
  return stop_requested() ? exit_code::kInterrupted : exit_code::kDone;
}

}  // namespace rubatlas::mpi
