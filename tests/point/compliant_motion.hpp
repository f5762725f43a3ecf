/// Motions of one law of elastic blades on the default rotor's shaft, and what is seen of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "assembly/blade_tables.hpp"
#include "contact/elastica_contact.hpp"

namespace rubatlas::test::compliant {

using blade::Theory;
using contact::ElasticaContact;
using contact::Ring;
inline constexpr Ring kReleasedAtFold{.releases_at_fold = true};

inline constexpr contact::Geometry kGeometry{0.1, 0.11};
inline constexpr double kLength = 0.1;
inline constexpr double kThickness = 1e-3;
inline constexpr double kBendingStiffness = 206e9 * 0.01 * 1e-9 / 12.0;

inline rotor::RotorConstants rotor_at(double speed_ratio) {
  return {speed_ratio, 0.1, 0.01001, 0.01, 0.01};
}

inline ElasticaContact make(double friction, double share, Theory theory = Theory::elastica,
                            const Ring& ring = {}) {
  static assembly::BladeTables tables;
  const double compliance = share * kThickness * kThickness / (12.0 * kLength * kLength);
  return {
      kGeometry, {kLength, kThickness, kBendingStiffness}, tables.curve(friction, theory, compliance), ring};
}

/// Keeps events, the force that ends each contact, and the ends of all pieces.
class Witness final : public modes::MotionListener {
 public:
  void piece(trajectory::MotionPiece& piece) override {
    forces_.assign(1000, 0.0);
    in_contact = std::max(in_contact, piece.contact_count());
    for (std::size_t i = 0; i < piece.contact_count(); ++i) {
      largest_force = std::max(largest_force, piece.normal_force(i, piece.end()));
      forces_[static_cast<std::size_t>(piece.blade(i))] = piece.normal_force(i, piece.end());
    }
    if (first_forces.empty() && piece.contact_count() > 0)
      first_forces.push_back(piece.normal_force(0, piece.begin()));
    const rotor::State begin = rotor::as_state(piece.state(piece.begin()));
    if (begin_known_) largest_jump = std::max(largest_jump, (begin - last_).abs().maxCoeff());
    last_ = rotor::as_state(piece.state(piece.end()));
    begin_known_ = true;
  }
  void event(const modes::Event& event) override {
    events.push_back(event);
    last_forces.push_back(forces_[static_cast<std::size_t>(event.blade)]);
  }
  std::vector<modes::Event> events;
  std::vector<double> last_forces;   ///< F at the end of the piece before each event [N]
  std::vector<double> first_forces;  ///< F where the first contact is first seen [N]
  double largest_force = 0.0;
  double largest_jump = 0.0;  ///< of a state's component from piece to piece
  std::size_t in_contact = 0;

 private:
  std::vector<double> forces_ = std::vector<double>(1000, 0.0);
  rotor::State last_ = rotor::State::Zero();
  bool begin_known_ = false;
};

template <class Law>
struct Run {
  ending::PointStatus status;
  rotor::State state;
  Witness witness;
};
template <class Law>
Run<Law> run(const Law& law, double speed_ratio, int revolutions, int blades = 3, double tolerance = 1e-12,
             const rotor::State& start = rotor::State::Zero()) {
  const auto motion = hybrid_motion(machine_of(rotor_at(speed_ratio), rotor::BladeSet(blades, speed_ratio)),
                                    law, {tolerance, 0.5}, true);
  Run<Law> result{};
  result.status = test::start(*motion, start);
  for (int i = 0; i < revolutions && result.status == ending::PointStatus::done; ++i)
    result.status = revolve(*motion, result.witness);
  result.state = rotor::shaft(motion->state());
  return result;
}

inline contact::Pose pose_at(double speed_ratio, int blades, const modes::Event& event, int blade) {
  const rotor::BladeSet set(blades, speed_ratio);
  return rotor::pose_of(rotor_at(speed_ratio), kGeometry, set.direction(blade, set.first(event.time)),
                        event.state);
}
inline contact::Pose pose_at(double speed_ratio, int blades, const modes::Event& event) {
  return pose_at(speed_ratio, blades, event, event.blade);
}

inline double difference(const rotor::State& one, const rotor::State& other) {
  return (one - other).abs().maxCoeff();
}

}  // namespace rubatlas::test::compliant
