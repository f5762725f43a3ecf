#include "point/point_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "motion/changing_motion.hpp"
#include "point/map_listeners.hpp"
#include "point/orbit_listener.hpp"
#include "point/settling.hpp"
#include "point/solver_of_motions.hpp"
#include "settings/linearisation.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::point {

using ending::StatusDetail;

namespace {

motion::SectionState section_of(const motion::PointMotion& motion) {
  return rotor::as_array(rotor::shaft(motion.state()));
}

/// The section of all that moves, and the start of a motion there.
Section whole_section(const motion::PointMotion& motion) {
  const rotor::ShaftAndRing bodies = motion.state();
  const bool with_ring = !motion.memory().view().empty();
  Section section(with_ring ? 8 : 4);
  if (with_ring) {
    section << bodies.head<2>(), bodies.segment<2>(4), bodies.segment<2>(2), bodies.tail<2>();
  } else {
    section << bodies.head<4>();
  }
  return section;
}
motion::PointStart start_of(const Section& section) {
  if (section.size() == 4) return motion::SectionState{section[0], section[1], section[2], section[3]};
  const std::array<double, 4> ring{section[2], section[3], section[6], section[7]};
  return {motion::SectionState{section[0], section[1], section[4], section[5]}, motion::Memory(ring)};
}

/// Passes what happens in the sampled revolutions on to the observables.
class Recording final : public modes::MotionListener {
 public:
  explicit Recording(observables::Recorder& recorder) : recorder_(&recorder) {}
  void piece(trajectory::MotionPiece& piece) override { recorder_->piece(piece); }
  void event(const modes::Event& event) override {
    switch (event.kind) {
      case modes::Guard::touch_down:
        return recorder_->touch_down(event.blade);
      case modes::Guard::lift_off:
        return recorder_->lift_off(event.blade);
      case modes::Guard::slip_reversal:
        return recorder_->slip_reverses(event.blade);
      default:
        recorder_->changes_otherwise();
    }
  }
  void speed_changes(double speed_ratio) override { recorder_->speed_changes(speed_ratio); }
  void revolution_ends(const motion::SectionState& section) override { recorder_->revolution_ends(section); }

 private:
  observables::Recorder* recorder_;
};

/// Touch-downs (blade + 1) and lift-offs −(blade + 1) since they were last taken.
class Touches final : public modes::MotionListener {
 public:
  void event(const modes::Event& event) override {
    if (event.kind == modes::Guard::touch_down) events_.push_back(event.blade + 1);
    if (event.kind == modes::Guard::lift_off) events_.push_back(-event.blade - 1);
  }
  [[nodiscard]] std::vector<std::int32_t> take() { return std::exchange(events_, {}); }

 private:
  std::vector<std::int32_t> events_;
};

}  // namespace

std::unique_ptr<LineSolver> solver_of_motions(const settings::Scene& line, motion::MakeMotion make) {
  return std::make_unique<PointSolver>(line, std::move(make));
}

PointSolver::PointSolver(const settings::Scene& line, motion::MakeMotion make)
    : scene_(line), make_(std::move(make)), recorder_(line), settles_(settings::settles(line)) {}

/// A new motion for each point, so that a point depends on earlier points through its start only.
std::unique_ptr<motion::PointMotion> PointSolver::motion_of(double speed_ratio,
                                                            const motion::PointStart& start) const {
  if (motion::changes_between_revolutions(scene_))
    return std::make_unique<motion::ChangingMotion>(scene_, speed_ratio, start.memory, make_);
  return make_(speed_ratio, {});
}

