#include "branch/continuation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rubatlas::branch {
namespace {

constexpr double kFirstStep = 1e-3;      ///< arclength, scaled
constexpr double kLongestStep = 0.05;    ///< likewise
constexpr double kLongestOnCurve = 0.5;  ///< a curve has no bifurcations to be stepped over
constexpr double kShortestStep = 1e-9;
constexpr double kBehindGrazing = 1e-7;
constexpr int kMostIterations = 8;
constexpr int kEasy = 3;  ///< iterations: the next step may be longer
/// Of the clearance: a tip that misses, or a contact that is as deep, at the end of a bisection grazes.
constexpr double kGrazes = 1e-4;
/// In clearances per unit τ: a tip that touches down more slowly, and ever more so along the branch, grazes.
/// There its place is known to rounding, which over the speed makes 1e-10 of a time.
constexpr double kGrazingSpeed = 1e-5;
constexpr double kSame = 1e-4;          ///< scaled: orbits that are nearer to each other are of one branch
constexpr double kNearlyClosed = 1e-2;  ///< in clearances: an orbit with such a touch-down closes nearly

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Wide = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

/// The direction in which all rows vanish, of length 1, turned like `along`.
Unknowns null_direction(const Wide& rows, const Unknowns& along) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> parts(rows, Eigen::ComputeFullV);
  Unknowns direction = parts.matrixV().col(rows.cols() - 1);
  return direction.dot(along) < 0.0 ? Unknowns(-direction) : direction;
}

/// One step of Newton's method on rows(U) = 0 within the plane normal to `tangent`.
Unknowns newton_step(const Wide& rows, const Eigen::VectorXd& values, const Unknowns& tangent) {
  Square matrix(rows.cols(), rows.cols());
  matrix.topRows(rows.rows()) = rows;
  matrix.bottomRows(1) = tangent.transpose();
  Eigen::VectorXd right(rows.cols());
  right.head(rows.rows()) = -values;
  right[rows.cols() - 1] = 0.0;
  return matrix.partialPivLu().solve(right);
}

/// Touch-downs from cut to cut: their number does not change but by a grazing.
std::ptrdiff_t touches(const Orbit& orbit) {
  return std::ranges::count_if(orbit.map.events, [](std::int32_t event) { return event > 0; });
}

bool same_touches(const Orbit& a, const Orbit& b) {
  return touches(a) == touches(b);
}

}  // namespace

double test_function(EventKind kind, const Orbit& orbit) {
  if (kind == EventKind::fold) return (orbit.forward - orbit.backward).determinant();
  // A multiplier between cuts of which an even number make a period is positive there, where it is real.
  if (kind == EventKind::period_doubling)
    return orbit.cuts % 2 == 0 ? 1.0 : (orbit.forward + orbit.backward).determinant();
  // Of all pairs of multipliers the product of μi μj − 1: real, since complex ones come in pairs.
  const Eigen::Vector4cd& multipliers = orbit.multipliers;
  std::complex<double> product = 1.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) product *= multipliers[i] * multipliers[j] - 1.0;
  }
  return product.real();
}

Continuation::Continuation(Shooting& shooting, OnOrbit on_orbit)
    : shooting_(&shooting), on_orbit_(std::move(on_orbit)) {}

std::optional<Orbit> Continuation::settle(const motion::SectionState& initial,
                                          const std::vector<double>& quantities, int transient_revolutions) {
  constexpr int kLongestPeriod = 16;
  constexpr double kNear = 1e-3;  // of the clearance: close enough for Newton's method to be tried
  shooting_->cut_at_section();
  Unknowns at = shooting_->scaled(initial, quantities);
  const point::SectionMap settled = shooting_->follow(at, transient_revolutions + kLongestPeriod);
  if (settled.status != ending::PointStatus::done) return std::nullopt;
  const auto from_end = [&](int back) {
    return shooting_->scaled(settled.sections[settled.sections.size() - 1 - static_cast<std::size_t>(back)],
                             quantities);
  };
  const Unknowns last = from_end(0);
  for (int period = 1; period <= kLongestPeriod; ++period) {
    const int back = std::min(period, static_cast<int>(settled.sections.size()) - 1);
    if ((last - from_end(back)).norm() > kNear) continue;
    shooting_->set_period(period);
    Unknowns plane = Unknowns::Zero(shooting_->size());
    plane[4] = 1.0;  // the first quantity stays
    if (const auto found = correct(last, plane)) return found->orbit;
  }
  return std::nullopt;
}

