/// The messages between the master (rank 0) and the workers. All messages are small, so that sending never
/// waits.
///
///     worker -> master   ready        nothing to do on one of my seats: send me a piece
///                        report       one point is computed and written
///     master -> worker   piece        compute these points, in order
///                        stop         give up the points you are at, then say that you are ready
///                        leave        there is nothing left to do for you
#pragma once

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

/// One point that a rank has written, and what it cost. The rows themselves are in the atlas already.
struct PointReport {
  std::uint64_t line = 0;
  std::uint64_t visit = 0;
  point::PointStatus status = point::PointStatus::pending;
  point::StatusDetail detail = point::StatusDetail::none;
  std::uint8_t stop_requested = 0;  ///< 1: the rank has received a signal
  motion::SectionState final_state{};
  double seconds = 0.0;
  motion::WorkCounts work;
  motion::Memory final_memory;  ///< the last member, as above
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

static_assert(std::is_trivially_copyable_v<Piece> && std::is_trivially_copyable_v<PointReport> &&
              std::is_trivially_copyable_v<Ready>);

}  // namespace rubatlas::mpi
