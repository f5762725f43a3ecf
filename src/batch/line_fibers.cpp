#include "batch/line_fibers.hpp"

#include <boost/context/detail/exception.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <memory>
#include <utility>

namespace rubatlas::batch {
namespace {

/// A point needs some ten kilobytes, the plan of its spectrum most of them. Pages that are not touched cost
/// nothing, and the one below ends the process rather than spoil a neighbour.
constexpr std::size_t kStackBytes = std::size_t{1024} * 1024;

/// What a thread runs is a property of the thread, as in `std::this_thread`.
thread_local LineFibers* running_batch = nullptr;

}  // namespace

LineFibers::LineFibers(int seats)
    : seats_(static_cast<std::size_t>(seats)), lanes_(seats), last_look_(std::chrono::steady_clock::now()) {
  requests_.reserve(seats_.size());
  askers_.reserve(seats_.size());
}

LineFibers* LineFibers::running() {
  return running_batch;
}

void LineFibers::begin(int seat_number, point::LineSolver& solver, double speed_ratio,
                       const motion::PointStart& start) {
  Seat& seat = seats_[static_cast<std::size_t>(seat_number)];
  seat.solver = &solver;
  seat.speed_ratio = speed_ratio;
  seat.start = start;
  seat.ended = false;
  seat.goes_on = true;
  seat.began_at = shared_clock();
  ++under_way_;
  ready_.push_back(&seat);
  seat.fiber =
      boost::context::fiber(std::allocator_arg, boost::context::protected_fixedsize_stack(kStackBytes),
                            [this, &seat](boost::context::fiber&& caller) {
                              caller_ = std::move(caller);
                              run_point(seat);
                              return std::move(caller_);
                            });
}

void LineFibers::run_point(Seat& seat) {
  try {
    seat.outcome = seat.solver->run(seat.speed_ratio, seat.start, [this, &seat] {
      seat.asks = true;
      caller_ = std::move(caller_).resume();
      return seat.goes_on;
    });
  } catch (const boost::context::detail::forced_unwind&) {
    throw;  // the batch goes, and with it the stacks of points that have not ended
  } catch (...) {
    seat.failure = std::current_exception();
  }
  seat.ended = true;
}

Finished LineFibers::advance(const modes::GoOn& go_on) {
  while (true) {
    if (ready_.empty()) make_attempts();
    Seat& seat = *ready_.front();
    ready_.pop_front();
    resume(seat);
    if (seat.failure) std::rethrow_exception(std::exchange(seat.failure, nullptr));
    if (seat.ended) {
      const double seconds = shared_clock() - seat.began_at;
      --under_way_;
      return {static_cast<int>(&seat - seats_.data()), std::move(seat.outcome), seconds};
    }
    if (std::exchange(seat.asks, false)) {
      ready_.push_back(&seat);
      seat.goes_on = !go_on || go_on();
    }
  }
}

void LineFibers::resume(Seat& seat) {
  current_ = &seat;
  LineFibers* const before = std::exchange(running_batch, this);
  seat.fiber = std::move(seat.fiber).resume();
  running_batch = before;
}

bool LineFibers::wait_for_attempt(LaneRequest& request) {
  Seat& self = *current_;
  requests_.push_back(&request);
  askers_.push_back(&self);
  caller_ = std::move(caller_).resume();
  return self.attempted;
}

void LineFibers::make_attempts() {
  const bool together = requests_.size() > 1;
  if (together) {
    lanes_.attempt(requests_);
    ++counts_.batches;
    counts_.in_lanes += requests_.size();
  }
  for (Seat* asker : askers_) {
    asker->attempted = together;
    ready_.push_back(asker);
  }
  requests_.clear();
  askers_.clear();
}

/// Seconds, each divided by the number of points that were under way in it.
double LineFibers::shared_clock() {
  const auto now = std::chrono::steady_clock::now();
  if (under_way_ > 0) {
    shared_seconds_ += std::chrono::duration<double>(now - last_look_).count() / under_way_;
  }
  last_look_ = now;
  return shared_seconds_;
}

}  // namespace rubatlas::batch