std::optional<Continuation::State> Continuation::correct(const Unknowns& predicted, const Unknowns& tangent) {
  Unknowns at = predicted;
  for (iterations_ = 0; iterations_ < kMostIterations; ++iterations_) {
    const auto orbit = shooting_->orbit(at);
    if (!orbit) return std::nullopt;
    if (shooting_->closes(at, *orbit)) {
      const auto along = tangent_at(at, *orbit, tangent);
      if (!along) return std::nullopt;
      return State{at, *orbit, *along};
    }
    const auto rows = shooting_->derivative(at, *orbit);
    if (!rows) return std::nullopt;
    const Unknowns step = newton_step(*rows, orbit->mismatch, tangent);
    if (!step.allFinite() || step.norm() > 1.0) return std::nullopt;
    at += step;
  }
  return std::nullopt;
}

std::optional<Unknowns> Continuation::tangent_at(const Unknowns& at, const Orbit& orbit,
                                                 const Unknowns& along) {
  const auto rows = shooting_->derivative(at, orbit);
  if (!rows) return std::nullopt;
  return null_direction(*rows, along);
}

Branch Continuation::follow(const Orbit& from, double direction, std::size_t most) {
  Unknowns along = Unknowns::Zero(shooting_->size());
  along[4] = direction;
  shooting_->set_period(from.period);
  shooting_->cut_at_section();
  const auto state = correct(shooting_->scaled(from.section, from.quantities), along);
  if (!state) return {};
  return follow(*state, most);
}

std::optional<Branch> Continuation::follow_doubled(const Event& doubling, std::size_t most) {
  shooting_->cut_at_section();
  shooting_->set_period(doubling.orbit.period);
  const Unknowns at = shooting_->scaled(doubling.orbit.section, doubling.orbit.quantities);
  const auto single = shooting_->orbit(at);
  if (!single) return std::nullopt;
  const Eigen::EigenSolver<Eigen::Matrix4d> parts(single->map.jacobian);
  int nearest = 0;
  for (int i = 1; i < 4; ++i) {
    if (std::abs(parts.eigenvalues()[i] + 1.0) < std::abs(parts.eigenvalues()[nearest] + 1.0)) nearest = i;
  }
  Unknowns along = Unknowns::Zero(shooting_->size());
  along.head<4>() = parts.eigenvectors().col(nearest).real();
  along.normalize();
  shooting_->set_period(2 * doubling.orbit.period);
  // Away from the orbit itself, of which the doubled one is twice the same: too near, Newton's method falls
  // back onto it.
  for (const double length : {1e-3, 3e-3, 1e-2, 3e-2}) {
    const auto state = correct(at + length * along, along);
    if (!state) continue;
    const motion::SectionState& half =
        state->orbit.map.sections[static_cast<std::size_t>(doubling.orbit.period) - 1];
    const Unknowns halfway = shooting_->scaled(half, state->orbit.quantities);
    if ((halfway - state->at).head<4>().norm() < 0.1 * length) continue;
    State start = *state;
    if (start.tangent.dot(along) < 0.0) start.tangent = -start.tangent;
    return follow(start, most);
  }
  return std::nullopt;
}

