#include "variation/tangent_flow.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <span>
#include <utility>

#include "integrate/decompositions.hpp"
#include "settings/effects/list.hpp"
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

/// A matrix of the shaft, and behind it where there is a ring that is a body a number times the unit matrix.
template <int kCoordinates>
Eigen::Matrix<double, kCoordinates, kCoordinates> of_bodies(const Eigen::Matrix2d& of_shaft, double of_ring) {
  Eigen::Matrix<double, kCoordinates, kCoordinates> result =
      of_ring * Eigen::Matrix<double, kCoordinates, kCoordinates>::Identity();
  result.template topLeftCorner<2, 2>() = of_shaft;
  return result;
}

/// Rates at which free motion with these coefficients decays: real parts of the roots of s² + c s + k.
std::array<double, 2> decays(double damping, double stiffness) {
  const double half = 0.5 * damping;
  const double spread = std::sqrt(std::max(0.0, half * half - stiffness));
  return {half - spread, half + spread};
}

}  // namespace

TangentFlow::TangentFlow(const settings::Scene& line)
    : line_(line),
      force_unit_(1.0 / (line.rotor.mass * line.rotor.natural_frequency * line.rotor.natural_frequency)),
      free_(line.rotor.damping_ratio),
      contact_(line) {
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  by_force_ = force_unit_ * one;
  seen_ = one;
  if (effects::acts<&effects::Effects::ring_body>(line)) {
    ring_.emplace(line.ring_body->mass, 1.0 / line.ring_body->compliance, line.ring_body->damping,
                  line.rotor.natural_frequency);
    by_force_ = (Eigen::Matrix<double, 4, 2>() << by_force_, -ring_->force_unit() * one).finished();
    seen_ = (Eigen::Matrix<double, 2, 4>() << one, -one).finished();
  }
}

Eigen::Vector2d TangentFlow::forcing(double time) const {
  using effects::Effects;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const auto add_static = [&](const auto& load) {
    const std::complex<double> deflection =
        load->deflection(1.0 / force_unit_, line_.rotor.natural_frequency);
    sum += Eigen::Vector2d(deflection.real(), deflection.imag());
  };
  if (effects::acts<&Effects::gravity>(line_)) add_static(line_.gravity);
  if (effects::acts<&Effects::side_load>(line_)) add_static(line_.side_load);
  if (effects::acts<&Effects::unbalance>(line_)) {
    const double angle = speed_ratio_ * time + line_.unbalance->phase;
    const double amplitude = line_.unbalance->moment / line_.rotor.mass * speed_ratio_ * speed_ratio_;
    sum += amplitude * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return sum;
}

void TangentFlow::begin(double speed_ratio) {
  contact_.begin({speed_ratio, free_.damping_ratio(), line_.rotor.misalignment, force_unit_, 1.0});
  speed_ratio_ = speed_ratio;
  shaft_ = rotor::isotropic_shaft(free_.damping_ratio());
  if (effects::acts<&effects::Effects::support>(line_)) {
    shaft_ = support_of(line_, speed_ratio);
    support_.emplace(shaft_.stiffness, shaft_.damping, std::span<const rotor::HarmonicForcing>());
  }
  const Eigen::Index size = ring_ ? 8 : 4;
  tangents_ = Tangents::Identity(size, size);
  events_.clear();
  force_.setZero();
  point_.contacts.clear();
  known_ = true;
  log_volume_ = 0.0;
}

double TangentFlow::phase_volume_rate() const {
  return (ring_ ? ring_->phase_volume_rate() : 0.0) - shaft_.damping.trace();
}

void TangentFlow::piece(trajectory::MotionPiece& piece, const std::function<void()>& between) {
  if (!known_) return;
  if (!events_.empty()) jump(piece, force_in(piece, piece.begin()));
  if (piece.contact_count() == 0) {
    constexpr double kMostParts = 1e5;  // some 0.1 s
    double left = piece.end() - piece.begin();
    const double longest = longest_flight();
    if (between && left > kMostParts * longest) return loses_track();
    for (; between && left > longest; left -= longest) {
      tangents_ = after_flight(longest);
      between();
    }
    tangents_ = after_flight(left);
    point_.contacts.clear();
    force_.setZero();
  } else {
    ring_ ? follow<4>(piece) : follow<2>(piece);
  }
}

Eigen::Vector2d TangentFlow::force_in(trajectory::MotionPiece& piece, double time) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
    const std::complex<double> force = piece.contact_force(contact, time).on_rotor;
    sum += Eigen::Vector2d(force.real(), force.imag());
  }
  return sum;
}

