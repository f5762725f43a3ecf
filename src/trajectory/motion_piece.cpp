#include "trajectory/motion_piece.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"
#include "integrate/largest_value.hpp"
#include "integrate/root_between.hpp"
#include "trajectory/largest_distance.hpp"

namespace rubatlas::trajectory {

double MotionPiece::largest_displacement(double known, double speed_ratio) {
  if (!(displacement_bound() > known)) return known;
  return std::max(known, largest_distance(*this, 0.0, speed_ratio));
}

std::optional<Pass> MotionPiece::nearest_pass(double known, const PointConstants& point) {
  constexpr double kRounding = 1e-12;  // of the overlap, in what it changes by
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
      const double duration = time - time_before;
      const double rise = duration * before.rate;
      const double fall = duration * after.rate;
      const auto rate = [&](double t) { return tip(k, t).rate; };
      std::optional<double> time_of_top;
      if (before.rate > 0.0 && after.rate < 0.0) {
        if (std::max(before.overlap + rise, after.overlap - fall) > -known)
          time_of_top = integrate::root_between(rate, time_before, time, before.rate, after.rate);
      } else if (integrate::cubic_may_peak(rise, after.overlap - before.overlap, fall,
                                           kRounding * std::abs(before.overlap)) &&
                 integrate::cubic_range(before.overlap, rise, after.overlap, fall).greatest > -known) {
        time_of_top = integrate::first_top(rate, time_before, time, before.rate, after.rate);
      }
      if (time_of_top) {
        const Tip top = tip(k, *time_of_top);
        if (top.overlap < 0.0 && -top.overlap < known) {
          known = -top.overlap;
          nearest = Pass{known, top.side, k, *time_of_top};
        }
      }
      time_before = time;
      before = after;
    }
  }
  return nearest;
}

Tip MotionPiece::deepest(std::size_t contact, double enough) {
  constexpr unsigned kBits = 20;  // of the share; a maximum is flat, so its value has twice as many
  const int number = blade(contact);
  const Tip at_end = tip(number, end());
  if (at_end.rate >= 0.0 || at_end.overlap > enough) return at_end;
  const Tip at_begin = tip(number, begin());
  if (!(at_begin.rate > 0.0)) return at_end;
  // A light contact lasts a millionth of the time that it happens at: its digits are those of its shares.
  const auto at = [&](double share) { return tip(number, time_at(share)); };
  const auto rate = [&](double share) { return at(share).rate; };
  return at(integrate::root_between(rate, 0.0, 1.0, at_begin.rate, at_end.rate, kBits));
}

void MotionPiece::path(double share, PathPoint& point, std::vector<ContactForce>* forces) {
  const double length = end() - begin();
  point.time = begin() + length * share * share * (3.0 - 2.0 * share);
  point.time_rate = 6.0 * share * (1.0 - share) * length;
  point.state = state(point.time);
  point.contacts.clear();
  if (forces == nullptr) return;
  forces->clear();
  for (std::size_t i = 0; i < contact_count(); ++i) forces->push_back(contact_force(i, point.time));
}

MotionPiece::LargestLoad MotionPiece::largest(Load load, std::size_t contact, double known) {
  const auto at = [&](double share) {
    const ContactForce there = contact_force(contact, time_at(share));
    return load == Load::normal_force ? there.normal : there.root_strain;
  };
  if (!load_peaks(contact)) {
    const double at_begin = at(0.0);
    const double at_end = at(1.0);
    return at_end > at_begin ? LargestLoad{end(), at_end} : LargestLoad{begin(), at_begin};
  }
  constexpr std::size_t kParts = 4;  // of a piece, which is a step or less
  std::array<integrate::Sample, kParts + 1> samples{};
  for (std::size_t i = 0; i <= kParts; ++i) {
    const double share = static_cast<double>(i) / kParts;
    samples[i] = {share, at(share)};
  }
  const integrate::Sample found = integrate::largest_value(at, samples, known);
  return {time_at(found.argument), found.value};
}

}  // namespace rubatlas::trajectory