Branch Continuation::follow(State state, std::size_t most) {
  Branch branch;
  branch.orbits.push_back(state.orbit);
  double length = kFirstStep;
  const auto in_section = [&](const Orbit& orbit) {
    return shooting_->scaled(orbit.section, orbit.quantities);
  };
  const Unknowns first = in_section(state.orbit);
  std::vector<Unknowns> behind_grazings;
  while (branch.orbits.size() < most) {
    std::optional<State> next;
    if (!vanishes(state)) {
      length = std::min(length, longest_step(state));
      next = advance(state, length);
      // Of two orbits that are close in arclength the tangents are alike; else the step has left the branch.
      if (next && !(next->tangent.dot(state.tangent) > 0.9)) next.reset();
    }
    const bool eased = iterations_ <= kEasy;
    if (next && !shooting_->in_range(next->at)) {
      if (const auto last = at_end_of_range(state, *next)) {
        locate(state, *last, std::max((last->at - state.at).norm(), kShortestStep), branch.events);
        branch.orbits.push_back(last->orbit);
        break;
      }
      next.reset();  // another branch, or a grazing before the end of the range
    }
    std::optional<Grazing> within;
    if (next && !same_touches(state.orbit, next->orbit)) {
      // Touch-downs change at a grazing, or else the step has left the branch. Right behind a grazing the
      // branch may turn: it goes on from there by small steps.
      within = locate_grazing(state, length);
      next = within ? within->behind : std::nullopt;
      if (next) length = within->length;
    }
    if (!next) {
      length *= 0.5;
      if (length >= kShortestStep && !vanishes(state)) continue;
      auto behind = go_on_behind_grazing(state, branch.events);
      if (!behind) break;
      // A branch that has come back to where it went on before has closed.
      const Unknowns place = in_section(behind->orbit);
      const bool closed = std::ranges::any_of(
          behind_grazings, [&](const Unknowns& other) { return (place - other).norm() < kSame; });
      if (closed) break;
      behind_grazings.push_back(place);
      state = std::move(*behind);
      branch.orbits.push_back(state.orbit);
      length = kFirstStep;
      continue;
    }
    locate(state, *next, length, branch.events);
    if (within) add_grazing(std::move(within->event), branch.events);
    state = std::move(*next);
    branch.orbits.push_back(state.orbit);
    if (on_orbit_) on_orbit_(state.orbit);
    if (branch.orbits.size() > 10 && (in_section(state.orbit) - first).norm() < 0.5 * length) break;
    if (within) length = kBehindGrazing;
    length = eased ? std::min(1.5 * length, kLongestStep) : length;
  }
  return branch;
}

std::optional<Continuation::State> Continuation::at_end_of_range(const State& inside, const State& outside) {
  const Varied& varied = shooting_->varied()[0];
  const double limit =
      (shooting_->quantity(outside.at, 0) > varied.highest ? varied.highest : varied.lowest) / varied.scale;
  const Unknowns way = outside.at - inside.at;
  Unknowns plane = Unknowns::Zero(shooting_->size());
  plane[4] = 1.0;
  auto last = correct(inside.at + (limit - inside.at[4]) / way[4] * way, plane);
  const bool between = last && (last->at - inside.at).norm() <= way.norm();
  return between && same_touches(inside.orbit, last->orbit) ? last : std::nullopt;
}

std::optional<Continuation::State> Continuation::go_on_behind_grazing(const State& before,
                                                                      std::vector<Event>& events) {
  const auto grazing = locate_grazing(before, kFirstStep);
  if (!grazing) {
    events.push_back({EventKind::lost, before.orbit});
    return std::nullopt;
  }
  const auto cut = shooting_->cut();
  auto behind = vanishes(before) ? without_touch(grazing->event, before) : with_touch(grazing->event);
  if (!behind) cut ? shooting_->cut_at(*cut) : shooting_->cut_at_section();
  // A contact that becomes light is followed to where it vanishes, which is the grazing.
  const bool lightens = behind && shooting_->cut() && behind->tangent[kApproachSpeed] < 0.0;
  if (!lightens) events.push_back(grazing->event);
  return behind;
}

void Continuation::add_grazing(Event grazing, std::vector<Event>& events) const {
  // Blades that are alike graze at once, but for rounding.
  constexpr double kAtOnce = 1e-9;
  const double scale = shooting_->varied()[0].scale;
  const bool known =
      !events.empty() && events.back().kind == EventKind::grazing &&
      std::abs(events.back().orbit.quantities[0] - grazing.orbit.quantities[0]) < kAtOnce * scale;
  if (!known) events.push_back(std::move(grazing));
}

