#include "contact/elastica_contact.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "integrate/root_between.hpp"

namespace rubatlas::contact {

auto ElasticaContact::constraint_at(const Pose& at, double slip, const blade::CurvePoint& point,
                                    double angular_speed) const -> Constraint {
  const BladeVector<double> there = tip(at, slip, point);
  const BladeVector<double> rate = tip_rate(at, angular_speed);
  TipForce force = bent_tip_force(there, rate, angular_speed, load_unit_ * point.load, slip * friction_);
  force.shortening = point.shortening;
  // (h/2) θ'(0) with EI θ'(0) = F Δ + μF (L − δ)
  force.root_strain = strain_unit_ * point.load * (point.deflection + friction_ * (1.0 - point.shortening));
  return {force, slope(at, slip, point).sum, square_change(there, rate)};
}

std::optional<double> ElasticaContact::solve(const Pose& at, double slip) const {
  const bool outside = at.gap < -gap_rounding(geometry(), at);
  if (has_branches() || (releases_at_fold() && outside)) {
    if (may_stand_straight() && !outside && straight_load(at) <= blade::kEulerLoad) return 0.0;
    for (const Branch& branch : branches(at, slip)) {
      // An undeformed tip that has left the ring has a contact on the bent branch only.
      if (outside && branch.begin == 0.0) continue;
      if (const auto root = root_on(at, slip, branch)) return root;
    }
    return std::nullopt;
  }
  // h is positive from the unloaded blade on, and falls through zero once. On the receding side it first
  // rises from g, which may be zero or negative by rounding: step off to where h is positive; where it is
  // nowhere, the contact is too light to load the blade.
  Branch whole{0.0, curve_->end(), 0.0};
  if (!(at.gap > 0.0)) {
    constexpr double kLeast = 1e-12;  // of the first piece
    const double first = curve_->knots()[1].bending;
    const auto h = [&](double bending) { return residual(at, slip, curve_at(bending)); };
    whole.begin = first;
    while (h(whole.begin) <= 0.0 && whole.begin > kLeast * first) whole.begin *= 0.5;
    if (h(whole.begin) <= 0.0) return outside ? 0.0 : bending_at_ring(at, slip);
    if (h(2.0 * whole.begin) < 0.0) whole.end = 2.0 * whole.begin;
  }
  return root_on(at, slip, whole);
}

double ElasticaContact::bending_at_ring(const Pose& at, double slip) const {
  const auto measure = [&](double bending) { return gap_per_deflection(at, slip, bending); };
  const auto& knots = curve_->knots();
  double low = 0.0;
  double at_low = measure(low);
  if (!(at_low < 0.0)) return 0.0;
  for (auto knot = knots.begin() + 1; knot != knots.end(); ++knot) {
    const double at_high = measure(knot->bending);
    if (at_high > 0.0) return integrate::root_between(measure, low, knot->bending, at_low, at_high);
    low = knot->bending;
    at_low = at_high;
  }
  return 0.0;
}

auto ElasticaContact::branches(const Pose& at, double slip) const -> std::vector<Branch> {
  const auto& knots = curve_->knots();
  const auto rise_at = [&](double bending) { return rise(at, slip, curve_at(bending)).sum; };
  std::vector<Branch> found;
  double before = 0.0;
  double at_before = slope(at, slip, knots.front()).sum;
  bool falls = at_before < 0.0;
  double begin = 0.0;  // of the branch that is open
  double crest = 0.0;
  double at_crest = 0.0;
  const auto close = [&](double end) {
    found.push_back({begin, end, crest});
    at_crest = 0.0;
  };
  const auto pass = [&](double bending, double value) {
    if (!(bending > before)) return;  // a highest value that was found from the knot before, too
    if ((value < 0.0) != falls) {
      const double fold = integrate::root_between(rise_at, before, bending, at_before, value);
      if (falls) close(fold);
      begin = fold;
      falls = !falls;
    }
    if (!falls && value >= at_crest) {
      crest = bending;
      at_crest = value;
    }
    before = bending;
    at_before = value;
  };
  double at_knot = slope(at, slip, knots[1]).sum;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const blade::ElasticaCurve::Knot& following = knots[std::min(i + 1, knots.size() - 1)];
    const double at_next = slope(at, slip, following).sum;
    // Between two knots where h falls it may rise: near a highest value that is close to zero.
    const double drop = at_knot - std::min(at_before, at_next);
    std::pair<double, double> top{};  // where h rises most steeply there, and −slope
    if (at_knot < 0.0 && at_knot > at_before && at_knot >= at_next && at_knot + drop > 0.0) {
      constexpr int kBits = 24;
      std::uintmax_t iterations = 60;
      top = boost::math::tools::brent_find_minima([&](double bending) { return -rise_at(bending); },
                                                  knots[i - 1].bending, following.bending, kBits, iterations);
    }
    if (top.second < 0.0 && top.first < knots[i].bending) pass(top.first, -top.second);
    pass(knots[i].bending, at_knot);
    if (top.second < 0.0) pass(top.first, -top.second);
    at_knot = at_next;
  }
  if (falls) close(curve_->end());
  return found;
}

