/// Guards that several modes share: touch-down of another blade, lift-off at the ring, slip reversal, loss of
/// validity. A guard of a single mode is in the file of that mode.
///
/// For each guard a bound is computed first, from values at the ends of the step. Mostly it shows that the
/// guard is not met; dense output is made and searched only where the bound does not show this. A `mode`
/// gives gap, force and contacts in a state; the search (`guard_search.hpp`) knows the step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compared/guard_search.hpp"
#include "integrate/cubic_range.hpp"
#include "integrate/first_crossing.hpp"

namespace rubatlas::compared {

/// A blade that is not in contact touches the ring: g = 0 from below.
template <class Mode, class Search>
void touch_down(const Mode& mode, Search& search, int k) {
  const BladeGap& start = search.blade(k).at_start;
  const BladeGap& end = search.blade(k).at_end;
  const double size = search.step().size();
  const auto gap = [&](double part) { return mode.gap(k, search.step().at_fraction(part)).value; };
  if (start.value >= 0.0) {
    // The tip has just lifted off or is about to touch. Rounding decides the sign of g; the slope of g tells
    // which it is.
    if (start.rate > 0.0) return search.take_if_first(0.0, {Guard::touch_down, k});
    // The tip leaves the ring, and may return. Divided by the fraction of the step, g starts negative.
    const double more = end.value - start.value;
    const auto range = integrate::cubic_range_of_mean_slope(start.rate * size, more, end.rate * size);
    if (range.greatest < 0.0) return;
    return search.look_from_zero([&](double part) { return gap(part) - start.value; }, more,
                                 {Guard::touch_down, k});
  }
  const auto range = integrate::cubic_range(start.value, start.rate * size, end.value, end.rate * size);
  if (range.greatest < 0.0) return;
  search.look_between(gap, {start.value, end.value}, {Guard::touch_down, k}, mode.gap_rounding());
}

/// g of a contact that has just opened is zero to rounding. Divided by the fraction of the step, g starts
/// positive.
template <class Mode>
bool has_just_opened(const Mode& mode, const WatchedBlade& blade) {
  return blade.at_start.value <= mode.gap_rounding();
}

/// A bound shows that a tip in contact does not come back to g = 0 within the step.
template <class Mode, class Search>
bool stays_in_ring(const Mode& mode, Search& search, const WatchedBlade& blade) {
  const BladeGap& start = blade.at_start;
  const BladeGap& end = blade.at_end;
  if (!(end.value > 0.0)) return false;
  const double size = search.step().size();
  const integrate::Range range =
      has_just_opened(mode, blade)
          ? integrate::cubic_range_of_mean_slope(start.rate * size, end.value - std::min(start.value, 0.0),
                                                 end.rate * size)
          : integrate::cubic_range(start.value, start.rate * size, end.value, end.rate * size);
  return range.least > 0.0;
}

/// The undeformed tip of a contact leaves the ring: g = 0 from above.
template <class Mode, class Search>
void leaves_ring(const Mode& mode, Search& search, int k, const WatchedBlade& blade) {
  const double origin = std::min(blade.at_start.value, 0.0);
  const auto outside = [&](double part) {
    return origin - mode.gap(k, search.step().at_fraction(part)).value;
  };
  if (has_just_opened(mode, blade)) {
    search.look_from_zero(outside, origin - blade.at_end.value, {Guard::lift_off, k});
  } else {
    search.look_between(outside, {-blade.at_start.value, -blade.at_end.value}, {Guard::lift_off, k},
                        mode.gap_rounding());
  }
}

/// Looks for the lift-off at g = 0 where the bound does not exclude it.
template <class Mode, class Search>
void lift_off_at_ring(const Mode& mode, Search& search, int k) {
  const WatchedBlade& blade = search.blade(k);
  if (!stays_in_ring(mode, search, blade)) leaves_ring(mode, search, k, blade);
}

/// Touch-downs and lift-offs of all blades, for modes whose contacts end at the ring.
template <class Mode, class Search>
void touch_downs_and_lift_offs(const Mode& mode, Search& search) {
  for (int k = 0; k < search.blades(); ++k) {
    if (search.blade(k).open) {
      lift_off_at_ring(mode, search, k);
    } else {
      touch_down(mode, search, k);
    }
  }
}

/// The slip velocity of an open contact comes to zero: v changes its sign against s.
template <class Mode, class Search>
void slip_reversal(const Mode& mode, Search& search, std::size_t contact, bool slip_lasts) {
  const WatchedBlade& blade = search.of_contact(contact);
  const double before = blade.slip_velocity;
  const double after = blade.end_slip_velocity;
  const ModeEnd end{Guard::slip_reversal, mode.contacts()[contact].blade};
  if (before * after > 0.0 && slip_lasts) return;
  const auto velocity = [&](double part) {
    return mode.force(contact, search.step().at_fraction(part)).slip_velocity;
  };
  if (before == 0.0) {
    const auto mean = [&](double part) { return velocity(part) / part; };
    const auto next = integrate::first_sign_change(mean, 0.0, 1.0, after);
    if (next) search.take_if_first(*next, end);
    return;
  }
  const double against = before > 0.0 ? -1.0 : 1.0;
  search.look_between([&](double part) { return against * velocity(part); },
                      {-std::abs(before), against * after}, end);
}

/// The same for a tip that may stick. A tip that comes loose slips in the direction of the pull, and may be
/// at rest again within the step.
template <class Mode, class Search>
void slip_comes_to_rest(const Mode& mode, Search& search, std::size_t contact, bool slip_lasts) {
  const WatchedBlade& blade = search.of_contact(contact);
  const double before = blade.slip_velocity;
  const double after = blade.end_slip_velocity;
  const double slip = mode.contacts()[contact].slip;
  const ModeEnd end{Guard::slip_reversal, mode.contacts()[contact].blade};
  if (before * after > 0.0 && slip_lasts) return;
  if (before == 0.0) {
    const auto mean = [&](double part) {
      return mode.force(contact, search.step().at_fraction(part)).slip_velocity / part;
    };
    return search.look_between([&](double part) { return -slip * mean(part); },
                               {-std::abs(after), -slip * after}, end);
  }
  slip_reversal(mode, search, contact, slip_lasts);
}

/// The friction that holds a tip at rest passes its largest value.
template <class Mode, class Search>
void loosening(const Mode& mode, Search& search, std::size_t contact) {
  search.look_for([&](double part) { return mode.excess(contact, search.step().at_fraction(part)); },
                  {Guard::comes_loose, mode.contacts()[contact].blade});
}

/// The shaft's centre reaches the ring: |c| = R (MODEL 5).
template <class Mode, class Search>
void shaft_at_ring(const Mode& mode, Search& search, double farthest) {
  if (farthest < mode.ring_radius()) return;
  search.look_for([&](double part) { return mode.beyond_ring(search.step().at_fraction(part)); },
                  {Guard::left_validity, -1, ending::StatusDetail::shaft_at_ring});
}

/// A blade in contact is shortened by more than the limit: δ/L (MODEL 5).
template <class Mode, class Search>
void shortening_limit(const Mode& mode, Search& search) {
  for (std::size_t i = 0; i < mode.contacts().size(); ++i) {
    search.look_for(
        [&](double part) {
          return mode.force(i, search.step().at_fraction(part)).shortening - mode.limits().max_shortening;
        },
        {Guard::left_validity, mode.contacts()[i].blade, ending::StatusDetail::shortening_limit});
  }
}

/// A straight column on the receding side reaches its Euler load, from where it snaps. For laws with branches
/// only.
template <class Mode, class Search>
void buckling(const Mode& mode, Search& search, std::size_t contact) {
  const auto beyond = [&](double part) {
    return mode.beyond_straight(contact, search.step().at_fraction(part));
  };
  const double at_start = beyond(0.0);
  const double at_end = beyond(1.0);
  // Where the column does not stand straight there is nothing to look for.
  if (at_start == -1.0 && at_end == -1.0) return;
  search.look_between(beyond, {at_start, at_end}, {Guard::snap, mode.contacts()[contact].blade});
}

}  // namespace rubatlas::compared