bool Continuation::vanishes(const State& state) const {
  return shooting_->cut() && state.at[kApproachSpeed] < kGrazingSpeed && state.tangent[kApproachSpeed] < 0.0;
}

double Continuation::longest_step(const State& from) const {
  // Towards a grazing at the cut, step by step to a third of the approach speed.
  const double falls = -from.tangent[kApproachSpeed];
  return shooting_->cut() && falls > 0.0 ? 0.7 * from.at[kApproachSpeed] / falls
                                         : std::numeric_limits<double>::infinity();
}

double Continuation::uncertainty(const State& a, const State& b) const {
  return std::abs(shooting_->quantity(a.at, 0) - shooting_->quantity(b.at, 0));
}

void Continuation::locate(const State& from, const State& to, double length, std::vector<Event>& events) {
  const auto find = [&](EventKind kind, auto value) {
    const double at_start = value(from);
    const double at_end = value(to);
    if (!(at_start * at_end < 0.0)) return;
    State found = from;
    const auto at_length = [&](double part) {
      const auto there = advance(from, part);
      if (!there) return std::numeric_limits<double>::quiet_NaN();
      found = *there;
      return value(*there);
    };
    // Across a grazing multipliers jump, and no zero lies between.
    double low = 0.0;
    double high = length;
    double value_low = at_start;
    double value_high = at_end;
    State state_low = from;
    State state_high = to;
    for (int i = 0; i < 200 && high - low > 1e-12; ++i) {
      double part =
          i % 2 == 0 ? (low * value_high - high * value_low) / (value_high - value_low) : 0.5 * (low + high);
      part = std::clamp(part, low + 1e-3 * (high - low), high - 1e-3 * (high - low));
      const double there = at_length(part);
      if (!std::isfinite(there)) return;
      const bool before = there * at_start > 0.0;
      (before ? low : high) = part;
      (before ? value_low : value_high) = there;
      (before ? state_low : state_high) = found;
      if (std::abs(there) < 1e-13 * (std::abs(at_start) + std::abs(at_end))) break;
    }
    if (kind == EventKind::neimark_sacker) {
      // μi μj = 1 holds for a real pair, too, which is no bifurcation.
      const auto& multipliers = found.orbit.multipliers;
      const bool on_circle = std::ranges::any_of(multipliers, [](const std::complex<double>& multiplier) {
        return std::abs(multiplier.imag()) > 1e-6 && std::abs(std::abs(multiplier) - 1.0) < 1e-4;
      });
      if (!on_circle) return;
    }
    // A change of sign without a zero is a jump of the multipliers at a grazing.
    if (std::abs(value_high - value_low) > 0.1 * std::abs(at_end - at_start)) return;
    events.push_back({kind, found.orbit, observables::GrazingSide::none, uncertainty(state_low, state_high)});
  };
  find(EventKind::fold, [](const State& state) { return state.tangent[4]; });
  for (const EventKind kind : {EventKind::period_doubling, EventKind::neimark_sacker})
    find(kind, [kind](const State& state) { return test_function(kind, state.orbit); });
}

std::optional<Continuation::Grazing> Continuation::locate_grazing(const State& from, double length) {
  if (vanishes(from)) return Grazing{at_grazing_touch(from), std::nullopt, 0.0};
  double reached = 0.0;
  double beyond = length;
  State last = from;
  std::optional<State> first_beyond;
  for (int i = 0; i < 60 && beyond - reached > 1e-13; ++i) {
    const double part = 0.5 * (reached + beyond);
    auto there = advance(from, part);
    if (there && same_touches(there->orbit, from.orbit)) {
      reached = part;
      last = std::move(*there);
    } else {
      beyond = part;
      first_beyond = std::move(there);
    }
  }
  // Two orbits that are not the same branch's tell nothing of what is between them.
  if (first_beyond && !((first_beyond->at - last.at).norm() < kSame)) return std::nullopt;
  Event event{EventKind::grazing, last.orbit};
  double nearest = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Orbit& orbit) {
    const auto take = [&](double distance, double side) {
      if (!(distance < nearest)) return;
      nearest = distance;
      event.side = side > 0.0 ? observables::GrazingSide::approaching : observables::GrazingSide::receding;
    };
    if (orbit.map.nearest_pass) take(orbit.map.nearest_pass->miss, orbit.map.nearest_pass->side);
    take(orbit.map.lightest_touch, orbit.map.lightest_side);
  };
  consider(last.orbit);
  if (first_beyond) consider(first_beyond->orbit);
  if (!(nearest < kGrazes * shooting_->length())) return std::nullopt;
  event.uncertainty =
      first_beyond ? uncertainty(last, *first_beyond) : (beyond - reached) * shooting_->varied()[0].scale;
  extrapolate(last, event);
  return Grazing{std::move(event), std::move(first_beyond), beyond};
}

