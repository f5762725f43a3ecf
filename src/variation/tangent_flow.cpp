#include "variation/tangent_flow.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <utility>

#include "settings/effects/list.hpp"

namespace rubatlas::variation {
namespace {

/// As many as nodes of a collocated contact: order 16, so that what is left is that of the path.
constexpr int kStages = 8;
constexpr int kSize = 4;  ///< of the shaft's state

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
    result.integral = integrals * powers.inverse();
    return result;
  }();
  return kGauss;
}

}  // namespace

TangentFlow::TangentFlow(const settings::Scene& line)
    : force_unit_(1.0 / (line.rotor.mass * line.rotor.natural_frequency * line.rotor.natural_frequency)),
      misalignment_(line.rotor.misalignment),
      free_(line.rotor.damping_ratio),
      stiffness_(line) {
  using effects::Effects;
  if (effects::acts<&Effects::unbalance>(line)) {
    specific_moment_ = line.unbalance->moment / line.rotor.mass;
    phase_ = line.unbalance->phase;
  }
  const double frequency = line.rotor.natural_frequency;
  const auto add = [&](const auto& load) {
    const std::complex<double> deflection = load->deflection(1.0 / force_unit_, frequency);
    static_load_ += Eigen::Vector2d(deflection.real(), deflection.imag());
  };
  if (effects::acts<&Effects::gravity>(line)) add(line.gravity);
  if (effects::acts<&Effects::side_load>(line)) add(line.side_load);
}

Eigen::Vector2d TangentFlow::forcing(double time) const {
  const double angle = speed_ratio_ * time + phase_;
  return static_load_ +
         specific_moment_ * speed_ratio_ * speed_ratio_ * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

void TangentFlow::begin(double speed_ratio, const Tangents& tangents) {
  stiffness_.begin({speed_ratio, free_.damping_ratio(), misalignment_, force_unit_, 1.0});
  speed_ratio_ = speed_ratio;
  tangents_ = tangents;
  events_.clear();
  force_.setZero();
  contacts_.clear();
  known_ = true;
  log_saltation_ = 0.0;
}

void TangentFlow::piece(observables::MotionPiece& piece, const std::function<void()>& between) {
  if (!known_) return;
  if (!events_.empty()) jump(piece, force_in(piece, piece.begin()));
  if (piece.contact_count() == 0) {
    double left = piece.end() - piece.begin();
    for (const double longest = longest_flight(); between && left > longest; left -= longest) {
      fly(longest);
      between();
    }
    fly(left);
    contacts_.clear();
    force_.setZero();
  } else {
    follow(piece);
  }
}

Eigen::Vector2d TangentFlow::force_in(observables::MotionPiece& piece, double time) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
    const std::complex<double> force = piece.contact_force(contact, time).on_rotor;
    sum += Eigen::Vector2d(force.real(), force.imag());
  }
  return sum;
}

double TangentFlow::longest_flight() const {
  // Free motion decays as e^{-rate τ}, and rates differ by no more than the fastest of them.
  constexpr double kMostDecay = 20.0;  // leaves half of the digits of a double
  const double damping = free_.damping_ratio();
  const double fastest = damping + std::sqrt(std::max(0.0, damping * damping - 1.0));
  return kMostDecay / fastest;
}

void TangentFlow::fly(double duration) {
  const auto [cosine, sine] = free_.kernel(duration);
  const double damping = free_.damping_ratio();
  const Eigen::Matrix<double, 2, kSize> place = tangents_.topRows<2>();
  const Eigen::Matrix<double, 2, kSize> velocity = tangents_.bottomRows<2>();
  tangents_.topRows<2>() = cosine * place + sine * (velocity + damping * place);
  tangents_.bottomRows<2>() = cosine * velocity - sine * (place + damping * velocity);
}