std::optional<double> ElasticaContact::root_on(const Pose& at, double slip, const Branch& branch) const {
  const auto function = [&](double bending) { return residual(at, slip, curve_at(bending)); };
  const auto& knots = curve_->knots();
  const double at_begin = branch.begin > 0.0 ? function(branch.begin) : residual(at, slip, knots.front());
  if (!(at_begin > 0.0)) {
    // Too light to load the blade, or to bend the column; else h has no root up here.
    const bool unloaded =
        branch.begin == 0.0 && (may_stand_straight() || at.gap >= -gap_rounding(geometry(), at));
    return unloaded ? std::optional(0.0) : std::nullopt;
  }
  auto knot = std::upper_bound(knots.begin(), knots.end(), branch.begin,
                               [](double bending, const auto& other) { return bending < other.bending; });
  double low = branch.begin;
  while (knot != knots.end() && knot->bending < branch.end && !(residual(at, slip, *knot) < 0.0)) {
    low = knot->bending;
    ++knot;
  }
  const double high = knot != knots.end() ? std::min(knot->bending, branch.end) : branch.end;
  const double at_high = function(high);
  if (!(at_high < 0.0)) return std::nullopt;
  return integrate::root_between(function, low, high, function(low), at_high);
}

bool ElasticaContact::ends_unloaded(const Pose& at, double slip, double bending) const {
  if (!starts_unloaded(at, slip)) return false;
  if (!has_branches() || bending == 0.0) return true;
  if (may_stand_straight()) return false;
  const std::vector<Branch> all = branches(at, slip);
  return all.empty() || !(all[place_of(bending, all)].begin > 0.0);
}

std::optional<double> ElasticaContact::snap(const Pose& at, double slip, double bending,
                                            double angular_speed) const {
  const std::vector<Branch> all = branches(at, slip);
  std::size_t next = place_of(bending, all);
  if (may_stand_straight() && bending == 0.0) {
    // Straight before, and bent is what comes next.
  } else if (closes_in(at, slip, bending, angular_speed)) {
    ++next;
  } else if (may_stand_straight()) {
    return at.gap > 0.0 ? std::optional(0.0) : std::nullopt;
  } else if (next == 0 || !(at.gap > 0.0)) {
    return std::nullopt;
  } else {
    --next;
  }
  return next < all.size() ? root_on(at, slip, all[next]) : std::nullopt;
}

std::optional<double> ElasticaContact::solve_near(const Pose& at, double slip, double bending) const {
  if (has_branches() && bending == 0.0) {
    if (may_stand_straight() && straight_load(at) <= blade::kEulerLoad) return 0.0;
    // What starts from the unloaded blade, or the column where it buckles without a jump.
    const std::vector<Branch> all = branches(at, slip);
    if (!all.empty() && all.front().begin == 0.0) return root_on(at, slip, all.front());
    return may_stand_straight() ? std::nullopt : solve(at, slip);
  }
  // Newton on the falling branch. Its floor is the rounding of g against the slope, so it ends when a step no
  // longer shrinks; a step that leaves the branch hands over to the bracketing solver. Between two places
  // where h falls it can rise, so that a fold lies between them, only where its slope is small against what
  // it bends by in between.
  constexpr double kBend = 10.0;
  const double from = bending;
  Slope first{};
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    const blade::CurvePoint point = curve_at(bending);
    const double descent = slope(at, slip, point).sum;
    if (!(descent < 0.0)) break;
    if (has_branches() && iteration == 0) first = rise(at, slip, point);
    const double step = -residual(at, slip, point) / descent;
    const double size = std::abs(step);
    bending += step;
    if (!(bending > 0.0) || bending > curve_->end()) break;
    if (size <= 4e-16 * bending || (size < 1e-9 * bending && size >= 0.5 * previous)) {
      if (!has_branches()) return bending;
      const Slope here = rise(at, slip, point);
      const double moved = (bending - from) / std::min(bending, from);
      const double least = std::min(-first.sum, -here.sum);
      if (kBend * moved * moved * std::max(first.size, here.size) < least) return bending;
      break;
    }
    previous = size;
  }
  if (!has_branches()) return solve(at, slip);
  const std::vector<Branch> all = branches(at, slip);
  return all.empty() ? std::nullopt : root_on(at, slip, all[place_of(from, all)]);
}

bool ElasticaContact::respond(const Pose& at, double slip, double angular_speed, double& bending,
                              TipForce& force) const {
  // Beyond a lift-off on the approaching side the gap is negative and no positive load exists. There the load
  // is continued as an odd function of the gap (at μ = 0, where it does not vanish at lift-off, as an even
  // one).
  const bool beyond_end = !may_stand_straight() && at.gap < 0.0 && ends_unloaded(at, slip, bending);
  Pose mirrored = at;
  if (beyond_end) mirrored.gap = -at.gap;
  const auto root = solve_near(mirrored, slip, bending);
  const bool straightened = may_stand_straight() && (root ? *root == 0.0 : bending == 0.0);
  if (straightened) {
    // Linearly so beyond lift-off, and as far beyond the Euler load as it takes to see that the column snaps
    // there.
    constexpr double kFarthest = 2.0;  // Euler loads
    const double load = straight_load(at);
    if (!(load <= kFarthest * blade::kEulerLoad)) return false;
    bending = 0.0;
    force = straight_force(at, slip, angular_speed);
    return true;
  }
  if (!root) return false;
  bending = *root;
  force = constraint(mirrored, slip, bending, angular_speed).force;
  if (beyond_end && friction_ > 0.0) {
    force.radial = -force.radial;
    force.tangential = -force.tangential;
    force.normal = -force.normal;
  }
  return true;
}

}  // namespace rubatlas::contact
