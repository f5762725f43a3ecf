#include "rotor/linear_support.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rubatlas::rotor {
namespace {

// Extended precision where propagators are multiplied up: 32² products cost three digits.
using Real = long double;
using Matrix4 = Eigen::Matrix<Real, 4, 4>;
using Matrix42 = Eigen::Matrix<Real, 4, 2>;
using Matrix2 = Eigen::Matrix<Real, 2, 2>;

/// e^{Mτ} of the whole by its blocks: the support's, and for each term the response and the turning pair.
struct Flow {
  Matrix4 support;
  std::vector<Matrix42> gains;
  std::vector<Matrix2> turns;
};

Flow identity(std::size_t terms) {
  return {Matrix4::Identity(), std::vector<Matrix42>(terms, Matrix42::Zero()),
          std::vector<Matrix2>(terms, Matrix2::Identity())};
}

/// First `before`, then `after`.
Flow product(const Flow& after, const Flow& before) {
  Flow result = before;
  result.support = after.support * before.support;
  for (std::size_t j = 0; j < before.gains.size(); ++j) {
    result.gains[j] = after.support * before.gains[j] + after.gains[j] * before.turns[j];
    result.turns[j] = after.turns[j] * before.turns[j];
  }
  return result;
}

/// Taylor series over one step; (1/8)^17/17! is far below a rounding of Real.
Flow exponential(const Matrix4& system, std::span<const HarmonicForcing> terms, Real step) {
  Flow sum = identity(terms.size());
  Flow term = sum;
  for (int k = 1; k <= 17; ++k) {
    const Real factor = step / static_cast<Real>(k);
    term.support = (system * term.support * factor).eval();
    sum.support += term.support;
    for (std::size_t j = 0; j < terms.size(); ++j) {
      Matrix42 gain = system * term.gains[j];
      gain.bottomRows<2>() += term.turns[j];
      term.gains[j] = gain * factor;
      Matrix2 generator;
      generator << 0, -terms[j].frequency, terms[j].frequency, 0;
      term.turns[j] = (generator * term.turns[j] * factor).eval();
      sum.gains[j] += term.gains[j];
      sum.turns[j] += term.turns[j];
    }
  }
  return sum;
}

/// The largest power of two that is not above `value`.
double power_of_two_below(double value) {
  return std::ldexp(1.0, std::ilogb(value));
}

}  // namespace

LinearSupport::LinearSupport(const Eigen::Matrix2d& stiffness, const Eigen::Matrix2d& damping,
                             std::span<const HarmonicForcing> forcing)
    : stiffness_(stiffness), damping_(damping) {
  if (!stiffness.allFinite() || !damping.allFinite())
    throw std::invalid_argument("linear support: stiffness and damping must be finite");
  for (const HarmonicForcing& term : forcing) {
    if (!std::isfinite(std::abs(term.amplitude)) || !std::isfinite(term.frequency))
      throw std::invalid_argument("linear support: amplitudes and frequencies must be finite");
    const auto same = std::find_if(terms_.begin(), terms_.end(), [&](const HarmonicForcing& other) {
      return other.frequency == term.frequency;
    });
    if (same == terms_.end()) {
      terms_.push_back(term);
    } else {
      same->amplitude += term.amplitude;
    }
  }
  if (terms_.size() > kMostTerms)
    throw std::invalid_argument("linear support: more than 40 frequencies of forcing");

  system_.setZero();
  system_.topRightCorner<2, 2>().setIdentity();
  system_.bottomLeftCorner<2, 2>() = -stiffness;
  system_.bottomRightCorner<2, 2>() = -damping;

  // At least 1, since z' is the rate of z.
  double rate = system_.norm();
  for (const HarmonicForcing& term : terms_) rate = std::max(rate, std::abs(term.frequency));
  step_ = power_of_two_below(0.125 / rate);
  steps_per_time_ = 1.0 / step_;
  // So stiff a support resolves no flight.
  if (!resolves(0.0)) return;
  const double levels = std::ceil(std::log2(kLongestPiece * steps_per_time_) / kBitsOfDigit);
  levels_ = std::max(kFewestLevels, static_cast<std::size_t>(levels));
  build_propagators();
}

bool LinearSupport::resolves(double time) const {
  constexpr double kMostSteps = 0x1p34;  // of 2^64: ten digits are left
  return steps_per_time_ * std::max(time, 1.0) <= kMostSteps;
}

void LinearSupport::build_propagators() {
  propagators_.reserve(levels_ * kDigits);
  responses_.reserve(levels_ * kDigits * terms_.size());
  Flow step = exponential(system_.cast<Real>(), terms_, step_);
  for (std::size_t level = 0; level < levels_; ++level) {
    Flow flow = identity(terms_.size());
    for (std::size_t digit = 0; digit < kDigits; ++digit) {
      propagators_.emplace_back(flow.support.cast<double>());
      for (std::size_t j = 0; j < terms_.size(); ++j) {
        const Response response{flow.gains[j].cast<double>(), static_cast<double>(flow.turns[j](0, 0)),
                                static_cast<double>(flow.turns[j](1, 0))};
        responses_.push_back(response);
      }
      flow = product(step, flow);
    }
    step = flow;
  }
}

