/// From a scene's choices to types: the line solver of one law, one forcing and one method of integration.
///
/// Included by the files `method_<name>.cpp` only, each of which compiles its own motions.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "observables/recorder.hpp"
#include "solve/blade_tables.hpp"
#include "solve/bodies.hpp"
#include "solve/changing_motion.hpp"
#include "solve/line_solver.hpp"
#include "solve/machine.hpp"
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
  void speed_changes(double speed_ratio) override { recorder_->speed_changes(speed_ratio); }

 private:
  observables::Recorder* recorder_;
};

/// One line under one law, on one machine, by one method. A method says what its motions are and how one is
/// made: `Method::Motion<Law, Forcing, Blades>`, `Method::make(rotor, blades, law, forcing, scene)`.
template <class Method, class Law, class Machine>
class TypedLineSolver final : public LineSolver {
 public:
  /// `line`: the scene with the line's values of all that is swept.
  TypedLineSolver(const scene::Scene& line, Law law, Machine machine)
      : scene_(line), law_(std::move(law)), machine_(std::move(machine)), recorder_(line) {}

  PointOutcome run(double speed_ratio, const PointStart& start, const GoOn& go_on) override {
    return with_motion(speed_ratio, start,
                       [&](auto& motion) { return run_motion(motion, speed_ratio, start, go_on); });
  }

  Orbit orbit(double speed_ratio, const PointStart& start) override {
    return with_motion(speed_ratio, start,
                       [&](auto& motion) { return orbit_of(motion, speed_ratio, start); });
  }

 private:
  using Forcing = decltype(std::declval<Machine>().forcing(1.0));
  using Blades = decltype(std::declval<Machine>().blades(1.0));
  using PointMotion = typename Method::template Motion<Law, Forcing, Blades>;

  /// Calls `use` with the motion of a point; a fresh one for each, so that nothing but its start crosses from
  /// point to point.
  template <class Use>
  auto with_motion(double speed_ratio, const PointStart& start, Use use) const {
    if constexpr (Machine::kMayChange) {
      if (changes_between_revolutions(scene_)) {
        const auto make = [this](double speed, std::span<const double> lost) {
          return make_motion(speed, law_.shortened(lost));
        };
        ChangingMotion changing(scene_, speed_ratio, start.memory, make);
        return use(changing);
      }
    }
    const auto motion = make_motion(speed_ratio, law_);
    return use(*motion);
  }

  template <class AnyMotion>
  PointOutcome run_motion(AnyMotion& motion, double speed_ratio, const PointStart& start, const GoOn& go_on) {
    RecordingListener recording(recorder_);
    recorder_.begin({constants(speed_ratio).period(), speed_ratio, scene_.blades.count});
    PointOutcome outcome;
    const auto after_revolution = [&](bool sampled) {
      if (sampled) recorder_.revolution_ends(as_array(shaft(motion.state())));
    };
    const Ending ending = integrate(motion, start, recording, after_revolution, go_on);
    outcome.status = ending.status;
    outcome.detail = ending.detail;
    outcome.failed_revolution = ending.failed_revolution;
    const bool done = outcome.status == PointStatus::done;
    outcome.final_state.fill(std::numeric_limits<double>::quiet_NaN());
    if (done) outcome.final_state = as_array(shaft(motion.state()));
    if constexpr (kRingMoves<Forcing>) {
      if (done) outcome.final_memory = Memory(as_array(ring(motion.state())));
    } else if constexpr (requires { motion.memory(); }) {
      if (done) outcome.final_memory = motion.memory();
      recorder_.clearance_grows(motion.clearance_growth());
    }
    outcome.rows = recorder_.rows(done);
    outcome.work = motion.work();
    return outcome;
  }

  template <class AnyMotion>
  Orbit orbit_of(AnyMotion& motion, double speed_ratio, const PointStart& start) const {
    OrbitListener listener(constants(speed_ratio).period(), scene_.protocol.samples_per_revolution,
                           scene_.blades.count);
    const auto after_revolution = [&](bool sampled) {
      if (sampled) listener.revolution_ends(as_array(shaft(motion.state())));
    };
    const Ending ending = integrate(motion, start, listener, after_revolution, {});
    Orbit orbit = listener.take();
    orbit.status = ending.status;
    orbit.detail = ending.detail;
    orbit.failed_revolution = ending.failed_revolution;
    return orbit;
  }

  /// What moves at the start of a point. A ring of which nothing is remembered is at rest in its place.
  static BodiesOf<Forcing> bodies_at(const PointStart& start) {
    BodiesOf<Forcing> bodies = ring_at_rest<Forcing>(as_state(start.state));
    if constexpr (kRingMoves<Forcing>) {
      const std::span<const double> ring = start.memory.view();
      if (!ring.empty()) bodies.template tail<4>() = State(ring.data());
    }
    return bodies;
  }

