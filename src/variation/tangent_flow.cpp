#include "variation/tangent_flow.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <utility>

#include "integrate/decompositions.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::variation {
namespace {

/// As many as nodes of a collocated contact: order 16, so that what is left is that of the path.
constexpr int kStages = 8;

/// Gauss's method: stages at the Gauss points, each with the integrals of the polynomial through all of them.
struct Gauss {
  Eigen::Matrix<double, kStages, 1> node;
  Eigen::Matrix<double, kStages, 1> weight;
  Eigen::Matrix<double, kStages, kStages> integral;  ///< [i][j]: of the polynomial of stage j up to node i
};
const Gauss& gauss() {
  static const Gauss kGauss = [] {
    Gauss result;
    using Rule = boost::math::quadrature::gauss<double, kStages>;
    constexpr int kHalf = kStages / 2;
    static_assert(kStages % 2 == 0);
    for (int i = 0; i < kHalf; ++i) {
      const auto place = static_cast<std::size_t>(i);
      result.node[kHalf + i] = 0.5 * (1.0 + Rule::abscissa()[place]);
      result.node[kHalf - 1 - i] = 0.5 * (1.0 - Rule::abscissa()[place]);
      result.weight[kHalf + i] = result.weight[kHalf - 1 - i] = 0.5 * Rule::weights()[place];
    }
    Eigen::Matrix<double, kStages, kStages> powers;
    Eigen::Matrix<double, kStages, kStages> integrals;
    for (int i = 0; i < kStages; ++i) {
      for (int k = 0; k < kStages; ++k) {
        powers(i, k) = std::pow(result.node[i], k);
        integrals(i, k) = std::pow(result.node[i], k + 1) / (k + 1);
      }
    }
    result.integral = integrate::solve(powers.transpose(), integrals.transpose()).transpose();
    return result;
  }();
  return kGauss;
}

/// The shaft as the ring sees it.
trajectory::State seen(const trajectory::PathPoint& at) {
  trajectory::State result = at.state;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] -= at.ring[i];
  return result;
}

}  // namespace

TangentFlow::TangentFlow(const settings::Scene& line) : line_(line), contact_(line) {}

void TangentFlow::begin(double speed_ratio) {
  if (!machine_ || machine_->constants.speed_ratio != speed_ratio) machine_ = machine_of(line_, speed_ratio);
  contact_.begin(*machine_);
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const rotor::RingBody* ring = machine_->ring_body();
  const Eigen::Index coordinates = ring != nullptr ? 4 : 2;
  stiffness_ = damping_ = OfBodies::Zero(coordinates, coordinates);
  by_force_ = OfBodies::Zero(coordinates, 2);
  seen_ = OfBodies::Zero(2, coordinates);
  const rotor::SupportMatrices shaft = machine_->support();
  stiffness_.topLeftCorner<2, 2>() = shaft.stiffness;
  damping_.topLeftCorner<2, 2>() = shaft.damping;
  by_force_.topRows<2>() = machine_->constants.force_unit * one;
  seen_.leftCols<2>() = one;
  if (ring != nullptr) {
    const double frequency = ring->frequency();
    stiffness_.bottomRightCorner<2, 2>() = frequency * frequency * one;
    damping_.bottomRightCorner<2, 2>() = 2.0 * ring->damping_ratio() * frequency * one;
    by_force_.bottomRows<2>() = -ring->force_unit() * one;
    seen_.rightCols<2>() = -one;
  }
  tangents_ = Tangents::Identity(2 * coordinates, 2 * coordinates);
  longest_flight_.reset();
  events_.clear();
  force_.setZero();
  point_.contacts.clear();
  known_ = true;
  log_volume_ = 0.0;
}

void TangentFlow::piece(trajectory::MotionPiece& piece, const std::function<void()>& between) {
  if (!known_) return;
  if (!events_.empty()) jump(piece, force_in(piece, piece.begin()));
  if (piece.contact_count() == 0) {
    constexpr double kMostParts = 1e5;  // some 0.1 s
    double left = piece.end() - piece.begin();
    if (between && !longest_flight_) longest_flight_ = longest_flight();
    if (between && left > kMostParts * *longest_flight_) return loses_track();
    for (; between && left > *longest_flight_; left -= *longest_flight_) {
      tangents_ = after_flight(*longest_flight_);
      between();
    }
    tangents_ = after_flight(left);
    point_.contacts.clear();
    force_.setZero();
  } else {
    machine_->ring_body() != nullptr ? follow<4>(piece) : follow<2>(piece);
  }
}

