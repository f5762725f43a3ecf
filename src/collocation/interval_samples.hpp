/// Reading the polynomials of an interval between its nodes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "collocation/interval.hpp"
#include "integrate/largest_value.hpp"

namespace rubatlas::collocation {

/// θ where the interval has reached a time, which counts from its start [τ].
double fraction_at(const Interval& interval, double elapsed);

/// Where the polynomial through values at the places is largest between two places θ. Where it is not larger
/// than `known`, the largest of the values in between and at both ends.
integrate::Sample largest_of(const AtPlaces& values, double from, double to, double known);

/// θ just before a place by which values have become negative where they pass through zero.
double crossing(const AtPlaces& values, std::size_t place);

/// θ and |z| [m] where |z| is largest between two places θ.
integrate::Sample farthest(const Interval& interval, double from, double to);

/// g [m²] of the tip of a straight blade at the places, and half of dg/dτ (MODEL 2). `offset`: cosine and
/// sine of the blade's angle from the leading one.
struct TipCourse {
  AtPlaces gap, rate;
};
TipCourse course_of_tip(const Machine& machine, const Interval& interval, const Blade& blade,
                        const std::array<double, 2>& offset);

/// θ and g [m²] where it is farthest out, of a tip that comes nearer to the ring before and moves away after.
std::optional<integrate::Sample> top_of(const TipCourse& tip);

}  // namespace rubatlas::collocation
