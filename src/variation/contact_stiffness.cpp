#include "variation/contact_stiffness.hpp"

#include <cmath>
#include <utility>

#include "settings/effects/list.hpp"
#include "variation/blades_of_scene.hpp"
#include "variation/directed_stiffness.hpp"
#include "variation/friction_of_scene.hpp"

namespace rubatlas::variation {
namespace {

using Contact = trajectory::PathPoint::Contact;
using trajectory::State;

Eigen::Vector2d turned_by_quarter(const Eigen::Vector2d& vector) {
  return {-vector[1], vector[0]};
}
Eigen::Vector2d of_blade(const contact::BladeDirection& er, double along, double across) {
  return {along * er.cosine - across * er.sine, along * er.sine + across * er.cosine};
}
/// I + sμJ.
Eigen::Matrix2d turned_by_friction(double friction) {
  return (Eigen::Matrix2d() << 1.0, -friction, friction, 1.0).finished();
}

/// A table takes longer than a short motion, and lines that are computed one after the other mostly share it.
std::shared_ptr<const blade::ElasticaCurve> curve_of(double friction, blade::Theory theory) {
  thread_local std::shared_ptr<const blade::ElasticaCurve> last;
  if (!last || last->friction() != friction || last->theory() != theory)
    last = std::make_shared<const blade::ElasticaCurve>(friction, theory);
  return last;
}

}  // namespace

ContactStiffness::Law ContactStiffness::law_of(const settings::Scene& line) {
  const contact::Geometry geometry = geometry_of(line.ring, line.blades);
  const contact::Friction friction = friction_of(line);
  if (line.contact.law == settings::ContactLaw::elastic_ring)
    return RigidBlade{line.ring.stiffness, friction};
  if (friction.depends_on_velocity())
    return DirectedBlade(contact::LoadDirection::axial, geometry, blade_of(line.blades), friction);
  const auto theory = line.contact.law == settings::ContactLaw::beam_column ? blade::Theory::beam_column
                                                                            : blade::Theory::elastica;
  return contact::ElasticaContact(geometry, blade_of(line.blades), curve_of(line.contact.friction, theory));
}

ContactStiffness::ContactStiffness(const settings::Scene& line)
    : geometry_(geometry_of(line.ring, line.blades)), law_(law_of(line)), blades_(line.blades.count, 0.0) {}

void ContactStiffness::begin(const rotor::RotorConstants& rotor) {
  rotor_ = rotor;
  blades_ = rotor::BladeSet(blades_.count(), rotor.speed_ratio);
}

contact::BladeDirection ContactStiffness::direction(int blade, double time) const {
  return blades_.direction(blade, blades_.first(time));
}

std::optional<ContactStiffness::TipInContact> ContactStiffness::tip(const Contact& contact, double time,
                                                                    const State& state) const {
  TipInContact result;
  const contact::BladeDirection er = direction(contact.blade, time);
  result.centre = {state[0], state[1] + rotor_.misalignment};
  if (std::holds_alternative<RigidBlade>(law_)) {
    result.tip = result.centre + of_blade(er, geometry_.reach, 0.0);
    result.tip_by_u.setZero();
    return result;
  }
  const auto& elastica = std::get<contact::ElasticaContact>(law_);
  double bending = contact.bending;
  if (!contact.carried) {
    const contact::Pose pose = rotor::pose_of(rotor_, geometry_, er, rotor::as_state(state));
    const auto root = elastica.solve_near(pose, contact.slip, bending);
    if (!root) return std::nullopt;
    bending = *root;
  }
  const blade::CurvePoint point = elastica.curve().at(bending);
  const double length = elastica.length();
  result.tip = result.centre + of_blade(er, geometry_.reach - length * point.shortening,
                                        -contact.slip * length * point.deflection);
  result.tip_by_u =
      of_blade(er, -length * point.shortening_slope, -contact.slip * length * point.deflection_slope);
  result.load = elastica.load_unit() * point.load;
  result.load_by_u = elastica.load_unit() * point.load_slope;
  result.closing_by_u = 2.0 * result.tip.dot(result.tip_by_u);
  result.friction = contact.slip * elastica.curve().friction();
  return result;
}

ForceSlopes ContactStiffness::of_rigid_blade(const RigidBlade& law, const Contact& contact, double time,
                                             const State& state) const {
  const Eigen::Vector2d to_tip = of_blade(direction(contact.blade, time), geometry_.reach, 0.0);
  const Eigen::Vector2d w = Eigen::Vector2d(state[0], state[1] + rotor_.misalignment) + to_tip;
  const Eigen::Vector2d velocity(state[2], state[3]);
  const double distance = w.norm();
  const Eigen::Vector2d normal = w / distance;
  const Eigen::Vector2d tangent = turned_by_quarter(normal);
  const Eigen::Matrix2d along = normal * normal.transpose();
  const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - along;
  const double load = law.stiffness * (distance - geometry_.ring_radius);
  // v = c'·Jn + Ω (w − c)·n (MODEL 4.4), n the normal.
  const double slip_velocity = velocity.dot(tangent) + rotor_.speed_ratio * to_tip.dot(normal);
  const double coefficient = law.friction.coefficient(slip_velocity, contact.slip);
  const double slope = law.friction.slope(slip_velocity);
  const Eigen::RowVector2d velocity_by_place =
      (rotor_.speed_ratio * to_tip - turned_by_quarter(velocity)).transpose() * across / distance;
  ForceSlopes slopes;
  slopes.by_place = -turned_by_friction(coefficient) * (law.stiffness * along + load / distance * across) -
                    load * slope * tangent * velocity_by_place;
  slopes.by_velocity = -load * slope * tangent * tangent.transpose();
  return slopes;
}

std::optional<ForceSlopes> ContactStiffness::along_path(const trajectory::PathPoint& point,
                                                        const PathScale& scale,
                                                        const Eigen::Vector2d& acceleration) const {
  ForceSlopes sum;
  for (const Contact& contact : point.contacts) {
    if (const auto* rigid = std::get_if<RigidBlade>(&law_)) {
      const ForceSlopes slopes = of_rigid_blade(*rigid, contact, point.time, point.state);
      sum += {point.time_rate * slopes.by_place, point.time_rate * slopes.by_velocity};
      continue;
    }
    if (const auto* directed = std::get_if<DirectedBlade>(&law_)) {
      const contact::BladeDirection er = direction(contact.blade, point.time);
      const DirectedContact at{er,
                               rotor::pose_of(rotor_, geometry_, er, rotor::as_state(point.state)),
                               rotor_.speed_ratio,
                               acceleration,
                               point.time_rate,
                               &contact};
      sum += slopes_of_directed_blade(*directed, at, scale);
      continue;
    }
    const auto there = tip(contact, point.time, point.state);
    if (!there) return std::nullopt;
    const Eigen::Vector2d& w = there->tip;
    const double distance = w.norm();
    const Eigen::Matrix2d turning = turned_by_friction(there->friction);
    const Eigen::Vector2d velocity(point.state[2], point.state[3]);
    // At fixed bending the tip moves with the shaft and turns about it.
    const Eigen::Vector2d moves = velocity + rotor_.speed_ratio * turned_by_quarter(w - there->centre);
    const double closing_rate = 2.0 * w.dot(moves);
    double share = point.time_rate / there->closing_by_u;
    if (contact.carried) {
      const double by_time = there->closing_by_u / (scale.time_rate * scale.time_rate);
      const double by_bending = closing_rate / (scale.bending_rate * scale.bending_rate);
      share = (point.time_rate * by_time - contact.bending_rate * by_bending) /
              (there->closing_by_u * by_time + closing_rate * by_bending);
    }
    const Eigen::Vector2d force_by_u =
        -(turning * (there->load_by_u * w + there->load * there->tip_by_u)) / distance;
    sum.by_place -=
        (point.time_rate * there->load / distance) * turning + (2.0 * share) * force_by_u * w.transpose();
  }
  return sum;
}

ContactStiffness::Guard ContactStiffness::gap(int blade, double time, const State& state) const {
  const contact::BladeDirection er = direction(blade, time);
  const contact::Pose pose = rotor::pose_of(rotor_, geometry_, er, rotor::as_state(state));
  const Eigen::Vector2d tip =
      Eigen::Vector2d(state[0], state[1] + rotor_.misalignment) + of_blade(er, geometry_.reach, 0.0);
  Guard guard;
  guard.gradient << 2.0 * tip.transpose(), 0.0, 0.0;
  guard.rate = contact::gap_rate(geometry_, pose, rotor_.speed_ratio);
  return guard;
}

std::optional<ContactStiffness::Guard> ContactStiffness::slip(const Contact& contact, double time,
                                                              const State& state,
                                                              const Eigen::Vector2d& acceleration) const {
  // e = c'·Jw + Ω (w − c)·w, which is v |w| (MODEL 4.4).
  const auto there = tip(contact, time, state);
  if (!there) return std::nullopt;
  const double speed = rotor_.speed_ratio;
  const Eigen::Vector2d& w = there->tip;
  const Eigen::Vector2d& c = there->centre;
  const Eigen::Vector2d velocity(state[2], state[3]);
  const auto by_tip = [&](const Eigen::Vector2d& change) {
    return velocity.dot(turned_by_quarter(change)) + speed * (2.0 * w - c).dot(change);
  };
  const Eigen::Vector2d turns = speed * turned_by_quarter(w - c);  // of the tip at fixed c and u
  Eigen::Vector2d by_place = -turned_by_quarter(velocity) + speed * (w - c);
  double by_time = by_tip(turns);
  if (there->closing_by_u != 0.0) {
    const double by_closing = by_tip(there->tip_by_u) / there->closing_by_u;
    by_place -= (2.0 * by_closing) * w;
    by_time -= (2.0 * by_closing) * w.dot(turns);
  }
  const Eigen::Vector2d by_velocity = turned_by_quarter(w);
  Guard guard;
  guard.gradient << by_place.transpose(), by_velocity.transpose();
  guard.rate = by_place.dot(velocity) + by_velocity.dot(acceleration) + by_time;
  return guard;
}

}  // namespace rubatlas::variation
