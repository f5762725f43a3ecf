/// The pieces of a line that several ranks sweep at the same time, and what a seam between two of them may
/// be.
///
/// A sweep goes along its line point after point. Cut into pieces, the line has a run for each piece. The
/// first run begins at the line's first point, as the serial sweep does. Each other run begins `lead_in`
/// points before its piece, from the scene's `initial`; the states that it reaches on the way lead into its
/// piece and are not kept. At the seam between two pieces the motion to which the piece before leads may
/// differ from the motion that the run has found. The piece before then goes on into the next one and
/// replaces its points until both motions are the same, so that the line follows the branch of the serial
/// sweep.
///
/// All of this follows from the scene alone, never from the number of ranks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "plan/grid.hpp"
#include "settings/scene.hpp"

namespace rubatlas::plan {

/// What became of a point at a seam; the numbers are those of the atlas' `/seam`.
enum class Seam : std::uint8_t {
  none = 0,       ///< nothing was compared here
  agrees = 1,     ///< the piece before leads to the same motion; the point's own run goes on from here
  repaired = 2,   ///< the piece before leads to another motion, which stands here
  aperiodic = 3,  ///< as `agrees`: neither motion is periodic, and their displacements are alike
};

/// Where pieces lie on each line. All places are visits (`Grid`).
class Pieces {
 public:
  /// One piece a line where the scene has no `pieces`, or where points do not depend on each other.
  explicit Pieces(const settings::Scene& scene) : visits_(scene.grid.speed_ratio.size()), length_(visits_) {
    if (!scene.pieces || scene.sweep == settings::Sweep::independent) return;
    length_ = std::min(visits_, static_cast<std::size_t>(scene.pieces->points));
    lead_in_ = static_cast<std::size_t>(scene.pieces->lead_in);
  }

  [[nodiscard]] std::size_t per_line() const { return (visits_ + length_ - 1) / length_; }
  [[nodiscard]] std::size_t of_visit(std::size_t visit) const { return visit / length_; }
  [[nodiscard]] std::size_t begin(std::size_t piece) const { return piece * length_; }
  /// The visit behind the last of the piece.
  [[nodiscard]] std::size_t end(std::size_t piece) const { return std::min(visits_, begin(piece) + length_); }
  /// Points of a line that are computed where every seam agrees: those of its runs, and one at each seam.
  [[nodiscard]] std::size_t computed_per_line() const {
    std::size_t sum = per_line() - 1;
    for (std::size_t piece = 0; piece < per_line(); ++piece) sum += end(piece) - run_begin(piece);
    return sum;
  }
  /// Points of the longest run.
  [[nodiscard]] std::size_t longest_run() const {
    std::size_t longest = 0;
    for (std::size_t piece = 0; piece < per_line(); ++piece) {
      longest = std::max(longest, end(piece) - run_begin(piece));
    }
    return longest;
  }
  /// The visit at which the run of the piece begins, from the scene's `initial`.
  [[nodiscard]] std::size_t run_begin(std::size_t piece) const {
    return begin(piece) - std::min(begin(piece), lead_in_);
  }

 private:
  std::size_t visits_;       ///< of a line
  std::size_t length_;       ///< of a piece
  std::size_t lead_in_ = 0;  ///< visits before a piece
};

}  // namespace rubatlas::plan