double TangentFlow::longest_flight() const {
  // Parts of free motion decay as e^{-rate τ}, or grow.
  constexpr double kMostDecay = 20.0;  // leaves half of the digits of a double
  double slowest = 0.0;
  double fastest = 0.0;
  const auto take = [&](double rate) {
    slowest = std::min(slowest, rate);
    fastest = std::max(fastest, rate);
  };
  if (support_) {
    for (const std::complex<double>& root : integrate::eigen_modes(support_->system_matrix()).values)
      take(-root.real());
  } else {
    for (const double rate : decays(2.0 * free_.damping_ratio(), 1.0)) take(rate);
  }
  if (ring_) {
    const double frequency = ring_->frequency();
    for (const double rate : decays(2.0 * ring_->damping_ratio() * frequency, frequency * frequency))
      take(rate);
  }
  return kMostDecay / (fastest - slowest);
}

Tangents TangentFlow::after_flight(double duration) const {
  Tangents tangents = tangents_;
  const Eigen::Index velocities = tangents.rows() / 2;
  const auto move_body = [&](Eigen::Index first, const auto& moved) {
    for (auto tangent : tangents.colwise()) {
      Eigen::Vector4d body;
      body << tangent.segment<2>(first), tangent.segment<2>(velocities + first);
      body = moved(body);
      tangent.segment<2>(first) = body.head<2>();
      tangent.segment<2>(velocities + first) = body.tail<2>();
    }
  };
  if (support_) {
    move_body(0, [&](const Eigen::Vector4d& shaft) { return support_->state(0.0, shaft, duration); });
  } else {
    const auto [cosine, sine] = free_.kernel(duration);
    const double damping = free_.damping_ratio();
    const auto place = tangents.topRows<2>().eval();
    const auto velocity = tangents.middleRows<2>(velocities).eval();
    tangents.topRows<2>() = cosine * place + sine * (velocity + damping * place);
    tangents.middleRows<2>(velocities) = cosine * velocity - sine * (place + damping * velocity);
  }
  if (ring_)
    move_body(2, [&](const Eigen::Vector4d& ring) { return ring_->free(ring, duration).matrix().eval(); });
  return tangents;
}

Eigen::Vector2d TangentFlow::seen_acceleration(const trajectory::PathPoint& at,
                                               const Eigen::Vector2d& force) const {
  const Eigen::Vector2d place(at.state[0], at.state[1]);
  const Eigen::Vector2d velocity(at.state[2], at.state[3]);
  Eigen::Vector2d result =
      force_unit_ * force + forcing(at.time) - shaft_.damping * velocity - shaft_.stiffness * place;
  if (ring_) {
    const rotor::RingBody::State ring(at.ring.data());
    const std::complex<double> moves = ring_->acceleration(ring, {-force[0], -force[1]});
    result -= Eigen::Vector2d(moves.real(), moves.imag());
  }
  return result;
}

