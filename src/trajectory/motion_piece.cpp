#include "trajectory/motion_piece.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>

#include "integrate/root_between.hpp"
#include "trajectory/largest_distance.hpp"

namespace rubatlas::trajectory {

double MotionPiece::largest_displacement(double known, double speed_ratio) {
  if (!(displacement_bound() > known)) return known;
  return std::max(known, largest_distance(*this, 0.0, speed_ratio));
}

std::optional<Pass> MotionPiece::nearest_pass(double known, const PointConstants& point) {
  // A step in contact is short, and its ends cost little to read.
  const double length = end() - begin();
  const double spacing = spacing_of_distances(point.speed_ratio);
  const int intervals = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  std::optional<Pass> nearest;
  for (int k = 0; k < point.blade_count; ++k) {
    bool touches = false;
    for (std::size_t contact = 0; contact < contact_count(); ++contact) touches |= blade(contact) == k;
    if (touches) continue;
    double time_before = begin();
    Tip before = tip(k, time_before);
    for (int i = 1; i <= intervals; ++i) {
      const double time = i == intervals ? end() : begin() + length * i / intervals;
      const Tip after = tip(k, time);
      const double highest = std::max(before.overlap + before.rate * (time - time_before),
                                      after.overlap - after.rate * (time - time_before));
      if (before.rate > 0.0 && after.rate < 0.0 && highest > -known) {
        const auto rate = [&](double t) { return tip(k, t).rate; };
        const double time_of_top = integrate::root_between(rate, time_before, time, before.rate, after.rate);
        const Tip top = tip(k, time_of_top);
        if (top.overlap < 0.0 && -top.overlap < known) {
          known = -top.overlap;
          nearest = Pass{known, top.side, k, time_of_top};
        }
      }
      time_before = time;
      before = after;
    }
  }
  return nearest;
}

Tip MotionPiece::deepest(std::size_t contact, double enough) {
  constexpr unsigned kBits = 20;  // of the time; a maximum is flat, so its value has twice as many
  const int number = blade(contact);
  const Tip at_end = tip(number, end());
  if (at_end.rate >= 0.0 || at_end.overlap > enough) return at_end;
  const Tip at_begin = tip(number, begin());
  if (!(at_begin.rate > 0.0)) return at_end;
  const auto rate = [&](double time) { return tip(number, time).rate; };
  return tip(number, integrate::root_between(rate, begin(), end(), at_begin.rate, at_end.rate, kBits));
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

}  // namespace rubatlas::trajectory
