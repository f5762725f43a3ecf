/// The search for the edges at a border: where, between two neighbouring speeds of a line with different
/// motions, the one motion ends and the other begins.
///
/// The search asks for points in rounds and is told their classes; it computes none itself. It keeps all
/// tried speeds in the order of the sweep. Wherever two successive ones differ in class, an edge lies
/// between; unresolved ones are evidence for neither side. Each round divides the intervals at the sides of
/// the edges into four, until all are as short as asked for. Three points a round, because the halves of
/// bisection always agree with one edge, also where motions alternate; quarters show it. Other motions that
/// come to light in between have edges of their own, so that a cascade of period doublings within one step of
/// the grid becomes its edges. Where a motion comes back after another one, as around the windows of chaotic
/// motion, the border goes on dividing. Only the first and the last side are then narrowed down: the extent
/// of the border.
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
  sharp = 0,    ///< one motion up to its near side, the other from its far side on
  slow = 1,     ///< between them motions are unresolved: they settle too slowly, or change, in the protocol
  divided = 2,  ///< between them motions come and go
  overrun =
      3,  ///< in shorter steps the sweep finds another motion at the last speed than the atlas has there
};

/// A speed that is to be tried next.
struct EdgeRequest {
  double speed_ratio = 0.0;  ///< Ω [-]
  std::size_t from = 0;      ///< number of the tried speed from whose end the sweep arrives
};

/// An edge as it was found, in the order of the sweep.
struct FoundEdge {
  double near_speed = 0.0;  ///< Ω [-] of the last speed with the motion before it
  double far_speed = 0.0;   ///< Ω [-] of the first speed with the motion behind it
  std::uint8_t near_motion = 0;
  std::uint8_t far_motion = 0;
  EdgeOutcome outcome = EdgeOutcome::sharp;
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

  /// The edges in the order of the sweep, one at least; a single one where it goes on dividing or was
  /// overrun. Between the sides of an edge all tried speeds are unresolved, unless it goes on dividing.
  [[nodiscard]] std::vector<FoundEdge> edges() const;
  /// True where the sweep goes up.
  [[nodiscard]] bool is_ascending() const { return tried_.back().speed_ratio > tried_.front().speed_ratio; }
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

  /// Places of tried speeds on both sides of an edge, with nothing but unresolved ones in between.
  struct Change {
    std::size_t near;
    std::size_t far;
  };
  [[nodiscard]] std::vector<Change> changes() const;
  /// Whether a motion comes back behind another one.
  [[nodiscard]] bool alternates(std::span<const Change> changes) const;
  /// Places of the near sides of the intervals that are narrowed down.
  [[nodiscard]] std::vector<std::size_t> intervals() const;
  /// True where the sweep has not found the last motion at the last speed again.
  [[nodiscard]] bool has_lost_its_end() const { return tried_.back().motion != last_motion_; }
  /// The edge up to the last speed where the sweep has found another motion there.
  [[nodiscard]] FoundEdge last_edge(std::span<const Change> changes) const;
  [[nodiscard]] FoundEdge edge_between(std::size_t near, std::size_t far, EdgeOutcome outcome) const;
  [[nodiscard]] double length(std::size_t near) const;

  std::vector<Tried> tried_;  ///< in the order of the sweep
  std::uint8_t last_motion_ = 0;
  double resolution_ = 0.0;
  bool swept_ = true;
  std::size_t given_ = 0;
  std::size_t count_ = 0;  ///< numbers that have been given to tried speeds
};

}  // namespace rubatlas::analysis
