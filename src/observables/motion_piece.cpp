#include "observables/motion_piece.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>

#include "observables/largest_distance.hpp"

namespace rubatlas::observables {

double MotionPiece::largest_displacement(double known, double speed_ratio) {
  if (!(displacement_bound() > known)) return known;
  return std::max(known, largest_distance(*this, 0.0, speed_ratio));
}

MotionPiece::LargestLoad MotionPiece::largest(Load load, std::size_t contact, double /*known*/) {
  const auto at = [&](double time) {
    return load == Load::normal_force ? normal_force(contact, time) : root_strain(contact, time);
  };
  LargestLoad result{begin(), at(begin())};
  const double at_end = at(end());
  if (at_end > result.value) result = {end(), at_end};
  if (!load_peaks(contact)) return result;
  constexpr int kBits = 20;  // of the time; a maximum is flat, so its value has twice as many
  const auto [time, lowest] =
      boost::math::tools::brent_find_minima([&](double t) { return -at(t); }, begin(), end(), kBits);
  if (-lowest > result.value) result = {time, -lowest};
  return result;
}

}  // namespace rubatlas::observables
