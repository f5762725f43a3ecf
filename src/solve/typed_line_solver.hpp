/// From a scene's choices to types: the line solver of one law, one forcing and one method of integration.
///
/// Included by the files `method_<name>.cpp` only, each of which compiles its own motions.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "effects/unbalance.hpp"
#include "observables/recorder.hpp"
#include "solve/blade_tables.hpp"
#include "solve/line_solver.hpp"
#include "solve/methods.hpp"
#include "solve/motion_listener.hpp"
#include "solve/orbit_listener.hpp"
#include "solve/rotor.hpp"
#include "solve/settling.hpp"

namespace rubatlas::solve {

/// Passes what happens in the sampled revolutions on to the observables.
class RecordingListener final : public MotionListener {
 public:
  explicit RecordingListener(observables::Recorder& recorder) : recorder_(&recorder) {}
  void piece(observables::MotionPiece& piece) override { recorder_->piece(piece); }
  void event(const Event& event) override {
    if (event.kind == PhaseEvent::touch_down) recorder_->touch_down();
  }

 private:
  observables::Recorder* recorder_;
};

/// Makes the forcing of one point; the effects' types are chosen with it.
struct WithoutForcing {
  effects::NoForcing operator()(double /*speed_ratio*/) const { return {}; }
};
struct WithUnbalance {
  double specific_moment;  ///< me/m [m]
  double phase;            ///< γ [rad]
  double damping_ratio;    ///< ζ [-]
  effects::Unbalance operator()(double speed_ratio) const {
    return {specific_moment, phase, speed_ratio, damping_ratio};
  }
};

/// One line under one law, forcing and method. A method says what its motions are and how one is made:
/// `Method::Motion<Law, Forcing>`, `Method::make(rotor, law, forcing, scene)`.
template <class Method, class Law, class MakeForcing>
class TypedLineSolver final : public LineSolver {
 public:
  TypedLineSolver(const scene::Scene& scene, const plan::PointParameters& line, Law law,
                  MakeForcing make_forcing)
      : scene_(scene), line_(line), law_(std::move(law)), make_forcing_(make_forcing), recorder_(scene) {}

  PointOutcome run(double speed_ratio, const SectionState& start,
                   const std::function<void()>& between_revolutions) override {
    const auto motion = make_motion(speed_ratio);
    RecordingListener recording(recorder_);
    recorder_.begin({constants(speed_ratio).period(), speed_ratio, scene_.blades.count});
    PointOutcome outcome;
    const auto after_revolution = [&](bool sampled) {
      if (sampled) recorder_.revolution_ends(as_array(motion->state()));
      between_revolutions();
    };
    outcome.status = integrate(*motion, start, recording, after_revolution, outcome.failed_revolution);
    const bool done = outcome.status == PointStatus::done;
    outcome.final_state.fill(std::numeric_limits<double>::quiet_NaN());
    if (done) outcome.final_state = as_array(motion->state());
    outcome.rows = recorder_.rows(done);
    outcome.work = motion->work();
    return outcome;
  }

  Orbit orbit(double speed_ratio, const SectionState& start) override {
    const auto motion = make_motion(speed_ratio);
    OrbitListener listener(constants(speed_ratio).period(), scene_.protocol.samples_per_revolution,
                           scene_.blades.count);
    std::int32_t failed_revolution = -1;
    const auto after_revolution = [&](bool sampled) {
      if (sampled) listener.revolution_ends(as_array(motion->state()));
    };
    const PointStatus status = integrate(*motion, start, listener, after_revolution, failed_revolution);
    Orbit orbit = listener.take();
    orbit.status = status;
    orbit.failed_revolution = failed_revolution;
    return orbit;
  }

 private:
  using Forcing = std::invoke_result_t<MakeForcing, double>;
  using PointMotion = typename Method::template Motion<Law, Forcing>;

