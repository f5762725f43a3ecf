/// Lines whose classes and displacements are prescribed.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "analysis/rules/line.hpp"

namespace rubatlas::analysis {

/// Of the default rotor.
inline const SpeedScale kThreeBlades(3);

/// From the end of the piece before (or the start of the line) up to and including `to`.
struct Piece {
  double to;                         ///< Ω [-]
  std::vector<std::uint8_t> motion;  ///< repeated along the piece
  double displacement;               ///< [m]
};

/// `count` speeds over [from, the last piece's end].
inline Line line_of(double from, std::size_t count, const std::vector<Piece>& pieces) {
  Line line;
  const double to = pieces.back().to;
  std::size_t piece = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double speed = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    while (speed > pieces[piece].to + 1e-12) {
      ++piece;
      inside = 0;
    }
    line.speed_ratio.push_back(speed);
    line.motion.push_back(pieces[piece].motion[inside++ % pieces[piece].motion.size()]);
    line.max_displacement.push_back(pieces[piece].displacement);
  }
  return line;
}

/// The paper's picture: small periodic motion to 1/3, chaos with windows to 0.55, period 1 to 2/3, chaos.
inline std::vector<Piece> four_regions() {
  return {{1.0 / 3.0, {1}, 1e-4},
          {0.55, {255, 255, 255, 255, 3}, 1e-2},
          {2.0 / 3.0, {1}, 5e-3},
          {0.95, {255}, 2e-2}};
}

}  // namespace rubatlas::analysis
