/// How accurate a peer is: its sections against the reference data, its touch-downs against those of
/// `hybrid`.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "peer.hpp"

namespace rubatlas::bench {

/// Revolutions from rest over which motions are compared: within the predictable horizon of every point.
constexpr int kComparedRevolutions = 10;

/// Errors are those of x, y, x', y' at the compared sections.
struct Accuracy {
  bool completed = true;
  double typical_error = 0.0;         ///< geometric mean over the points of each one's largest error
  double largest_error = 0.0;         ///< over all points; errors in units of the clearance
  double largest_displacement = 0.0;  ///< |x + iy| at a section [m]
  std::uint64_t right_hand_sides = 0;
};

/// Over the points of tests/reference/orbits.json that are periodic motions of the default rotor.
Accuracy accuracy_of(const Peer& peer, const PeerSettings& settings);
/// Speed ratios of these points.
std::vector<double> reference_speed_ratios();
/// Largest displacement at the sections of the reference itself [m].
double reference_displacement();

/// The loosest tolerance, in half decades from `settings.tolerance` down, at which the peer's error is at
/// most `target`; where none is, the one with the least error.
PeerSettings match_accuracy(const Peer& peer, PeerSettings settings, double target);

/// Touch-downs in the compared revolutions, one number per speed ratio.
std::vector<std::uint64_t> touchdowns_of(const Peer& peer, const PeerSettings& settings,
                                         std::span<const double> speed_ratios);

}  // namespace rubatlas::bench