Eigen::Vector2d TangentFlow::force_in(trajectory::MotionPiece& piece, double time) {
  std::complex<double> sum;
  for (std::size_t contact = 0; contact < piece.contact_count(); ++contact)
    sum += piece.contact_force(contact, time).on_rotor;
  return {sum.real(), sum.imag()};
}

double TangentFlow::longest_flight() const {
  // Parts of free motion decay as e^{-rate τ}, or grow.
  constexpr double kMostDecay = 20.0;  // leaves half of the digits of a double
  Tangents system = Tangents::Zero(tangents_.rows(), tangents_.rows());
  const Eigen::Index coordinates = stiffness_.rows();
  system.topRightCorner(coordinates, coordinates).setIdentity();
  system.bottomLeftCorner(coordinates, coordinates) = -stiffness_;
  system.bottomRightCorner(coordinates, coordinates) = -damping_;
  const Eigen::VectorXd growths = integrate::eigen_modes(system).values.real();
  return kMostDecay / (std::max(growths.maxCoeff(), 0.0) - std::min(growths.minCoeff(), 0.0));
}

Tangents TangentFlow::after_flight(double duration) const {
  Tangents tangents = tangents_;
  const Eigen::Index velocities = tangents.rows() / 2;
  // The body whose coordinates begin there.
  const auto move = [&](Eigen::Index first, const auto& moved) {
    for (auto tangent : tangents.colwise()) {
      Eigen::Vector4d body;
      body << tangent.segment<2>(first), tangent.segment<2>(velocities + first);
      body = moved(body);
      tangent.segment<2>(first) = body.head<2>();
      tangent.segment<2>(velocities + first) = body.tail<2>();
    }
  };
  const auto swing = [&](Eigen::Index first, const rotor::FreeMotion& free) {
    const auto over = free.kernel(free.frequency() * duration);
    move(first, [&](const Eigen::Vector4d& body) { return free.moved(body, over); });
  };
  if (const rotor::SupportedShaft* supported = machine_->supported())
    move(0, [&](const Eigen::Vector4d& body) { return supported->support.free(body, duration); });
  else
    swing(0, rotor::FreeMotion(machine_->constants.damping_ratio));
  if (const rotor::RingBody* ring = machine_->ring_body()) swing(2, *ring);
  return tangents;
}

Eigen::Vector2d TangentFlow::seen_acceleration(const trajectory::PathPoint& at,
                                               const Eigen::Vector2d& force) const {
  rotor::ContactState state;
  state << rotor::as_state(at.state), at.time, 0.0, rotor::as_state(at.ring);
  const auto [shaft, ring] = machine_->acceleration(state, {force[0], force[1]});
  return {shaft.real() - ring.real(), shaft.imag() - ring.imag()};
}

std::array<double, 4> TangentFlow::rate(double time, const trajectory::State& state,
                                        const Eigen::Vector2d& force) const {
  const std::complex<double> acceleration =
      machine_->shaft.acceleration(machine_->constants, time, rotor::as_state(state), {force[0], force[1]});
  return {state[2], state[3], acceleration.real(), acceleration.imag()};
}

