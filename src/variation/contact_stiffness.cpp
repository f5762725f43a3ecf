#include "variation/contact_stiffness.hpp"

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <unsupported/Eigen/AutoDiff>

#include "blade/inclined_elastica.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::variation {
namespace {

using Contact = trajectory::PathPoint::Contact;
using trajectory::State;

constexpr int kMostUnknowns = 2;  ///< u, or κ and φ; fewer are filled up
/// Slopes by c, c', the time in which blades turn, and the bend.
constexpr int kPlace = 0;
constexpr int kVelocity = 2;
constexpr int kTime = 4;
constexpr int kBend = 5;
constexpr int kSlopes = kBend + kMostUnknowns;
using Slopes = Eigen::Matrix<double, kSlopes, 1>;
using Number = Eigen::AutoDiffScalar<Slopes>;

/// A function of one number whose value and slope are known.
Number of(double value, double slope, const Number& argument) {
  return {value, slope * argument.derivatives()};
}
Number variable(double value, int column) {
  return {value, Slopes::Unit(column)};
}
/// Slopes along a motion.
double rate(const Slopes& slopes, const State& state, const Eigen::Vector2d& acceleration) {
  return slopes[kTime] + slopes.segment<2>(kPlace).dot(Eigen::Vector2d(state[2], state[3])) +
         slopes.segment<2>(kVelocity).dot(acceleration);
}

using Vector = contact::BladeVector<Number>;

/// A table takes longer than a short motion, and lines that are computed one after the other mostly share it.
std::shared_ptr<const blade::ElasticaCurve> curve_of(double friction, blade::Theory theory) {
  thread_local std::shared_ptr<const blade::ElasticaCurve> last;
  if (!last || last->friction() != friction || last->theory() != theory)
    last = std::make_shared<const blade::ElasticaCurve>(friction, theory);
  return last;
}

}  // namespace

/// A tip in contact.
struct ContactStiffness::Tip {
  Number force_x, force_y;  ///< f [N]
  Number slip;              ///< v |w| [m² per unit τ]
  /// Slopes of h [m²] and of the direction of the load [rad]; of what a blade has not, an unknown stays zero.
  Eigen::Matrix<double, kMostUnknowns, kSlopes> constraints =
      Eigen::Matrix<double, kSlopes, kSlopes>::Identity().bottomRows<kMostUnknowns>();

  /// D.
  [[nodiscard]] Eigen::Matrix2d by_bend() const { return constraints.rightCols<kMostUnknowns>(); }
  /// adj D.
  [[nodiscard]] Eigen::Matrix2d adjugate() const {
    const Eigen::Matrix2d slopes = by_bend();
    return (Eigen::Matrix2d() << slopes(1, 1), -slopes(0, 1), -slopes(1, 0), slopes(0, 0)).finished();
  }
  /// Slopes by c and c', `share` of the time in them, where the bend changes by −`lambda` (adj D) g.
  [[nodiscard]] Eigen::RowVector4d by_state(const Number& of, double share, double lambda) const {
    const Eigen::RowVector2d by_constraint =
        lambda * of.derivatives().tail<kMostUnknowns>().transpose() * adjugate();
    Eigen::RowVector4d result = share * of.derivatives().head<4>().transpose();
    for (int i = 0; i < kMostUnknowns; ++i) result -= by_constraint[i] * constraints.row(i).head<4>();
    return result;
  }
  /// (adj D) g_τ.
  [[nodiscard]] Eigen::Vector2d drift(const State& state, const Eigen::Vector2d& acceleration) const {
    return adjugate() * Eigen::Vector2d(rate(constraints.row(0), state, acceleration),
                                        rate(constraints.row(1), state, acceleration));
  }
};

ContactStiffness::ContactStiffness(const settings::Scene& line) : friction_(friction_of(line)) {
  if (line.contact.law == settings::ContactLaw::elastic_ring)
    ring_stiffness_ = line.ring.stiffness;
  else if (friction_.has_slip_state())
    curve_ = curve_of(line.contact.friction, theory_of(line));
  for (const settings::Blades& blade : each_blade(line))
    in_ring_.emplace_back(geometry_of(line.ring, blade), blade_of(blade));
}

void ContactStiffness::begin(const rotor::Machine& machine) {
  rotor_ = machine.constants;
  blades_ = machine.blades;
}

