/// A motion below the scene, revolution by revolution, with its events and the force at the start of each
/// contact: for cases that a scene cannot say (a signed spin, a start on the ring to the last bit).
#pragma once

#include <memory>
#include <vector>

#include "../support/hybrid_motion.hpp"

namespace rubatlas::test {

/// For those who look at the sections of a motion alone.
inline constexpr auto kNoPiece = [](trajectory::MotionPiece&) {};

/// Rotor, blades and ring of MODEL 6.1 where nothing else is said.
struct HardRotor {
  double speed_ratio = 0.3;       ///< Ω, may be negative [-]
  double damping_ratio = 0.1;     ///< ζ [-]
  double misalignment = 0.01001;  ///< y0 [m]
  int blades = 3;
  double ring_radius = 0.11;                              ///< R [m]
  double hub_radius = 0.0;                                ///< rh [m]
  double length = 0.1;                                    ///< L [m]
  double thickness = 1e-3;                                ///< h [m]
  double bending_stiffness = 206e9 * 0.01 * 1e-9 / 12.0;  ///< EI [N m²]
  double ring_stiffness = 1e4;                            ///< kr [N/m]
  double friction = 0.1;                                  ///< μ [-]
  double force_unit = 0.01;                               ///< 1/(m ωn²) [m/N]
  double tolerance = 1e-12;                               ///< of the clearance
  double max_shortening = 0.5;                            ///< of δ/L [-]

  [[nodiscard]] double clearance() const { return ring_radius - hub_radius - length; }
  [[nodiscard]] contact::Geometry geometry() const { return {hub_radius + length, ring_radius}; }
  [[nodiscard]] double euler_load() const {  ///< [N]
    return 0.25 * 9.869604401089358 * bending_stiffness / (length * length);
  }
  [[nodiscard]] rotor::RotorConstants constants() const {
    return {speed_ratio, damping_ratio, misalignment, force_unit, clearance()};
  }
  [[nodiscard]] modes::ContactLimits limits() const { return {tolerance * clearance(), max_shortening}; }
  [[nodiscard]] contact::ElasticaContact elastica() const {
    return {
        geometry(), {length, thickness, bending_stiffness}, std::make_shared<blade::ElasticaCurve>(friction)};
  }
  [[nodiscard]] contact::ElasticRingContact elastic_ring() const {
    return {geometry(), ring_stiffness, {friction}};
  }
};

/// Pose of a blade at time τ of the revolution.
inline contact::Pose pose_at(const HardRotor& rotor, int blade, double time, const rotor::State& state) {
  const rotor::BladeSet blades(rotor.blades, rotor.speed_ratio);
  return rotor::pose_of(rotor.constants(), rotor.geometry(), blades.direction(blade, blades.first(time)),
                        state);
}

struct RecordedEvent {
  int revolution;
  modes::Event event;
};

struct RecordedMotion {
  ending::PointStatus status = ending::PointStatus::pending;
  std::vector<RecordedEvent> events;
  std::vector<rotor::State> sections;  ///< after each revolution
  motion::WorkCounts work;

  [[nodiscard]] std::vector<modes::Event> of_kind(modes::Guard kind) const {
    std::vector<modes::Event> found;
    for (const RecordedEvent& entry : events) {
      if (entry.event.kind == kind) found.push_back(entry.event);
    }
    return found;
  }
};

/// Hands every piece of motion to a function, and keeps the events.
template <class OnPiece>
class Recording final : public modes::MotionListener {
 public:
  explicit Recording(OnPiece on_piece) : on_piece_(on_piece) {}
  void piece(trajectory::MotionPiece& piece) override { on_piece_(piece); }
  void event(const modes::Event& event) override { events.push_back({revolution, event}); }
  int revolution = 0;
  std::vector<RecordedEvent> events;

 private:
  OnPiece on_piece_;
};

/// By collocation, or in steps.
template <class Law, class Forcing, class OnPiece>
RecordedMotion follow(const HardRotor& rotor, const rotor::BladeSet& blades, const Law& law,
                      const Forcing& forcing, const rotor::State& start, int revolutions, OnPiece on_piece,
                      bool collocates = true) {
  const auto motion =
      hybrid_motion(machine_of(rotor.constants(), blades, forcing), law, rotor.limits(), collocates);
  Recording<OnPiece> recording(on_piece);
  RecordedMotion result;
  result.status = test::start(*motion, start);
  for (; recording.revolution < revolutions && result.status == ending::PointStatus::done;
       ++recording.revolution) {
    result.status = revolve(*motion, recording);
    result.sections.push_back(rotor::shaft(motion->state()));
  }
  result.events = std::move(recording.events);
  result.work = motion->work();
  return result;
}

/// The same with equally spaced blades at constant speed.
template <class Law, class Forcing, class OnPiece>
RecordedMotion follow(const HardRotor& rotor, const Law& law, const Forcing& forcing,
                      const rotor::State& start, int revolutions, OnPiece on_piece, bool collocates = true) {
  return follow(rotor, rotor::BladeSet(rotor.blades, rotor.speed_ratio), law, forcing, start, revolutions,
                on_piece, collocates);
}

}  // namespace rubatlas::test