  [[nodiscard]] RotorConstants constants(double speed_ratio) const {
    const double clearance = scene_.clearance();
    const double frequency = scene_.rotor.natural_frequency;
    return {speed_ratio, line_.damping_ratio, scene_.rotor.misalignment,
            1.0 / (scene_.rotor.mass * frequency * frequency),
            clearance > 0.0 ? clearance : 0.1 * scene_.blades.length};
  }

  /// What tolerances are relative to [m].
  [[nodiscard]] double motion_scale() const { return constants(1.0).length_scale; }

  /// A fresh motion for each point: nothing but the start state crosses from point to point.
  [[nodiscard]] std::unique_ptr<PointMotion> make_motion(double speed_ratio) const {
    return Method::make(constants(speed_ratio), law_, make_forcing_(speed_ratio), scene_);
  }

  template <class AfterRevolution>
  PointStatus integrate(PointMotion& motion, const SectionState& start, MotionListener& sampling,
                        AfterRevolution after_revolution, std::int32_t& failed_revolution) const {
    MotionListener transient;
    const int first_sampled = scene_.protocol.transient_revolutions;
    const int revolutions = first_sampled + scene_.protocol.sampled_revolutions;
    Settling settling(Settling::kCloseness * scene_.accuracy.tolerance * motion_scale());
    bool watched = scene_.protocol.stop_when_periodic;
    PointStatus status = motion.start(as_state(start));
    for (int revolution = 0; revolution < revolutions; ++revolution) {
      const bool sampled = revolution >= first_sampled;
      if (status == PointStatus::done) status = motion.revolution(sampled ? sampling : transient);
      if (status != PointStatus::done) {
        failed_revolution = revolution;
        return status;
      }
      after_revolution(sampled);
      if (!watched || sampled) continue;
      settling.add(motion.state());
      if (const int period = settling.period()) {
        // Whole periods are left out, so that every section keeps its place in the cycle.
        revolution += (first_sampled - 1 - revolution) / period * period;
        watched = false;
      }
    }
    return status;
  }

  scene::Scene scene_;
  plan::PointParameters line_;
  Law law_;
  MakeForcing make_forcing_;
  observables::Recorder recorder_;
};

template <class Method, class Law>
std::unique_ptr<LineSolver> with_forcing(const scene::Scene& scene, const plan::PointParameters& line,
                                         Law law) {
  // Absent means absent: a rotor without unbalance has no forcing in its equations.
  if (!scene.unbalance || line.unbalance == 0.0) {
    return std::make_unique<TypedLineSolver<Method, Law, WithoutForcing>>(scene, line, std::move(law),
                                                                          WithoutForcing{});
  }
  const WithUnbalance unbalance{line.unbalance / scene.rotor.mass, scene.unbalance->phase,
                                line.damping_ratio};
  return std::make_unique<TypedLineSolver<Method, Law, WithUnbalance>>(scene, line, std::move(law),
                                                                       unbalance);
}

/// The elastica blades of a line.
inline contact::ElasticaContact elastica_of(const LineRequest& request) {
  const scene::Blades& blades = request.scene.blades;
  const contact::Geometry geometry{blades.hub_radius + blades.length, request.scene.ring.radius};
  const double thickness = request.line.thickness;
  const double stiffness = blades.youngs_modulus * blades.width * thickness * thickness * thickness / 12.0;
  return {geometry, {blades.length, thickness, stiffness}, request.tables.curve(request.line.friction)};
}

/// The line solver of a method for a scene's law and forcing.
template <class Method>
std::unique_ptr<LineSolver> make_typed_line_solver(const LineRequest& request) {
  const scene::Scene& scene = request.scene;
  const plan::PointParameters& line = request.line;
  if (scene.contact.law == scene::ContactLaw::elastic_ring) {
    const contact::Geometry geometry{scene.blades.hub_radius + scene.blades.length, scene.ring.radius};
    return with_forcing<Method>(scene, line,
                                contact::ElasticRingContact(geometry, scene.ring.stiffness, line.friction));
  }
  return with_forcing<Method>(scene, line, elastica_of(request));
}

}  // namespace rubatlas::solve
