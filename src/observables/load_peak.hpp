/// Where the load of a contact is largest within a piece of motion.
#pragma once

#include <boost/math/tools/minima.hpp>
#include <cstddef>

#include "observables/motion_piece.hpp"

namespace rubatlas::observables {

struct LoadPeak {
  double time;   ///< τ of the revolution
  double value;  ///< [N], or [-] of a strain
};

/// The maximum of a function of contact and time within a piece; for pieces of which `load_peaks` is true.
template <double (MotionPiece::*kQuantity)(std::size_t, double)>
LoadPeak load_peak(MotionPiece& piece, std::size_t contact) {
  constexpr int kBits = 20;  // of the time; a maximum is flat, so its value has twice as many
  const auto negative = [&](double time) { return -(piece.*kQuantity)(contact, time); };
  const auto [time, lowest] =
      boost::math::tools::brent_find_minima(negative, piece.begin(), piece.end(), kBits);
  return {time, -lowest};
}

}  // namespace rubatlas::observables