void TangentFlow::follow(observables::MotionPiece& piece) {
  const Gauss& method = gauss();
  std::array<observables::PathPoint, kStages> points;
  ContactStiffness::PathScale scale{0.0, 0.0};
  for (int i = 0; i < kStages; ++i) {
    observables::PathPoint& point = points[static_cast<std::size_t>(i)];
    if (!piece.path(method.node[i], point)) return loses_track();
    scale.time_rate = std::max(scale.time_rate, std::abs(point.time_rate));
    for (const auto& contact : point.contacts)
      scale.bending_rate = std::max(scale.bending_rate, std::abs(contact.bending_rate));
  }
  if (scale.bending_rate == 0.0) scale.bending_rate = 1.0;

  // Velocities W and places Q at the stages follow from the accelerations there, so that these alone are
  // unknown: W = w0 + A a, Q = q0 + A τ_θ W, A the integrals.
  using Stages = Eigen::Matrix<double, kStages, kStages>;
  Eigen::Matrix<double, kStages, 1> time_rate;
  for (int i = 0; i < kStages; ++i) time_rate[i] = points[static_cast<std::size_t>(i)].time_rate;
  const Stages of_place = method.integral * time_rate.asDiagonal();
  const Stages of_acceleration = of_place * method.integral;
  const Eigen::Matrix<double, kStages, 1> elapsed = of_place.rowwise().sum();
  const Eigen::Matrix<double, 2, kSize> place = tangents_.topRows<2>();
  const Eigen::Matrix<double, 2, kSize> velocity = tangents_.bottomRows<2>();
  const double damping = 2.0 * free_.damping_ratio();

  constexpr Eigen::Index kUnknowns = Eigen::Index{2} * kStages;
  Eigen::Matrix<double, kUnknowns, kUnknowns> matrix =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity();
  Eigen::Matrix<double, kUnknowns, kSize> right;
  for (Eigen::Index i = 0; i < kStages; ++i) {
    const auto of_force = stiffness_.along_path(points[static_cast<std::size_t>(i)], scale);
    if (!of_force || !of_force->allFinite()) return loses_track();
    const Eigen::Matrix2d stiffness = force_unit_ * *of_force - time_rate[i] * Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d resistance = (damping * time_rate[i]) * Eigen::Matrix2d::Identity();
    for (Eigen::Index j = 0; j < kStages; ++j) {
      matrix.block<2, 2>(2 * i, 2 * j) -=
          of_acceleration(i, j) * stiffness - method.integral(i, j) * resistance;
    }
    right.middleRows<2>(2 * i) = stiffness * (place + elapsed[i] * velocity) - resistance * velocity;
  }
  const Eigen::Matrix<double, kUnknowns, kSize> acceleration = matrix.partialPivLu().solve(right);
  for (Eigen::Index i = 0; i < kStages; ++i) {
    Eigen::Matrix<double, 2, kSize> there = velocity;
    for (Eigen::Index j = 0; j < kStages; ++j)
      there += method.integral(i, j) * acceleration.middleRows<2>(2 * j);
    tangents_.topRows<2>() += (method.weight[i] * time_rate[i]) * there;
    tangents_.bottomRows<2>() += method.weight[i] * acceleration.middleRows<2>(2 * i);
  }

  force_ = force_in(piece, piece.end());
  if (!piece.path(1.0, point_)) return loses_track();
  contacts_ = point_.contacts;
}

void TangentFlow::jump(observables::MotionPiece& piece, const Eigen::Vector2d& force) {
  const Eigen::Vector2d change = force_unit_ * (force - force_);
  const std::vector<Event> events = std::exchange(events_, {});
  if (change == Eigen::Vector2d::Zero()) return;
  if (events.size() > 1) return loses_track();
  const auto [blade, of_slip] = events.front();
  const double time = piece.begin();
  const observables::State state = piece.state(time);
  ContactStiffness::Guard guard;
  if (of_slip) {
    const auto contact = std::ranges::find(contacts_, blade, &observables::PathPoint::Contact::blade);
    if (contact == contacts_.end()) return loses_track();
    const double damping = 2.0 * free_.damping_ratio();
    const Eigen::Vector2d acceleration = force_unit_ * force_ + forcing(time) -
                                         damping * Eigen::Vector2d(state[2], state[3]) -
                                         Eigen::Vector2d(state[0], state[1]);
    const auto slip = stiffness_.slip(*contact, time, state, acceleration);
    if (!slip) return loses_track();
    guard = *slip;
  } else {
    guard = stiffness_.gap(blade, time, state);
  }
  const Eigen::RowVector4d change_of_time = guard.gradient / guard.rate;
  tangents_.bottomRows<2>() += change * (change_of_time * tangents_);
  // det(I + (0, Δa) ∇eᵀ/ė) = 1 + ∇eᵀ (0, Δa) / ė.
  log_saltation_ += std::log(std::abs(1.0 + change_of_time.tail<2>().dot(change)));
}

}  // namespace rubatlas::variation
