#include "point/point_solver.hpp"

#include <limits>
#include <utility>

#include "motion/changing_motion.hpp"
#include "observables/grazing.hpp"
#include "point/orbit_listener.hpp"
#include "point/settling.hpp"
#include "point/solver_of_motions.hpp"

namespace rubatlas::point {
namespace {

motion::SectionState section_of(const motion::PointMotion& motion) {
  return rotor::as_array(rotor::shaft(motion.state()));
}

/// Passes what happens in the sampled revolutions on to the observables.
class Recording final : public modes::MotionListener {
 public:
  explicit Recording(observables::Recorder& recorder) : recorder_(&recorder) {}
  void piece(observables::MotionPiece& piece) override { recorder_->piece(piece); }
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

/// Follows a motion for its section map.
class Mapping final : public modes::MotionListener {
 public:
  Mapping(SectionMap& map, variation::TangentFlow& flow, const observables::PointConstants& point)
      : map_(&map), flow_(&flow), touch_(point.blade_count) {
    miss_.begin(point);
    touch_.begin(point);
  }
  void piece(observables::MotionPiece& piece) override {
    flow_->piece(piece);
    miss_.piece(piece);
    touch_.piece(piece);
  }
  void event(const modes::Event& event) override {
    using modes::Guard;
    if (event.kind == Guard::touch_down || event.kind == Guard::lift_off) {
      const bool opens = event.kind == Guard::touch_down;
      flow_->passes_ring(event.blade);
      map_->events.push_back(opens ? event.blade + 1 : -event.blade - 1);
      opens ? touch_.touch_down(event.blade) : touch_.lift_off(event.blade);
    } else if (event.kind == Guard::slip_reversal) {
      flow_->slip_reverses(event.blade);
    } else {
      flow_->loses_track();
    }
  }
  void finish() {
    map_->differentiable = flow_->known();
    map_->jacobian = flow_->tangents();
    map_->log_saltation = flow_->log_saltation();
    map_->nearest_pass = miss_.nearest();
    if (const auto& lightest = touch_.lightest()) {
      map_->lightest_touch = lightest->depth;
      map_->lightest_side = lightest->side;
    }
  }

 private:
  SectionMap* map_;
  variation::TangentFlow* flow_;
  observables::NearestMiss miss_;
  observables::LightestTouch touch_;
};

}  // namespace

rotor::RotorConstants constants_of(const settings::Scene& line, double speed_ratio) {
  const double clearance = line.clearance();
  const double frequency = line.rotor.natural_frequency;
  return {speed_ratio, line.rotor.damping_ratio, line.rotor.misalignment,
          1.0 / (line.rotor.mass * frequency * frequency),
          clearance > 0.0 ? clearance : 0.1 * line.blades.length};
}

std::unique_ptr<LineSolver> solver_of_motions(const settings::Scene& line, motion::MakeMotion make) {
  return std::make_unique<PointSolver>(line, std::move(make));
}

PointSolver::PointSolver(const settings::Scene& line, motion::MakeMotion make)
    : scene_(line), make_(std::move(make)), recorder_(line) {}

/// A new motion for each point, so that a point depends on earlier points through its start only.
std::unique_ptr<motion::PointMotion> PointSolver::motion_of(double speed_ratio,
                                                            const motion::PointStart& start) const {
  if (motion::changes_between_revolutions(scene_))
    return std::make_unique<motion::ChangingMotion>(scene_, speed_ratio, start.memory, make_);
  return make_(speed_ratio, {});
}

PointOutcome PointSolver::run(double speed_ratio, const motion::PointStart& start, const modes::GoOn& go_on) {
  const auto motion = motion_of(speed_ratio, start);
  Recording recording(recorder_);
  recorder_.begin({constants_of(scene_, speed_ratio).period(), speed_ratio, scene_.blades.count});
  const Ending ending = integrate(*motion, start, recording, go_on);
  PointOutcome outcome;
  outcome.status = ending.status;
  outcome.detail = ending.detail;
  outcome.failed_revolution = ending.failed_revolution;
  outcome.final_state.fill(std::numeric_limits<double>::quiet_NaN());
  const bool done = outcome.status == PointStatus::done;
  if (done) {
    outcome.final_state = section_of(*motion);
    outcome.final_memory = motion->memory();
  }
  recorder_.clearance_grows(motion->clearance_growth());
  outcome.rows = recorder_.rows(done);
  outcome.work = motion->work();
  return outcome;
}

Orbit PointSolver::orbit(double speed_ratio, const motion::PointStart& start) {
  const auto motion = motion_of(speed_ratio, start);
  OrbitListener listener(constants_of(scene_, speed_ratio).period(), scene_.protocol.samples_per_revolution,
                         scene_.blades.count);
  const Ending ending = integrate(*motion, start, listener, {});
  Orbit orbit = listener.take();
  orbit.status = ending.status;
  orbit.detail = ending.detail;
  orbit.failed_revolution = ending.failed_revolution;
  return orbit;
}

PointSolver::Ending PointSolver::integrate(motion::PointMotion& motion, const motion::PointStart& start,
                                           modes::MotionListener& sampling, const modes::GoOn& go_on) const {
  modes::MotionListener transient;
  const int first_sampled = scene_.protocol.transient_revolutions;
  const int revolutions = first_sampled + scene_.protocol.sampled_revolutions;
  const double scale = constants_of(scene_, 1.0).length_scale;
  Settling settling(Settling::kCloseness * scene_.accuracy.tolerance * scale);
  bool watched = scene_.protocol.stop_when_periodic;
  PointStatus status = motion.start(start);
  for (int revolution = 0; revolution < revolutions; ++revolution) {
    const bool sampled = revolution >= first_sampled;
    modes::MotionListener& listener = sampled ? sampling : transient;
    if (status == PointStatus::done) status = motion.revolution(listener, go_on, revolution - first_sampled);
    if (status == PointStatus::pending) return {status, motion.status_detail()};
    if (status != PointStatus::done) return {status, motion.status_detail(), revolution};
    if (sampled) sampling.revolution_ends(section_of(motion));
    if (go_on && !go_on()) return {PointStatus::pending, StatusDetail::given_up};
    if (!watched || sampled) continue;
    settling.add(motion.state());
    if (const int period = settling.period()) {
      // Whole periods are left out, so that every section keeps its place in the cycle.
      revolution += (first_sampled - 1 - revolution) / period * period;
      watched = false;
    }
  }
  return {status};
}

SectionMap PointSolver::section_map(double speed_ratio, const motion::PointStart& start, int revolutions) {
  if (!tangent_flow_) tangent_flow_.emplace(scene_);
  tangent_flow_->begin(speed_ratio);
  const auto motion = motion_of(speed_ratio, start);
  SectionMap map;
  Mapping mapping(map, *tangent_flow_,
                  {constants_of(scene_, speed_ratio).period(), speed_ratio, scene_.blades.count});
  map.status = motion->start(start);
  for (int revolution = 0; map.status == PointStatus::done && revolution < revolutions; ++revolution) {
    map.status = motion->revolution(mapping, {}, revolution);
    map.sections.push_back(section_of(*motion));
  }
  if (map.status != PointStatus::done) map.detail = motion->status_detail();
  mapping.finish();
  return map;
}

}  // namespace rubatlas::point
