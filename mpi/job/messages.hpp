/// The messages between the master (rank 0) and the workers. All messages are small, so that sending never
/// waits.
///
///     worker -> master   ready        nothing to do on one of my seats: send me a piece
///                        report       points of a piece are computed and written
///     master -> worker   piece        compute these points, in order
///                        stop         give up the points you are at, then say that you are ready
///                        leave        there is nothing left to do for you
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "point/line_solver.hpp"

namespace rubatlas::mpi {

enum class Tag : std::uint8_t { ready = 1, report = 2, piece = 3, stop = 4, leave = 5 };

/// Points that one rank computes one after the other: part of a line, in the order of the sweep.
struct Piece {
  std::uint64_t line = 0;
  std::uint64_t first_visit = 0;
  std::uint64_t count = 0;
  std::uint8_t from_initial = 1;  ///< the first point starts from the scene's `initial` ...
  motion::SectionState start{};   ///< ... else from here,
  std::int32_t seat = 0;          ///< of the rank (`PointRunner`)
  motion::Memory
      memory;  ///< memory of the effects at its start; the last member, so that its unused part is not sent
};

/// One computed point, and what it cost.
struct PointReport {
  std::uint64_t line = 0;
  std::uint64_t visit = 0;
  point::PointStatus status = point::PointStatus::pending;
  point::StatusDetail detail = point::StatusDetail::none;
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

/// Points of a piece that follow each other, which a rank has computed. Their rows are in the atlas already.
struct Report {
  /// Few enough that sending the message never waits.
  static constexpr std::size_t kMostPoints = 64;
  struct Point {
    float seconds = 0.0F;
    point::PointStatus status = point::PointStatus::pending;
    point::StatusDetail detail = point::StatusDetail::none;
  };

  std::uint64_t line = 0;
  std::uint64_t first_visit = 0;
  std::uint32_t count = 0;
  std::uint8_t stop_requested = 0;  ///< 1: the rank has received a signal
  RankTimes times;
  motion::WorkCounts work;             ///< of all these points
  motion::SectionState final_state{};  ///< of the last point, as is `final_memory`
  std::array<Point, kMostPoints> points;
  motion::Memory final_memory;  ///< the last member, as above

  /// Appends a point, the next of its line.
  void add(const PointReport& point);
  /// The points one by one; only the last one has a final state.
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

/// `ready`: the seat has never had a piece, or its piece is over, possibly given up because of a signal.
struct Ready {
  std::int32_t seat = 0;
  std::int32_t seats = 1;  ///< seats of the rank
  std::uint8_t stop_requested = 0;
};

/// `stop` and `leave` have no content.
struct Nothing {};

static_assert(std::is_trivially_copyable_v<Piece> && std::is_trivially_copyable_v<Report> &&
              std::is_trivially_copyable_v<Ready>);

inline void Report::add(const PointReport& point) {
  if (count == 0) {
    line = point.line;
    first_visit = point.visit;
  }
  points[count] = {static_cast<float>(point.seconds), point.status, point.detail};
  ++count;
  final_state = point.final_state;
  final_memory = point.final_memory;
}

inline PointReport Report::point(std::size_t number) const {
  PointReport point;
  point.line = line;
  point.visit = first_visit + number;
  point.status = points[number].status;
  point.detail = points[number].detail;
  point.seconds = points[number].seconds;
  if (number + 1 == count) {
    point.final_state = final_state;
    point.final_memory = final_memory;
  }
  return point;
}

}  // namespace rubatlas::mpi