std::array<double, 4> TangentFlow::rate(double time, const trajectory::State& state,
                                        const Eigen::Vector2d& force) const {
  trajectory::PathPoint at;
  at.time = time;
  at.state = state;
  const Eigen::Vector2d acceleration = seen_acceleration(at, force);
  return {state[2], state[3], acceleration[0], acceleration[1]};
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
  for (int i = 0; i < kStages; ++i) {
    auto& [point, acceleration] = stages[static_cast<std::size_t>(i)];
    piece.path(method.node[i], point, contact_.needs_acceleration() ? &forces : nullptr);
    if (point.contacts.empty()) return loses_track();
    std::complex<double> sum;
    for (const trajectory::ContactForce& force : forces) sum += force.on_rotor;
    if (contact_.needs_acceleration()) acceleration = seen_acceleration(point, {sum.real(), sum.imag()});
    point.state = seen(point);
    scale.time_rate = std::max(scale.time_rate, std::abs(point.time_rate));
    for (const auto& contact : point.contacts) {
      for (const double rate : {contact.bending_rate, contact.modulus_rate, contact.amplitude_rate})
        scale.bending_rate = std::max(scale.bending_rate, std::abs(rate));
    }
  }
  if (scale.bending_rate == 0.0) scale.bending_rate = 1.0;

  // Velocities W and places Q at the stages follow from the accelerations there, so that these alone are
  // unknown: W = w0 + A a, Q = q0 + A τ_θ W, A the integrals.
  using Stages = Eigen::Matrix<double, kStages, kStages>;
  Eigen::Matrix<double, kStages, 1> time_rate;
  for (int i = 0; i < kStages; ++i) time_rate[i] = stages[static_cast<std::size_t>(i)].point.time_rate;
  const Stages of_place = method.integral * time_rate.asDiagonal();
  const Stages of_acceleration = of_place * method.integral;
  const Eigen::Matrix<double, kStages, 1> elapsed = of_place.rowwise().sum();
  constexpr Eigen::Index kColumns = Eigen::Index{2} * kCoordinates;
  using Rows = Eigen::Matrix<double, kCoordinates, kColumns>;
  using Matrix = Eigen::Matrix<double, kCoordinates, kCoordinates>;
  const Rows place = tangents_.template topRows<kCoordinates>();
  const Rows velocity = tangents_.template bottomRows<kCoordinates>();
  const double frequency = ring_ ? ring_->frequency() : 0.0;
  const double decay = ring_ ? 2.0 * ring_->damping_ratio() * frequency : 0.0;
  const Matrix restoring = of_bodies<kCoordinates>(shaft_.stiffness, frequency * frequency);
  const Matrix damping = of_bodies<kCoordinates>(shaft_.damping, decay);

  constexpr Eigen::Index kUnknowns = Eigen::Index{kCoordinates} * kStages;
  Eigen::Matrix<double, kUnknowns, kUnknowns> matrix =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity();
  Eigen::Matrix<double, kUnknowns, kColumns> right;
  for (Eigen::Index i = 0; i < kStages; ++i) {
    const auto& [point, shaft_acceleration] = stages[static_cast<std::size_t>(i)];
    const std::optional<ForceSlopes> of_force = contact_.along_path(point, scale, shaft_acceleration);
    if (!of_force) return loses_track();
    const Eigen::Matrix2d by_place = of_force->leftCols<2>();
    const Eigen::Matrix2d by_velocity = of_force->rightCols<2>();
    if (!by_place.allFinite() || !by_velocity.allFinite()) return loses_track();
    Matrix stiffness = -time_rate[i] * restoring;
    Matrix resistance = time_rate[i] * damping;
    const auto add = [&](Matrix& to, const Eigen::Matrix2d& slope) {
      to.template topLeftCorner<2, 2>() += force_unit_ * slope;
      if constexpr (kCoordinates > 2) {
        to.template topRightCorner<2, 2>() -= force_unit_ * slope;
        to.template bottomLeftCorner<2, 2>() -= ring_->force_unit() * slope;
        to.template bottomRightCorner<2, 2>() += ring_->force_unit() * slope;
      }
    };
    add(stiffness, by_place);
    add(resistance, -by_velocity);
    log_volume_ += method.weight[i] * (time_rate[i] * damping - resistance).trace();
    for (Eigen::Index j = 0; j < kStages; ++j) {
      matrix.template block<kCoordinates, kCoordinates>(kCoordinates * i, kCoordinates * j) -=
          of_acceleration(i, j) * stiffness - method.integral(i, j) * resistance;
    }
    right.template middleRows<kCoordinates>(kCoordinates * i) =
        stiffness * (place + elapsed[i] * velocity) - resistance * velocity;
  }
  const Eigen::Matrix<double, kUnknowns, kColumns> acceleration = integrate::solve(matrix, right);
  for (Eigen::Index i = 0; i < kStages; ++i) {
    Rows there = velocity;
    for (Eigen::Index j = 0; j < kStages; ++j)
      there += method.integral(i, j) * acceleration.template middleRows<kCoordinates>(kCoordinates * j);
    tangents_.template topRows<kCoordinates>() += (method.weight[i] * time_rate[i]) * there;
    tangents_.template bottomRows<kCoordinates>() +=
        method.weight[i] * acceleration.template middleRows<kCoordinates>(kCoordinates * i);
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
