#include "modes/flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "integrate/newton_between.hpp"
#include "modes/work_meter.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::modes {
namespace {

/// z·z', half of the rate of |z|².
double distance_rate(const rotor::State& state) {
  return state[0] * state[2] + state[1] * state[3];
}

}  // namespace

Flight::Flight(const rotor::Machine& machine)
    : machine_(&machine),
      free_(machine.constants.damping_ratio),
      harmonics_(machine.harmonics()),
      supported_(machine.supported()),
      ring_(machine.ring_body()) {
  if (harmonics_ != nullptr && harmonics_->terms().empty()) harmonics_ = nullptr;
}

void Flight::start(double time, const rotor::ShaftAndRing& bodies) {
  start_ = time;
  at_start_ = bodies;
  if (ring_ == nullptr) at_start_.tail<4>().setZero();
}

rotor::State Flight::shaft(double time) const {
  const double elapsed = time - start_;
  if (supported_ != nullptr)
    return supported_->support.state(start_, at_start_.head<4>().matrix(), elapsed).array();
  const auto kernel = free_.kernel(elapsed);
  rotor::State state = free_.moved(rotor::shaft(at_start_), kernel);
  if (harmonics_ != nullptr) {
    const auto [position, velocity] = harmonics_->from_rest(start_, elapsed, free_, kernel);
    state += rotor::State(position.real(), position.imag(), velocity.real(), velocity.imag());
  }
  return state;
}

rotor::ShaftAndRing Flight::state(double time) const {
  rotor::ShaftAndRing bodies = rotor::shaft_and_ring(shaft(time));
  if (ring_ != nullptr) bodies.tail<4>() = ring_->free(rotor::ring(at_start_), time - start_);
  return bodies;
}

bool Flight::resolves(double time) const {
  return supported_ == nullptr || supported_->support.resolves(time);
}

double Flight::shaft_bound(double time, const rotor::State& state, double horizon, bool of_velocity) const {
  if (supported_ != nullptr) return supported_->bounds.amplitude_bound(time, state.matrix(), horizon);
  double result = std::sqrt(state.square().sum());
  if (harmonics_ != nullptr) {
    result += harmonics_->amplitude() * horizon;
    if (const auto steady = harmonics_->steady(time)) {
      const double distance = std::sqrt(std::norm(Complex(state[0], state[1]) - steady->position) +
                                        std::norm(Complex(state[2], state[3]) - steady->velocity));
      const double largest = steady->largest_square + (of_velocity ? steady->largest_velocity_square : 0.0);
      result = std::min(result, distance + std::sqrt(largest));
    }
  }
  return result;
}

FlightBound Flight::bound(double time, const rotor::ShaftAndRing& bodies, double horizon,
                          bool of_velocity) const {
  FlightBound result{shaft_bound(time, rotor::shaft(bodies), horizon, of_velocity)};
  if (ring_ != nullptr) {
    result.ring_velocity = ring_->energy_norm(rotor::ring(bodies));
    result.ring_position = result.ring_velocity / ring_->frequency();
  }
  return result;
}

double Flight::time_of_bound() const {
  return supported_ != nullptr ? supported_->bounds.growth_time() : std::numeric_limits<double>::infinity();
}

rotor::DerivativeBounds Flight::derivative_bounds(const FlightBound& bound) const {
  const auto of_shaft = supported_ != nullptr
                            ? supported_->bounds.derivative_bounds(bound.shaft)
                            : free_.derivative_bounds(bound.shaft, machine_->harmonics()->bounds());
  if (ring_ == nullptr) return of_shaft;
  const auto of_ring = ring_->derivative_bounds(bound.ring_velocity);
  return {of_shaft.second + of_ring.second, of_shaft.third + of_ring.third, of_shaft.fourth + of_ring.fourth};
}

std::int64_t Flight::price_of_state() const {
  constexpr std::int64_t kMatrix = 300;
  constexpr std::int64_t kTerm = 150;
  if (supported_ == nullptr) return WorkPrice::kState;
  return kMatrix + kTerm * static_cast<std::int64_t>(supported_->support.terms().size());
}

void Flight::places(const trajectory::SampleTimes& times, int first, std::span<double> x,
                    std::span<double> y) const {
  StateRow& row = row_of(times.spacing());
  int number = first;
  rotor::State at = shaft(times[number]);
  x[0] = at[0];
  if (!y.empty()) y[0] = at[1];
  std::size_t done = 1;
  for (int rows = 1; done < x.size(); ++rows) {
    row.start(times[number], at);
    const std::size_t count = std::min<std::size_t>(kTimesOfRow, x.size() - done);
    std::copy_n(row.states().col(0).data(), count, &x[done]);
    if (!y.empty()) std::copy_n(row.states().col(1).data(), count, &y[done]);
    done += count;
    number += static_cast<int>(count);
    at = rows % kRowsFromClosedForm == 0 ? shaft(times[number]) : row.state(kTimesOfRow - 1);
  }
}

double Flight::largest_displacement(double begin, double end, double known) const {
  const double spacing = trajectory::spacing_of_distances(machine_->constants.speed_ratio);
  StateRow& row = row_of(spacing);
  double largest = known * known;
  const auto take = [&](const rotor::State& there) {
    largest = std::max(largest, there[0] * there[0] + there[1] * there[1]);
  };
  rotor::State at = shaft(begin);
  double time = begin;
  double rate = distance_rate(at);
  take(at);
  while (time < end) {
    const double bound = shaft_bound(time, at, end - time, false);
    if (!(bound * bound > largest)) break;
    row.start(time, at);
    const double row_begin = time;
    for (int i = 0; i < kTimesOfRow && time < end; ++i) {
      const double next = std::min(row_begin + (i + 1) * spacing, end);
      const rotor::State there = next < end ? row.state(i) : shaft(end);
      const double rate_there = distance_rate(there);
      take(there);
      if (rate > 0.0 && rate_there < 0.0) take(shaft(top_between(time, next, rate, rate_there)));
      time = next;
      at = there;
      rate = rate_there;
    }
  }
  return largest > known * known ? std::sqrt(largest) : known;
}

/// The time between two others when |z| is largest, from its rates there.
double Flight::top_between(double from, double to, double rate_from, double rate_to) const {
  const auto rate = [&](double time) {
    const rotor::State at = shaft(time);
    const Complex second = machine_->shaft.acceleration(machine_->constants, time, at, 0.0);
    return integrate::ValueAndSlope{
        distance_rate(at), at[2] * at[2] + at[3] * at[3] + at[0] * second.real() + at[1] * second.imag()};
  };
  constexpr double kClosest = 1e-4;  // a maximum is flat
  const double guess = from + (to - from) * rate_from / (rate_from - rate_to);
  return integrate::newton_between(rate, from, to, guess, false, kClosest * (to - from));
}

}  // namespace rubatlas::modes