auto LinearSupport::phasors_at(double time, std::size_t count) const -> Phasors {
  Phasors phasors;
  phasors.first = 0;
  phasors.count = count;
  for (std::size_t j = 0; j < count; ++j) {
    const double angle = terms_[j].frequency * time;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const Complex amplitude = terms_[j].amplitude;
    phasors.real[j] = amplitude.real() * cosine - amplitude.imag() * sine;
    phasors.imaginary[j] = amplitude.real() * sine + amplitude.imag() * cosine;
  }
  return phasors;
}

LinearSupport::State LinearSupport::moved(double time, State state, double elapsed, std::size_t terms) const {
  // Propagators lead forward. So many steps back take some 0.2 s.
  constexpr double kMostBack = 0x1p20;
  if (-elapsed * steps_per_time_ > kMostBack)
    return State::Constant(std::numeric_limits<double>::quiet_NaN());
  const double back = -0.5 * step_;
  while (elapsed <= back) {
    Phasors phasors = phasors_at(time, terms);
    advance_within_step(back, state, phasors);
    time += back;
    elapsed -= back;
  }
  Phasors phasors = phasors_at(time, terms);
  pass(elapsed, state, phasors);
  return state;
}

std::vector<Eigen::Matrix<double, 4, 2>> LinearSupport::from_rest(double elapsed) const {
  Phasors phasors;
  phasors.count = 1;
  std::vector<Eigen::Matrix<double, 4, 2>> result(terms_.size());
  for (phasors.first = 0; phasors.first < terms_.size(); ++phasors.first) {
    for (int i = 0; i < 2; ++i) {
      phasors.real[0] = i == 0 ? 1.0 : 0.0;
      phasors.imaginary[0] = i == 0 ? 0.0 : 1.0;
      State state = State::Zero();
      pass(elapsed, state, phasors);
      result[phasors.first].col(i) = state;
    }
  }
  return result;
}

void LinearSupport::pass(double elapsed, State& state, Phasors& phasors) const {
  if (propagators_.empty()) {
    state.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  // The nearest number of steps; what is left is exact, since h is a power of two.
  const std::size_t steps = (static_cast<std::size_t>(elapsed * (2.0 * steps_per_time_)) + 1) / 2;
  const double rest = elapsed - static_cast<double>(steps) * step_;
  const std::size_t last = levels_ - 1;
  std::size_t size = std::size_t{1} << (kBitsOfDigit * last);  // of a step of the level, in h
  // Flights beyond the last level repeat its longest propagator.
  for (std::size_t left = steps / size; left > 0;) {
    const std::size_t digit = std::min(left, kDigits - 1);
    advance(last * kDigits + digit, state, phasors);
    left -= digit;
  }
  for (std::size_t level = last; level-- > 0;) {
    size /= kDigits;
    if (const std::size_t digit = steps / size % kDigits; digit > 0)
      advance(level * kDigits + digit, state, phasors);
  }
  advance_within_step(rest, state, phasors);
}

void LinearSupport::advance(std::size_t entry, State& state, Phasors& phasors) const {
  state = (propagators_[entry] * state).eval();
  const Response* response = responses_.data() + entry * terms_.size() + phasors.first;
  for (std::size_t j = 0; j < phasors.count; ++j, ++response) {
    const double real = phasors.real[j];
    const double imaginary = phasors.imaginary[j];
    state += response->gain.col(0) * real + response->gain.col(1) * imaginary;
    phasors.real[j] = response->cosine * real - response->sine * imaginary;
    phasors.imaginary[j] = response->sine * real + response->cosine * imaginary;
  }
}

void LinearSupport::advance_within_step(double time, State& state, Phasors& phasors) const {
  // Terms of the series of z, z' and each u e^{iντ}, the k-th from the one before.
  Eigen::Vector2d position = state.head<2>();
  Eigen::Vector2d velocity = state.tail<2>();
  for (int k = 1; k <= kOrder; ++k) {
    const double factor = time / k;
    Eigen::Vector2d rate = -stiffness_ * position - damping_ * velocity;
    for (std::size_t j = 0; j < phasors.count; ++j) {
      const double real = phasors.real[j];
      const double imaginary = phasors.imaginary[j];
      rate += Eigen::Vector2d(real, imaginary);
      const double turn = terms_[phasors.first + j].frequency * factor;
      phasors.real[j] = -turn * imaginary;
      phasors.imaginary[j] = turn * real;
    }
    position = velocity * factor;
    velocity = rate * factor;
    state.head<2>() += position;
    state.tail<2>() += velocity;
  }
}

LinearSupport::Complex LinearSupport::forcing(double time) const {
  Complex sum = 0.0;
  for (const HarmonicForcing& term : terms_)
    sum += term.amplitude * Complex(std::cos(term.frequency * time), std::sin(term.frequency * time));
  return sum;
}

LinearSupport::Complex LinearSupport::acceleration(const State& state) const {
  const Eigen::Vector2d result = -stiffness_ * state.head<2>() - damping_ * state.tail<2>();
  return {result[0], result[1]};
}

LinearSupport::Complex LinearSupport::acceleration(double time, const State& state) const {
  return acceleration(state) + forcing(time);
}

}  // namespace rubatlas::rotor
