/// The search for an edge: where, between two neighbouring speeds of a line with different motions, the one
/// motion ends and the other begins.
///
/// The search asks for points in rounds and is told their classes; it computes none itself. It keeps all
/// tried speeds in the order of the sweep. The motion of the first of them ends within one interval of
/// neighbours, that of the last begins within one. These two intervals, which are the same one as long as no
/// other motion has been found between, are divided into four in each round, until both are as short as asked
/// for. Three points a round, because the halves of bisection always agree with one border, also where
/// motions alternate; quarters show it.
///
/// Along a sweep a point starts from the end of the point before it, and which motion it finds may depend on
/// how far away that is. Each point therefore starts from the tried speed next to its interval, on the side
/// from which the sweep comes. At the end the far side of each interval is tried once more, from its near
/// side: where it then keeps the motion of the near side, the step was too long, and the search goes on
/// behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rubatlas::analysis {

/// What is known of an edge. The numbers are those of the flags in EDGES.h5.
enum class EdgeOutcome : std::uint8_t {
  sharp = 0,    ///< one motion up to `lower`, the other from `upper` on
  slow = 1,     ///< between them motions are unresolved: they settle too slowly, or change, in the protocol
  divided = 2,  ///< between them other motions are found, or the two alternate
  overrun = 3,  ///< a sweep in shorter steps has not left the first motion at the last speed
};

/// A speed that is to be tried next.
struct EdgeRequest {
  double speed_ratio = 0.0;  ///< Ω [-]
  std::size_t from = 0;      ///< number of the tried speed from whose end the sweep arrives
};

class EdgeSearch {
 public:
  /// A search with so many points begins no further round, so that one whose motions depend on steps at every
  /// speed ends.
  static constexpr std::size_t kMostPoints = 300;

  /// `speed_ratio` and `motion` (classes) are neighbouring speeds of a line in the order of the sweep, two at
  /// least; the first and the last motion differ. They get the numbers 0, 1, …; tried speeds go on from
  /// there. `swept`: each starts from the one before. Throws std::invalid_argument.
  EdgeSearch(std::span<const double> speed_ratio, std::span<const std::uint8_t> motion, double resolution,
             bool swept);

  /// The points of the next round, possibly none: then the search has ended.
  [[nodiscard]] std::vector<EdgeRequest> next() const;
  /// The classes found at `next()`, in its order, which get the next numbers.
  void take(std::span<const std::uint8_t> motion);

  [[nodiscard]] EdgeOutcome outcome() const;
  /// Last speed, in the order of the sweep, up to which every tried speed has the first motion.
  [[nodiscard]] double first_motion_to() const { return tried_[last_of_first()].speed_ratio; }
  /// First speed from which on every tried speed has the last motion. Of an `overrun` the last speed.
  [[nodiscard]] double last_motion_from() const { return tried_[first_of_last()].speed_ratio; }
  /// Points that have been computed.
  [[nodiscard]] std::size_t points() const { return count_ - given_; }
  /// Points that are still needed if nothing unexpected is found.
  [[nodiscard]] std::size_t expected_points() const;

 private:
  struct Tried {
    double speed_ratio;
    std::uint8_t motion;
    std::size_t number;
    std::size_t from;  ///< number of the one from whose end it started
  };

  [[nodiscard]] std::size_t last_of_first() const;
  [[nodiscard]] std::size_t first_of_last() const;
  /// Places of the near sides of the one or two intervals.
  [[nodiscard]] std::vector<std::size_t> intervals() const;
  [[nodiscard]] double length(std::size_t near_side) const;

  std::vector<Tried> tried_;  ///< in the order of the sweep
  std::uint8_t last_motion_ = 0;
  double resolution_ = 0.0;
  bool swept_ = true;
  std::size_t given_ = 0;
  std::size_t count_ = 0;  ///< numbers that have been given to tried speeds
};

}  // namespace rubatlas::analysis