void Continuation::extrapolate(const State& last, Event& event) {
  constexpr double kBack = 1e-5;  // arclength over which the miss is straight
  const auto miss = [](const State& state) {
    return state.orbit.map.nearest_pass ? state.orbit.map.nearest_pass->miss
                                        : std::numeric_limits<double>::quiet_NaN();
  };
  const auto before = advance(last, -kBack);
  if (!before || !same_touches(before->orbit, last.orbit)) return;
  const double change =
      miss(last) / (miss(*before) - miss(last)) * (last.orbit.quantities[0] - before->orbit.quantities[0]);
  if (!(std::abs(change) < kBack * shooting_->varied()[0].scale)) return;
  event.orbit.quantities[0] += change;
  event.uncertainty = std::max(event.uncertainty, std::abs(change));
}

Event Continuation::at_grazing_touch(const State& from) {
  // The contact vanishes where the approach speed does, and the branch is nearly straight up to there.
  const auto vanishing_at = [&](const State& state) {
    const double way = -state.at[kApproachSpeed] / state.tangent[kApproachSpeed];
    return (state.at[4] + way * state.tangent[4]) * shooting_->varied()[0].scale;
  };
  Event event{EventKind::grazing, from.orbit,
              from.orbit.map.lightest_side > 0.0 ? observables::GrazingSide::approaching
                                                 : observables::GrazingSide::receding};
  const double value = vanishing_at(from);
  const auto nearer = advance(from, longest_step(from));
  event.uncertainty = std::abs(value - (nearer ? vanishing_at(*nearer) : from.orbit.quantities[0]));
  event.orbit.quantities[0] = value;
  return event;
}

std::optional<Continuation::State> Continuation::with_touch(const Event& grazing) {
  const point::SectionMap& map = grazing.orbit.map;
  const bool touches =
      map.lightest_place && !(map.nearest_pass && map.nearest_pass->miss < map.lightest_touch);
  const auto& place = touches ? map.lightest_place : map.nearest_place;
  if (!place) return std::nullopt;
  Unknowns along = Unknowns::Zero(shooting_->size());
  along[kApproachSpeed] = touches ? -1.0 : 1.0;
  Unknowns at = shooting_->scaled(*place, grazing.orbit.quantities);
  const std::vector<int> periods = shooting_->passings_of_periods();
  for (const double speed : {1e-4, 3e-5}) {
    if (!touches) at[kApproachSpeed] = speed;
    for (const int passings : periods) {
      shooting_->cut_at({place->blade, place->revolution, passings});
      // Blades that are alike may touch one after the other: a shorter part of the orbit closes in itself
      // then.
      if (passings < periods.back()) {
        const auto orbit = shooting_->orbit(at);
        if (!orbit || orbit->mismatch.norm() > kNearlyClosed) continue;
      }
      if (auto state = correct(at, along); state && state->orbit.admissible) return state;
    }
    if (touches) break;
  }
  return std::nullopt;
}

std::optional<Continuation::State> Continuation::without_touch(const Event& grazing, const State& before) {
  const std::ptrdiff_t remaining = before.orbit.cuts * (touches(before.orbit) - 1);
  shooting_->cut_at_section();
  Unknowns along = Unknowns::Zero(shooting_->size());
  for (const double distance : {1e-6, 1e-5, 1e-4}) {
    for (const double direction : {-1.0, 1.0}) {
      Unknowns at = shooting_->scaled(before.orbit.section, grazing.orbit.quantities);
      at[4] += direction * distance;
      along[4] = direction;
      if (auto state = correct(at, along); state && touches(state->orbit) == remaining) return state;
    }
  }
  return std::nullopt;
}