PointOutcome PointSolver::run(double speed_ratio, const motion::PointStart& start, const modes::GoOn& go_on) {
  AfterTransient begun = transient(speed_ratio, start, go_on);
  Recording recording(recorder_);
  recorder_.begin(point_of(speed_ratio));
  int revolutions = scene_.protocol.sampled_revolutions;
  if (begun.settled > 0) {
    const auto period = static_cast<int>(begun.cycle.size());
    const bool exponents = scene_.observes("lyapunov");
    std::optional<Return> turn;
    if (exponents) {
      turn = return_from(*begun.motion, speed_ratio, begun.cycle.front(), period, true, go_on);
      begun.ending.detail = begun.motion->start(start_of(begun.cycle.front()));
    }
    recorder_.on_cycle(turn ? turn->jacobian : variation::Tangents{});
    revolutions = std::min(revolutions, period);
  }
  if (begun.ending.detail == StatusDetail::none)
    begun.ending = sampled(*begun.motion, revolutions, recording, go_on);
  PointOutcome outcome;
  outcome.detail = begun.ending.detail;
  outcome.status = ending::status_of(outcome.detail);
  outcome.failed_revolution = begun.ending.failed_revolution;
  outcome.final_state.fill(std::numeric_limits<double>::quiet_NaN());
  const bool done = outcome.status == ending::PointStatus::done;
  if (done) {
    outcome.settled = begun.settled;
    motion::PointStart end{section_of(*begun.motion), begun.motion->memory()};
    if (begun.settled > 0) {
      const auto sections = static_cast<std::size_t>(scene_.protocol.sampled_revolutions);
      end = start_of(begun.cycle[sections % begun.cycle.size()]);
    }
    outcome.final_state = end.state;
    outcome.final_memory = end.memory;
  }
  recorder_.clearance_grows(begun.motion->clearance_growth());
  outcome.rows = recorder_.rows(done);
  outcome.work = begun.work;
  outcome.work += begun.motion->work();
  return outcome;
}

ending::PointStatus PointSolver::listen(double speed_ratio, const motion::PointStart& start,
                                        modes::MotionListener& listener) {
  AfterTransient begun = transient(speed_ratio, start, {});
  return ending::status_of(whole(begun, listener).detail);
}

Orbit PointSolver::orbit(double speed_ratio, const motion::PointStart& start) {
  AfterTransient begun = transient(speed_ratio, start, {});
  OrbitListener listener(variation::constants_of(scene_, speed_ratio).period(),
                         scene_.protocol.samples_per_revolution, scene_.blades.count);
  const Ending ending = whole(begun, listener);
  Orbit orbit = listener.take();
  orbit.detail = ending.detail;
  orbit.status = ending::status_of(orbit.detail);
  orbit.failed_revolution = ending.failed_revolution;
  if (orbit.status == ending::PointStatus::done) orbit.final_memory = begun.motion->memory();
  return orbit;
}

auto PointSolver::transient(double speed_ratio, const motion::PointStart& start, const modes::GoOn& go_on)
    -> AfterTransient {
  const int revolutions = scene_.protocol.transient_revolutions;
  const int all = revolutions + scene_.protocol.sampled_revolutions;
  AfterTransient result{motion_of(speed_ratio, start), {}, 0, {}, {}};
  Touches touches;
  const double scale = variation::constants_of(scene_, 1.0).length_scale;
  // Runs from sections to where the motion would come, and finds there the contacts that it has met before.
  std::unique_ptr<motion::PointMotion> ahead;
  std::optional<Settling> settling;
  if (settles_) {
    // Exponents are those of a whole period, which has to be sampled.
    const int longest = scene_.observes("lyapunov") ? scene_.protocol.sampled_revolutions : all;
    settling.emplace(
        scene_.accuracy.tolerance * scale, scale,
        [&, speed_ratio](const Section& from, int count, bool derivative) {
          if (!ahead) ahead = motion_of(speed_ratio, start_of(from));
          return return_from(*ahead, speed_ratio, from, count, derivative, go_on);
        },
        static_cast<std::size_t>(longest));
  }
  const auto ended = [&](StatusDetail why, int revolution) {
    if (ahead) result.work += ahead->work();
    result.ending = {why, why == StatusDetail::given_up ? -1 : revolution};
    return std::move(result);
  };
  StatusDetail why = result.motion->start(start);
  if (why != StatusDetail::none) return ended(why, 0);
  for (int revolution = 0; revolution < revolutions; ++revolution) {
    why = result.motion->revolution(touches, go_on, revolution - revolutions);
    if (why != StatusDetail::none) return ended(why, revolution);
    if (go_on && !go_on()) {
      result.ending = {StatusDetail::given_up};
      return result;
    }
    if (!settling) continue;
    settling->add(whole_section(*result.motion), touches.take());
    auto cycle = settling->cycle(all - revolution - 1);
    if (!cycle) continue;
    // Every section keeps its place in the cycle.
    const auto left = static_cast<std::size_t>(revolutions - revolution - 1) % cycle->size();
    std::rotate(cycle->begin(), cycle->begin() + static_cast<std::ptrdiff_t>(left), cycle->end());
    result.settled = revolution + 1;
    result.work += result.motion->work();
    result.motion = std::move(ahead);
    why = result.motion->start(start_of(cycle->front()));
    result.cycle = std::move(*cycle);
    break;
  }
  return ended(why, why == StatusDetail::none ? -1 : revolutions);
}