  [[nodiscard]] RotorConstants constants(double speed_ratio) const {
    const double clearance = scene_.clearance();
    const double frequency = scene_.rotor.natural_frequency;
    return {speed_ratio, scene_.rotor.damping_ratio, scene_.rotor.misalignment,
            1.0 / (scene_.rotor.mass * frequency * frequency),
            clearance > 0.0 ? clearance : 0.1 * scene_.blades.length};
  }

  /// What tolerances are relative to [m].
  [[nodiscard]] double motion_scale() const { return constants(1.0).length_scale; }

  [[nodiscard]] std::unique_ptr<PointMotion> make_motion(double speed_ratio, const Law& law) const {
    return Method::make(constants(speed_ratio), machine_.blades(speed_ratio), law,
                        machine_.forcing(speed_ratio), scene_);
  }

  struct Ending {
    PointStatus status;
    StatusDetail detail = StatusDetail::none;
    std::int32_t failed_revolution = -1;
  };

  template <class AnyMotion, class AfterRevolution>
  Ending integrate(AnyMotion& motion, const PointStart& start, MotionListener& sampling,
                   AfterRevolution after_revolution, const GoOn& go_on) const {
    MotionListener transient;
    const int first_sampled = scene_.protocol.transient_revolutions;
    const int revolutions = first_sampled + scene_.protocol.sampled_revolutions;
    using Section = std::remove_cvref_t<decltype(motion.state())>;
    Settling<Section> settling(Settling<Section>::kCloseness * scene_.accuracy.tolerance * motion_scale());
    bool watched = scene_.protocol.stop_when_periodic;
    PointStatus status = motion.start(bodies_at(start));
    for (int revolution = 0; revolution < revolutions; ++revolution) {
      const bool sampled = revolution >= first_sampled;
      MotionListener& listener = sampled ? sampling : transient;
      if (status == PointStatus::done) {
        if constexpr (requires { motion.revolution(listener, go_on, revolution); }) {
          status = motion.revolution(listener, go_on, revolution);
        } else {
          status = motion.revolution(listener, go_on);
        }
      }
      if (status == PointStatus::pending) return {status, motion.status_detail()};
      if (status != PointStatus::done) return {status, motion.status_detail(), revolution};
      after_revolution(sampled);
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

  scene::Scene scene_;
  Law law_;
  Machine machine_;
  observables::Recorder recorder_;
};

inline contact::Geometry geometry_of(const scene::Ring& ring, const scene::Blades& blade) {
  return {blade.hub_radius + blade.length, ring.radius};
}
inline contact::ElasticRingContact elastic_ring_law(const scene::Ring& ring, const scene::Blades& blade,
                                                    double friction) {
  return {geometry_of(ring, blade), ring.stiffness, friction};
}
inline contact::ElasticaContact::Blade blade_of(const scene::Blades& blade) {
  const double thickness = blade.thickness;
  return {blade.length, thickness,
          blade.youngs_modulus * blade.width * thickness * thickness * thickness / 12.0};
}
/// The curve of a blade: elastica or beam-column, and its axial compliance.
inline std::shared_ptr<const blade::ElasticaCurve> curve_of(const LineRequest& request,
                                                            const scene::Blades& blade) {
  const scene::Scene& line = request.line;
  const auto theory = line.contact.law == scene::ContactLaw::beam_column ? blade::Theory::beam_column
                                                                         : blade::Theory::elastica;
  double compliance = 0.0;
  if (effects::acts<&effects::Effects::axial_compliance>(line)) {
    const double slenderness = blade.thickness / blade.length;
    compliance = line.axial_compliance->share * slenderness * slenderness / 12.0;
  }
  return request.tables.curve(line.contact.friction, theory, compliance);
}

template <class Method, class Law>
std::unique_ptr<LineSolver> on_paper_s_machine(const scene::Scene& line, Law law) {
  // Absent means absent: a rotor without unbalance has no forcing in its equations.
  if (!effects::acts<&effects::Effects::unbalance>(line)) {
    return std::make_unique<TypedLineSolver<Method, Law, PlainMachine>>(line, std::move(law),
                                                                        PlainMachine{line.blades.count});
  }
  const UnbalancedMachine machine{line.blades.count, line.unbalance->moment / line.rotor.mass,
                                  line.unbalance->phase, line.rotor.damping_ratio};
  return std::make_unique<TypedLineSolver<Method, Law, UnbalancedMachine>>(line, std::move(law), machine);
}

/// The line solver of a method for the paper's rotor, by the scene's law.
template <class Method>
std::unique_ptr<LineSolver> make_typed_line_solver(const LineRequest& request) {
  const scene::Scene& line = request.line;
  if (line.contact.law == scene::ContactLaw::elastic_ring) {
    return on_paper_s_machine<Method>(line, elastic_ring_law(line.ring, line.blades, line.contact.friction));
  }
  return on_paper_s_machine<Method>(
      line, contact::ElasticaContact(geometry_of(line.ring, line.blades), blade_of(line.blades),
                                     curve_of(request, line.blades)));
}

}  // namespace rubatlas::solve
