#include "collocation/earlier_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubatlas::collocation {
namespace {

/// Differences [clearances] up to which a contact is followed: beyond, a circular arc is as good a guess.
constexpr double kAlike = 0.03;
/// Up to which the new contact takes the place of the earlier one, so that a periodic motion keeps one of
/// each kind.
constexpr double kSame = 0.001;

/// `turn`: cosine and sine of the angle from where the earlier one started to where the next one does.
void place(const Places& earlier, const std::array<double, 2>& turn, const AtNodes& times, Places& next) {
  const auto [cosine, sine] = turn;
  const auto& [start, x, y, vx, vy] = earlier;
  const double faster_x = next.start[2] - (start[2] * cosine - start[3] * sine);
  const double faster_y = next.start[3] - (start[3] * cosine + start[2] * sine);
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double along = x[i] - start[0];
    const double across = y[i] - start[1];
    next.x[i] = next.start[0] + ((along * cosine - across * sine) + faster_x * times[i]);
    next.y[i] = next.start[1] + ((across * cosine + along * sine) + faster_y * times[i]);
    next.vx[i] = (vx[i] * cosine - vy[i] * sine) + faster_x;
    next.vy[i] = (vy[i] * cosine + vx[i] * sine) + faster_y;
  }
}

}  // namespace

void EarlierInterval::take(const Machine& machine, const Interval& solved, double length_of_arc) {
  length = length_of_arc;
  chord = solved.chord;
  normal = solved.normal;
  blade = solved.blade;
  deviation = solved.deviation;
  elapsed = solved.elapsed;
  shaft = static_cast<const Places&>(solved.shaft);
  if (machine.ring.moves) ring = static_cast<const Places&>(solved.ring);
  start_lean = solved.leader().start_lean;
  lean = solved.leader().lean;
}

void EarlierInterval::guess(const Machine& machine, Interval& next) const {
  next.chord = chord;
  next.normal = normal;
  if (chord.time == 0.0) next.chord.argument = -next.start_argument;  // down to p = 0, wherever it starts
  next.deviation = deviation;
  const std::array<double, 2> turn{next.blade[0] * blade[0] + next.blade[1] * blade[1],
                                   next.blade[1] * blade[0] - next.blade[0] * blade[1]};
  place(shaft, turn, elapsed, next.shaft);
  if (machine.ring.moves) place(ring, turn, elapsed, next.ring);
  if (!next.leans()) return;
  TipInTime& leader = next.leader();
  for (std::size_t i = 0; i < kNodes; ++i) leader.lean[i] = lean[i] + (leader.start_lean - start_lean);
}

double EarlierContacts::distance(const Beginning& a, const Beginning& b, double least) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  if (a.slip != b.slip || a.straight != b.straight || (a.argument == 0.0) != (b.argument == 0.0)) return kFar;
  double of_places = std::max((a.shaft - b.shaft).abs().maxCoeff(), (a.forcing - b.forcing).abs().maxCoeff());
  if (ring_moves_) of_places = std::max(of_places, (a.ring - b.ring).abs().maxCoeff());
  if (!(of_places < least * clearance_)) return kFar;
  return std::max({of_places / clearance_, std::abs(a.argument - b.argument),
                   std::abs(a.angular_speed - b.angular_speed)});
}

EarlierContacts::Found EarlierContacts::find(const Beginning& beginning) {
  std::size_t nearest = 0;
  double least = kAlike;
  const std::size_t count = contacts_.size();
  for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
    // Differences of places and velocities across the blade, of so many at once.
    const auto first = static_cast<Eigen::Index>(begin);
    const auto places = across_.segment<kAtOnce>(first) - beginning.shaft[1];
    const auto velocities = velocity_across_.segment<kAtOnce>(first) - beginning.shaft[3];
    const Eigen::Array<double, kAtOnce, 1> apart = places.abs().max(velocities.abs());
    if (!(apart.minCoeff() < least * clearance_)) continue;  // mostly
    for (std::size_t i = begin; i < std::min(begin + kAtOnce, count); ++i) {
      if (!(apart[static_cast<Eigen::Index>(i - begin)] < least * clearance_)) continue;
      const double there = distance(beginning, beginnings_[i], least);
      if (there < least) {
        least = there;
        nearest = i;
      }
    }
  }
  const std::size_t next = least < kSame ? nearest : oldest_;
  if (next == oldest_) oldest_ = (oldest_ + 1) % kKept;
  if (next == contacts_.size()) contacts_.emplace_back();
  const Found found{least < kAlike ? &contacts_[nearest] : nullptr, &contacts_[next]};
  // Its intervals are read, one by one, before they are written.
  if (found.kept != found.alike) found.kept->count = 0;
  beginnings_[next] = beginning;
  across_[static_cast<Eigen::Index>(next)] = beginning.shaft[1];
  velocity_across_[static_cast<Eigen::Index>(next)] = beginning.shaft[3];
  return found;
}

}  // namespace rubatlas::collocation