std::optional<Return> PointSolver::return_from(motion::PointMotion& motion, double speed_ratio,
                                               const Section& from, int revolutions, bool derivative,
                                               const modes::GoOn& go_on) {
  Touches touches;
  std::optional<Mapping> mapping;
  if (derivative) mapping.emplace(tangents_at(speed_ratio), point_of(speed_ratio));
  modes::MotionListener& listener = derivative ? static_cast<modes::MotionListener&>(*mapping) : touches;
  Return result;
  StatusDetail why = motion.start(start_of(from));
  for (int revolution = 0; why == StatusDetail::none && revolution < revolutions; ++revolution) {
    why = motion.revolution(listener, go_on, revolution);
    result.sections.push_back(whole_section(motion));
  }
  if (why != StatusDetail::none) return std::nullopt;
  if (!derivative) {
    result.events = touches.take();
    return result;
  }
  SectionMap map = mapping->map();
  if (!map.differentiable) return std::nullopt;
  result.events = std::move(map.events);
  result.jacobian = map.jacobian;
  result.nearest_grazing =
      map.nearest_pass ? std::min(map.nearest_pass->miss, map.lightest_touch) : map.lightest_touch;
  return result;
}

PointSolver::Ending PointSolver::whole(AfterTransient& begun, modes::MotionListener& listener) const {
  if (begun.ending.detail != StatusDetail::none) return begun.ending;
  return sampled(*begun.motion, scene_.protocol.sampled_revolutions, listener, {});
}

PointSolver::Ending PointSolver::sampled(motion::PointMotion& motion, int revolutions,
                                         modes::MotionListener& listener, const modes::GoOn& go_on) const {
  for (int revolution = 0; revolution < revolutions; ++revolution) {
    const StatusDetail why = motion.revolution(listener, go_on, revolution);
    if (why == StatusDetail::given_up) return {why};
    if (why != StatusDetail::none) return {why, scene_.protocol.transient_revolutions + revolution};
    listener.revolution_ends(section_of(motion));
    if (go_on && !go_on()) return {StatusDetail::given_up};
  }
  return {};
}

SectionMap PointSolver::section_map(double speed_ratio, const motion::PointStart& start, int revolutions) {
  const auto motion = motion_of(speed_ratio, start);
  Mapping mapping(tangents_at(speed_ratio), point_of(speed_ratio));
  const StatusDetail why = follow(*motion, motion->start(start), mapping, revolutions);
  SectionMap map = mapping.map();
  map.detail = why;
  map.status = ending::status_of(why);
  return map;
}

TouchdownMap PointSolver::touchdown_map(double speed_ratio, const motion::PointStart& start, int passings) {
  const auto motion = motion_of(speed_ratio, start);
  Returning returning(tangents_at(speed_ratio), point_of(speed_ratio), start, passings);
  const int revolutions = passings / scene_.blades.count + 2;  // the last of them holds the end
  const StatusDetail why = follow(*motion, motion->start(start), returning, revolutions);
  TouchdownMap map = returning.map();
  // Whatever happens after the flight does not count.
  map.map.detail = map.complete ? StatusDetail::none : why;
  map.map.status = ending::status_of(map.map.detail);
  return map;
}

variation::TangentFlow& PointSolver::tangents_at(double speed_ratio) {
  if (!tangent_flow_) tangent_flow_.emplace(scene_);
  tangent_flow_->begin(speed_ratio);
  return *tangent_flow_;
}
trajectory::PointConstants PointSolver::point_of(double speed_ratio) const {
  return {variation::constants_of(scene_, speed_ratio).period(), speed_ratio, scene_.blades.count};
}
ending::StatusDetail PointSolver::follow(motion::PointMotion& motion, ending::StatusDetail why,
                                         modes::MotionListener& listener, int revolutions) {
  for (int revolution = 0; why == StatusDetail::none && revolution < revolutions; ++revolution) {
    why = motion.revolution(listener, {}, revolution);
    listener.revolution_ends(section_of(motion));
  }
  return why;
}

}  // namespace rubatlas::point