std::optional<ContactStiffness::Tip> ContactStiffness::tip(const Contact& contact, double time,
                                                           const State& state) const {
  const contact::ElasticBladeInRing& law = of_blade(contact.blade);
  const contact::Geometry& geometry = law.geometry();
  const contact::BladeDirection direction = blades_.direction(contact.blade, blades_.first(time));
  const Number turned(0.0, rotor_.speed_ratio * Slopes::Unit(kTime));
  const Number er_x = of(direction.cosine, -direction.sine, turned);
  const Number er_y = of(direction.sine, direction.cosine, turned);
  const contact::PoseOf<Number> at = contact::pose<Number>(
      geometry, er_x, er_y, variable(state[0], kPlace), variable(state[1] + rotor_.misalignment, kPlace + 1),
      variable(state[2], kVelocity), variable(state[3], kVelocity + 1));

  Tip tip;
  Vector bent{Number(0.0), Number(0.0)};
  Number load(0.0), load_angle(0.0);
  if (curve_) {
    double bending = contact.bending;
    if (!contact.carried) {
      const contact::Pose pose = rotor::pose_of(rotor_, geometry, direction, rotor::as_state(state));
      const contact::ElasticaContact elastic(geometry, law.blade(), curve_);
      const auto root = elastic.solve_near(pose, contact.slip, bending);
      if (!root) return std::nullopt;
      bending = *root;
    }
    const blade::CurvePoint point = curve_->at(bending);
    const Number u = variable(bending, kBend);
    bent.along = law.length() * of(point.shortening, point.shortening_slope, u);
    bent.across = contact.slip * law.length() * of(point.deflection, point.deflection_slope, u);
    load = law.load_unit() * of(point.load, point.load_slope, u);
  } else if (!is_rigid()) {
    const blade::InclinedPoint point = blade::inclined_equilibrium({contact.modulus, contact.amplitude});
    const auto of_bend = [](const auto& quantity) {
      Slopes slopes = Slopes::Zero();
      slopes.segment<2>(kBend) << quantity.by_modulus, quantity.by_amplitude;
      return Number(quantity.value, slopes);
    };
    bent.along = law.length() * of_bend(point.shortening);
    bent.across = law.length() * of_bend(point.deflection);
    load = law.load_unit() * of_bend(point.load);
    load_angle = of_bend(point.load_angle);
  }
  const Vector unbent = contact::unbent_tip(geometry, at);
  const Vector place = unbent - bent;
  const Number distance = sqrt(contact::dot(place, place));
  const Number speed(rotor_.speed_ratio);
  const Number slip_velocity =
      contact::slip_velocity(place, contact::tip_rate(at, speed), speed, Number(1.0 / distance), distance);
  tip.slip = slip_velocity * distance;

  const auto [coefficient, by_velocity] = friction_.at(slip_velocity.value(), contact.slip);
  const Number friction = of(coefficient, by_velocity, slip_velocity);
  if (is_rigid()) {
    load = ring_stiffness_ * (distance - geometry.ring_radius);
  } else {
    tip.constraints.row(0) = contact::contact_equation(at.gap, unbent, bent).derivatives();
  }
  if (needs_acceleration()) {
    const Number secant_square = friction * friction + 1.0;
    const Number angle = of(std::atan(friction.value()), 1.0 / secant_square.value(), friction);
    tip.constraints.row(1) = (load_angle - angle).derivatives();
    load = load / sqrt(secant_square);
  }
  const Vector push = contact::push_direction(place, friction) * Number(load / distance);
  tip.force_x = push.along * er_x - push.across * er_y;
  tip.force_y = push.along * er_y + push.across * er_x;
  return tip;
}

std::optional<ForceSlopes> ContactStiffness::along_path(const trajectory::PathPoint& point,
                                                        const PathScale& scale,
                                                        const Eigen::Vector2d& acceleration) const {
  ForceSlopes sum = ForceSlopes::Zero();
  for (const Contact& contact : point.contacts) {
    const auto there = tip(contact, point.time, point.state);
    if (!there) return std::nullopt;
    const double determinant = there->by_bend().determinant();
    double lambda = point.time_rate / determinant;
    if (contact.carried) {
      const Eigen::Vector2d drift = there->drift(point.state, acceleration);
      const Eigen::Vector2d rates = needs_acceleration()
                                        ? Eigen::Vector2d(contact.modulus_rate, contact.amplitude_rate)
                                        : Eigen::Vector2d(contact.bending_rate, 0.0);
      const double by_time = determinant / (scale.time_rate * scale.time_rate);
      const Eigen::Vector2d by_bend = drift / (scale.bending_rate * scale.bending_rate);
      lambda =
          (point.time_rate * by_time - rates.dot(by_bend)) / (determinant * by_time + drift.dot(by_bend));
    }
    sum.row(0) += there->by_state(there->force_x, point.time_rate, lambda);
    sum.row(1) += there->by_state(there->force_y, point.time_rate, lambda);
  }
  return sum;
}

ContactStiffness::Guard ContactStiffness::gap(int blade, double time, const State& state) const {
  const contact::Geometry& geometry = of_blade(blade).geometry();
  const contact::BladeDirection er = blades_.direction(blade, blades_.first(time));
  const contact::Pose pose = rotor::pose_of(rotor_, geometry, er, rotor::as_state(state));
  Guard guard;
  guard.gradient << 2.0 * (state[0] + geometry.reach * er.cosine),
      2.0 * (state[1] + rotor_.misalignment + geometry.reach * er.sine), 0.0, 0.0;
  guard.rate = contact::gap_rate(geometry, pose, rotor_.speed_ratio);
  return guard;
}

std::optional<ContactStiffness::Guard> ContactStiffness::slip(const Contact& contact, double time,
                                                              const State& state,
                                                              const Eigen::Vector2d& acceleration) const {
  const auto there = tip(contact, time, state);
  if (!there) return std::nullopt;
  const double lambda = 1.0 / there->by_bend().determinant();
  const Slopes& slopes = there->slip.derivatives();
  Guard guard;
  guard.gradient = there->by_state(there->slip, 1.0, lambda);
  guard.rate = rate(slopes, state, acceleration) -
               lambda * slopes.segment<kMostUnknowns>(kBend).dot(there->drift(state, acceleration));
  return guard;
}

}  // namespace rubatlas::variation