template <int kCoordinates>
void TangentFlow::follow(trajectory::MotionPiece& piece) {
  const Gauss& method = gauss();
  struct Stage {
    trajectory::PathPoint point;
    Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();  ///< where it is needed
  };
  std::array<Stage, kStages> stages;
  std::vector<trajectory::ContactForce> forces;
  PathScale scale{0.0, 0.0};
  Eigen::Matrix<double, kStages, 1> time_rate;
  for (int i = 0; i < kStages; ++i) {
    auto& [point, acceleration] = stages[static_cast<std::size_t>(i)];
    piece.path(method.node[i], point, contact_.needs_acceleration() ? &forces : nullptr);
    if (point.contacts.empty()) return loses_track();
    std::complex<double> sum;
    for (const trajectory::ContactForce& force : forces) sum += force.on_rotor;
    if (contact_.needs_acceleration()) acceleration = seen_acceleration(point, {sum.real(), sum.imag()});
    point.state = seen(point);
    time_rate[i] = point.time_rate;
    for (const auto& contact : point.contacts) {
      for (const double rate : {contact.bending_rate, contact.modulus_rate, contact.amplitude_rate})
        scale.bending_rate = std::max(scale.bending_rate, std::abs(rate));
    }
  }
  scale.time_rate = time_rate.cwiseAbs().maxCoeff();
  if (scale.bending_rate == 0.0) scale.bending_rate = 1.0;

  // Velocities W and places Q at the stages follow from the accelerations there, so that these alone are
  // unknown: W = w0 + A a, Q = q0 + A τ_θ W, A the integrals.
  using Stages = Eigen::Matrix<double, kStages, kStages>;
  const Stages of_place = method.integral * time_rate.asDiagonal();
  const Stages of_acceleration = of_place * method.integral;
  const Eigen::Matrix<double, kStages, 1> elapsed = of_place.rowwise().sum();
  constexpr Eigen::Index kColumns = Eigen::Index{2} * kCoordinates;
  constexpr Eigen::Index kUnknowns = Eigen::Index{kStages} * kCoordinates;
  using Rows = Eigen::Matrix<double, kCoordinates, kColumns>;
  using Square = Eigen::Matrix<double, kCoordinates, kCoordinates>;
  const Rows place = tangents_.topRows<kCoordinates>();
  const Rows velocity = tangents_.bottomRows<kCoordinates>();
  const Square restoring = stiffness_;
  const Square damping = damping_;
  const Eigen::Matrix<double, kCoordinates, 2> by_force = by_force_;
  const Eigen::Matrix<double, 2, kCoordinates> seen_from_ring = seen_;

  Eigen::Matrix<double, kUnknowns, kUnknowns> matrix =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity();
  Eigen::Matrix<double, kUnknowns, kColumns> right;
  for (Eigen::Index i = 0; i < kStages; ++i) {
    const auto& [point, shaft_acceleration] = stages[static_cast<std::size_t>(i)];
    const std::optional<ForceSlopes> of_force = contact_.along_path(point, scale, shaft_acceleration);
    if (!of_force || !of_force->allFinite()) return loses_track();
    const Square by_velocity = by_force * of_force->rightCols<2>() * seen_from_ring;
    const Square stiffness = by_force * of_force->leftCols<2>() * seen_from_ring - time_rate[i] * restoring;
    const Square resistance = time_rate[i] * damping - by_velocity;
    log_volume_ += method.weight[i] * by_velocity.trace();
    for (Eigen::Index j = 0; j < kStages; ++j) {
      matrix.template block<kCoordinates, kCoordinates>(kCoordinates * i, kCoordinates * j) -=
          of_acceleration(i, j) * stiffness - method.integral(i, j) * resistance;
    }
    right.template middleRows<kCoordinates>(kCoordinates * i) =
        stiffness * (place + elapsed[i] * velocity) - resistance * velocity;
  }
  const Eigen::Matrix<double, kUnknowns, kColumns> acceleration = integrate::solve(matrix, right);
  const auto at_stage = [&](Eigen::Index i) {
    return acceleration.template middleRows<kCoordinates>(kCoordinates * i);
  };
  for (Eigen::Index i = 0; i < kStages; ++i) {
    Rows there = velocity;
    for (Eigen::Index j = 0; j < kStages; ++j) there += method.integral(i, j) * at_stage(j);
    tangents_.topRows<kCoordinates>() += (method.weight[i] * time_rate[i]) * there;
    tangents_.bottomRows<kCoordinates>() += method.weight[i] * at_stage(i);
  }

  force_ = force_in(piece, piece.end());
  piece.path(1.0, point_, nullptr);
}

void TangentFlow::jump(trajectory::MotionPiece& piece, const Eigen::Vector2d& force) {
  const auto change = (by_force_ * (force - force_)).eval();
  const std::vector<Event> events = std::exchange(events_, {});
  if (change.isZero(0.0)) return;
  if (events.size() > 1) return loses_track();
  const auto [blade, of_slip] = events.front();
  trajectory::PathPoint at = point_;  // the end of the contact, where flight follows
  if (piece.contact_count() > 0) {
    piece.path(0.0, at, nullptr);
    if (at.contacts.empty()) return loses_track();
  }
  ContactStiffness::Guard guard;
  if (of_slip) {
    const auto contact = std::ranges::find(point_.contacts, blade, &trajectory::PathPoint::Contact::blade);
    if (contact == point_.contacts.end()) return loses_track();
    const auto slip = contact_.slip(*contact, piece.begin(), seen(at), seen_acceleration(at, force_));
    if (!slip) return loses_track();
    guard = *slip;
  } else {
    guard = contact_.gap(blade, piece.begin(), seen(at));
  }
  Eigen::RowVectorXd change_of_time(tangents_.rows());
  change_of_time << guard.gradient.head<2>() * seen_, guard.gradient.tail<2>() * seen_;
  change_of_time /= guard.rate;
  const Eigen::Index velocities = tangents_.rows() / 2;
  tangents_.bottomRows(velocities) += change * (change_of_time * tangents_).eval();
  // det(I + (0, Δa) ∇eᵀ/ė) = 1 + ∇eᵀ (0, Δa) / ė.
  log_volume_ += std::log(std::abs(1.0 + change_of_time.tail(velocities).dot(change)));
}

}  // namespace rubatlas::variation