namespace {

/// An orbit of a curve, with the direction in which the curve goes on.
struct OnCurve {
  Unknowns at;
  Orbit orbit;
  Unknowns tangent;
};

class Curve {
 public:
  Curve(Shooting& shooting, EventKind kind) : shooting_(&shooting), kind_(kind) {}

  /// Newton's method on the orbit's equations and the test function, within the plane normal to `tangent`.
  std::optional<OnCurve> correct(const Unknowns& predicted, const Unknowns& tangent) {
    Unknowns at = predicted;
    for (iterations_ = 0; iterations_ < kMostIterations; ++iterations_) {
      const auto orbit = shooting_->orbit(at);
      if (!orbit) return std::nullopt;
      const auto rows = derivative(at, *orbit);
      if (!rows) return std::nullopt;
      Eigen::VectorXd values(5);
      values << orbit->mismatch, test_function(kind_, *orbit);
      const Unknowns step = newton_step(*rows, values, tangent);
      if (!step.allFinite() || step.norm() > 1.0) return std::nullopt;
      if (shooting_->closes(at, *orbit) && step.norm() <= kLastStep)
        return OnCurve{at, *orbit, null_direction(*rows, tangent)};
      at += step;
    }
    return std::nullopt;
  }
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  static constexpr double kStep = 1e-6;      ///< of the differences of the test function, scaled
  static constexpr double kLastStep = 1e-8;  ///< of Newton's method: what differences leave

  std::optional<Wide> derivative(const Unknowns& at, const Orbit& orbit) {
    const auto closing = shooting_->derivative(at, orbit);
    if (!closing) return std::nullopt;
    Wide rows(5, shooting_->size());
    rows.topRows(4) = *closing;
    for (Eigen::Index column = 0; column < shooting_->size(); ++column) {
      double difference = 0.0;
      for (const double side : {-1.0, 1.0}) {
        Unknowns moved = at;
        moved[column] += side * kStep;
        const auto there = shooting_->orbit(moved);
        if (!there) return std::nullopt;
        difference += side * test_function(kind_, *there);
      }
      rows(4, column) = difference / (2.0 * kStep);
    }
    return rows;
  }

  Shooting* shooting_;
  EventKind kind_;
  int iterations_ = 0;
};

}  // namespace

std::vector<Orbit> follow_curve(Shooting& shooting, EventKind kind, const Orbit& from, std::size_t most,
                                const OnOrbit& on_orbit) {
  shooting.set_period(from.period);
  shooting.cut_at_section();
  Curve curve(shooting, kind);
  Unknowns along = Unknowns::Zero(shooting.size());
  along[shooting.size() - 1] = 1.0;  // the second quantity grows at first
  const auto start = curve.correct(shooting.scaled(from.section, from.quantities), along);
  if (!start) return {};
  std::vector<Orbit> orbits{start->orbit};
  for (const double direction : {-1.0, 1.0}) {
    OnCurve state = *start;
    state.tangent *= direction;
    double length = kFirstStep;
    std::size_t count = 1;
    while (2 * count < most && length >= kShortestStep) {
      const auto next = curve.correct(state.at + length * state.tangent, state.tangent);
      if (!next || !(next->tangent.dot(state.tangent) > 0.9)) {
        length *= 0.5;
        continue;
      }
      if (!shooting.in_range(next->at)) break;
      state = *next;
      ++count;
      orbits.push_back(state.orbit);
      if (on_orbit) on_orbit(state.orbit);
      if (curve.iterations() <= kEasy) length = std::min(1.5 * length, kLongestOnCurve);
    }
    // From one end of the curve to the other.
    if (direction < 0.0) std::ranges::reverse(orbits);
  }
  return orbits;
}

}  // namespace rubatlas::branch
