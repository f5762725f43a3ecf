/// Points of several lines in one thread, each on a stack of its own, so that their attempts of contact steps
/// can be made side by side.
///
/// A point runs the program's own code; where it would make an attempt of a step of one carried contact it
/// lets the others go on, and finds the attempt made when it is its turn again. Attempts are made when every
/// point under way waits for one: then as many have come together as there can be.
#pragma once

#include <boost/context/fiber.hpp>
#include <chrono>
#include <cstddef>
#include <deque>
#include <exception>
#include <vector>

#include "batch/contact_lanes.hpp"
#include "batch/line_batch.hpp"

namespace rubatlas::batch {

class LineFibers final : public LineBatch {
 public:
  /// `seats`: lanes of the processor, or fewer.
  explicit LineFibers(int seats);

  void begin(int seat, point::LineSolver& solver, double speed_ratio,
             const motion::PointStart& start) override;
  Finished advance(const modes::GoOn& go_on) override;
  [[nodiscard]] LaneCounts counts() const override { return counts_; }

  /// The one whose point this thread runs; none outside of points.
  static LineFibers* running();

  /// Within a point: false where it is to be made by the caller itself, too few having come together.
  bool attempt(LaneRequest& request) { return under_way_ > 1 && wait_for_attempt(request); }

 private:
  struct Seat {
    boost::context::fiber fiber;  ///< of the point under way
    point::LineSolver* solver = nullptr;
    double speed_ratio = 0.0;
    motion::PointStart start;
    point::PointOutcome outcome;
    std::exception_ptr failure;
    bool ended = false;
    bool asks = false;       ///< whether it is to go on
    bool goes_on = true;     ///< the answer
    bool attempted = false;  ///< its last request was granted
    double began_at = 0.0;   ///< on the clock of shares
  };

  void run_point(Seat& seat);
  bool wait_for_attempt(LaneRequest& request);
  void resume(Seat& seat);
  void make_attempts();
  double shared_clock();

  boost::context::fiber caller_;  ///< `advance`, while a point runs
  std::vector<Seat> seats_;
  Seat* current_ = nullptr;
  std::deque<Seat*> ready_;  ///< points that can go on
  std::vector<LaneRequest*> requests_;
  std::vector<Seat*> askers_;
  int under_way_ = 0;
  ContactLanes lanes_;
  LaneCounts counts_;
  std::chrono::steady_clock::time_point last_look_;
  double shared_seconds_ = 0.0;
};

}  // namespace rubatlas::batch
