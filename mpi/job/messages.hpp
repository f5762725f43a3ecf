/// The messages between the master (rank 0) and the workers. All messages are small, so that sending never
/// waits.
///
///     worker -> master   ready        nothing to do: send me an assignment
///                        report       points of an assignment are computed, and written or held
///     master -> worker   assignment   compute these points, in order
///                        verdict      which of the points that you hold are kept
///                        stop         give up the points you are at, then say that you are ready
///                        leave        there is nothing left to do for you
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "analysis/rules/same_motion.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::mpi {

enum class Tag : std::uint8_t { ready = 1, report = 2, assignment = 3, stop = 4, leave = 5, verdict = 6 };

/// What becomes of the rows of an assignment's points.
enum class Keep : std::uint8_t {
  at_once,           ///< written
  never,             ///< the points lead to those behind them, or their rows are there already
  after_verdict,     ///< held by the rank until it is known whether the piece before leads to them
  where_it_differs,  ///< written where the motion differs from `Assignment::found`
  compared,          ///< only compared with `Assignment::found`
};

/// Points that one rank computes one after the other: part of a line, or of a piece of it (`plan::Pieces`),
/// in the order of the sweep.
struct Assignment {
  /// Long enough that messages are rare beside computing, short enough that the runs progress evenly, and
  /// that a message about all its points is small.
  static constexpr std::size_t kMostPoints = 64;

  std::uint64_t line = 0;
  std::uint64_t run = 0;  ///< of the schedule
  std::uint64_t first_visit = 0;
  std::uint64_t count = 0;
  std::uint8_t from_initial = 1;  ///< the first point starts from the scene's `initial` ...
  motion::SectionState start{};   ///< ... else from here,
  Keep keep = Keep::at_once;
  analysis::MotionTrace found;  ///< the motion to compare with, where `keep` asks for it
  motion::Memory
      memory;  ///< memory of the effects at its start; the last member, so that its unused part is not sent
};

/// One computed point, and what it cost.
struct PointReport {
  std::uint64_t line = 0;
  std::uint64_t run = 0;  ///< that of its assignment
  std::uint64_t visit = 0;
  ending::PointStatus status = ending::PointStatus::pending;
  ending::StatusDetail detail = ending::StatusDetail::none;
  Keep keep = Keep::at_once;     ///< that of the assignment when the point ended
  std::uint8_t same_motion = 0;  ///< 1: the motion is `Assignment::found`, and the row is not kept
  analysis::MotionTrace trace;   ///< where `keep` is `after_verdict`
  motion::SectionState final_state{};
  double seconds = 0.0;
  motion::Memory final_memory;
};

/// What a rank has done with its time since it opened the atlas [s].
struct RankTimes {
  double busy = 0.0;       ///< CPU time of integration
  double writing = 0.0;    ///< time on the clock spent writing rows and waiting for the disk
  double processor = 0.0;  ///< CPU time altogether
};

/// Points of an assignment that follow each other, which a rank has computed. Rows that are kept at once are
/// in the atlas already. A point whose row is not written at once is reported by itself, because the schedule
/// waits for its cost or its motion.
struct Report {
  struct Point {
    float seconds = 0.0F;
    ending::PointStatus status = ending::PointStatus::pending;
    ending::StatusDetail detail = ending::StatusDetail::none;
  };

  std::uint64_t line = 0;
  std::uint64_t run = 0;
  std::uint64_t first_visit = 0;
  std::uint32_t count = 0;
  std::uint8_t stop_requested = 0;  ///< 1: the rank has received a signal
  Keep keep = Keep::at_once;        ///< of all these points, as is `work`
  RankTimes times;
  motion::WorkCounts work;
  std::uint8_t same_motion = 0;  ///< of the last point, as is all that follows
  analysis::MotionTrace trace;
  motion::SectionState final_state{};
  std::array<Point, Assignment::kMostPoints> points;
  motion::Memory final_memory;  ///< the last member, as above

  /// Appends a point, the next of its assignment.
  void add(const PointReport& point);
  /// The points one by one; only the last one has a final state and a trace.
  [[nodiscard]] PointReport point(std::size_t number) const;
};

/// Number of bytes of a message that are sent.
template <typename Payload>
std::size_t sent_size(const Payload& payload) {
  if constexpr (requires { payload.memory; }) return sizeof payload - payload.memory.unused_bytes();
  if constexpr (requires { payload.final_memory; })
    return sizeof payload - payload.final_memory.unused_bytes();
  return sizeof payload;
}

/// `ready`: the rank has had no assignment yet, or its assignment is over, possibly given up because of a
/// signal.
struct Ready {
  std::uint8_t stop_requested = 0;
};

/// Which points of a piece of `plan::Pieces` stand as its own run has found them; the points before are
/// replaced.
struct Verdict {
  std::uint64_t line = 0;
  std::uint64_t begin = 0;      ///< first visit of the piece
  std::uint64_t kept_from = 0;  ///< first visit that is kept
  std::uint64_t end = 0;        ///< visit behind the last
};

/// `stop` and `leave` have no content.
struct Nothing {};

static_assert(std::is_trivially_copyable_v<Assignment> && std::is_trivially_copyable_v<Report> &&
              std::is_trivially_copyable_v<Ready> && std::is_trivially_copyable_v<Verdict>);

inline void Report::add(const PointReport& point) {
  if (count == 0) {
    line = point.line;
    run = point.run;
    first_visit = point.visit;
    keep = point.keep;
  }
  points[count] = {static_cast<float>(point.seconds), point.status, point.detail};
  ++count;
  same_motion = point.same_motion;
  trace = point.trace;
  final_state = point.final_state;
  final_memory = point.final_memory;
}

inline PointReport Report::point(std::size_t number) const {
  PointReport point;
  point.line = line;
  point.run = run;
  point.visit = first_visit + number;
  point.status = points[number].status;
  point.detail = points[number].detail;
  point.keep = keep;
  point.seconds = points[number].seconds;
  if (number + 1 == count) {
    point.same_motion = same_motion;
    point.trace = trace;
    point.final_state = final_state;
    point.final_memory = final_memory;
  }
  return point;
}

}  // namespace rubatlas::mpi
