#include "point/settling.hpp"

#include <algorithm>
#include <complex>
#include <utility>

#include "integrate/decompositions.hpp"

namespace rubatlas::point {
namespace {

double distance(const Section& a, const Section& b) {
  return (a - b).lpNorm<Eigen::Infinity>();
}
double largest(const Eigen::VectorXcd& values) {
  return values.cwiseAbs().maxCoeff();
}

/// A multiplier nearer to the unit circle leaves open which way the motion goes.
constexpr double kLargestMultiplier = 0.999;

}  // namespace

void Settling::add(const Section& section, std::vector<std::int32_t> events) {
  revolutions_[count_++ % kKept] = {section, std::move(events)};
}

/// In each of the last revolutions the same blades touched as a period before.
bool Settling::same_events(std::size_t period, std::size_t revolutions) const {
  for (std::size_t i = 0; i < revolutions; ++i)
    if (back(i).events != back(i + period).events) return false;
  return true;
}

/// The smallest period in which the motion seems to approach a cycle; 0: it does not yet.
std::size_t Settling::period() const {
  constexpr double kNear =
      3e-3;  // of the clearance: farther away few motions are as nearly linear as is asked
  for (std::size_t period = 1; period <= longest_period_ && known() > 3 * period; ++period) {
    const double now = distance(back(0).section, back(period).section);
    const double before = distance(back(period).section, back(2 * period).section);
    if (now < kNear * scale_ && (now < before || now < error_) && same_events(period, 2 * period))
      return period;
  }
  return 0;
}

std::optional<std::vector<Section>> Settling::cycle(int left) {
  // A search costs as much as so many periods, and is worth it only where it may save more. Searches come at
  // ever longer intervals, so that a motion that never settles costs little more.
  constexpr std::size_t kCost = 12;
  constexpr int kMostDoublings = 10;
  if (count_ >= next_search_) {
    const std::size_t period = this->period();
    if (period > 0 && static_cast<std::size_t>(std::max(left, 0)) > kCost * period) {
      candidate_ = candidate(period);
      next_search_ = count_ + ((period + 3) << std::min(++searches_, kMostDoublings));
    }
  }
  if (!candidate_ || (count_ - candidate_->found) % candidate_->sections.size() != 0 ||
      !approaches(*candidate_))
    return std::nullopt;
  return std::move(candidate_->sections);
}

auto Settling::candidate(std::size_t period) const -> std::optional<Candidate> {
  constexpr int kMostSteps = 6;
  constexpr double kContraction = 0.25;  // of a step by the one before
  constexpr double kUncertainty = 4.0;   // error of J, over the part of a step that it leaves for the next
  const auto revolutions = static_cast<int>(period);
  const Section& start = back(period).section;
  std::vector<std::int32_t> events;
  for (std::size_t i = period; i-- > 0;)
    events.insert(events.end(), back(i).events.begin(), back(i).events.end());
  const auto turn_from = [&](const Section& from, bool derivative) {
    auto turn = return_from_(from, revolutions, derivative);
    const bool finite = !turn || (turn->sections.back().allFinite() && turn->jacobian.allFinite());
    if (!finite || (turn && turn->events != events)) turn.reset();
    return turn;
  };

  auto turn = turn_from(start, true);
  // A motion that starts anew from the section goes where the one that came from there has gone.
  if (!turn || distance(turn->sections.back(), back(0).section) > error_) return std::nullopt;
  Candidate result{{}, turn->jacobian, turn->nearest_grazing, count_};
  Section at = start;
  const Eigen::MatrixXd closing = Eigen::MatrixXd::Identity(start.size(), start.size()) - result.jacobian;
  double step = 0.0;
  double contraction = 0.0;
  for (int i = 0;; ++i) {
    const Section correction = integrate::solve(closing, turn->sections.back() - at);
    const double before = std::exchange(step, correction.lpNorm<Eigen::Infinity>());
    if (i > 0) {
      const double ratio = step / before;
      // Steps that are as small as the errors of sections need not fall.
      if (step < 0.1 * error_ || (step < error_ && ratio > kContraction)) break;
      contraction = std::max(contraction, ratio);
    }
    // A largest element is not seen where others are no numbers: J may have a multiplier 1.
    if (!correction.allFinite() || step > scale_ || contraction > kContraction || i == kMostSteps)
      return std::nullopt;
    at += correction;
    turn = turn_from(at, false);
    if (!turn) return std::nullopt;
  }
  result.sections.push_back(at);
  result.sections.insert(result.sections.end(), turn->sections.begin(), turn->sections.end() - 1);

  const auto largest_multiplier = [&] { return largest(integrate::eigen_modes(result.jacobian).values); };
  if (!(largest_multiplier() + kUncertainty * contraction < kLargestMultiplier)) {
    turn = turn_from(at, true);
    if (!turn) return std::nullopt;
    result.jacobian = turn->jacobian;
    result.nearest_grazing = turn->nearest_grazing;
    if (!(largest_multiplier() < kLargestMultiplier)) return std::nullopt;
  }
  return result;
}

bool Settling::approaches(const Candidate& candidate) const {
  constexpr double kShare = 0.5;       // of what J takes off a difference, that the map may differ from it by
  constexpr double kSize = 0.5;        // the difference has become so much of itself while that was seen
  constexpr std::size_t kReturns = 2;  // in as many returns at least
  constexpr double kOverRounding = 10.0;
  constexpr double kFromGrazing = 10.0;  // differences from the next touch-down that comes or goes
  constexpr std::size_t kOnCycle = 3;    // sections that differ by no more than their error
  const std::size_t period = candidate.sections.size();
  const Section& cycle = candidate.sections.front();
  if (candidate.nearest_grazing < kFromGrazing * distance(back(0).section, cycle)) return false;

  std::size_t on_cycle = 0;
  while (on_cycle < kOnCycle && distance(back(on_cycle * period).section, cycle) <= error_) ++on_cycle;
  if (on_cycle == kOnCycle) return true;

  const auto modes = integrate::eigen_modes(candidate.jacobian);
  const auto in_modes = [&](std::size_t revolutions) {
    return modes.coordinates(back(revolutions).section - cycle);
  };
  double rounding = 0.0;
  for (Eigen::Index i = 0; i < cycle.size(); ++i)
    rounding += error_ * largest(modes.coordinates(Section::Unit(cycle.size(), i)));
  const double taken_off = 1.0 - largest(modes.values);
  Eigen::VectorXcd after = in_modes(0);
  const double last = largest(after);
  for (std::size_t returns = 1; (returns + 1) * period < known(); ++returns) {
    if (!same_events(period, returns * period)) return false;
    const Eigen::VectorXcd before = in_modes(returns * period);
    const double differs = largest(after - modes.values.cwiseProduct(before));
    if (differs > kShare * taken_off * largest(before) + rounding) return false;
    if (returns >= kReturns && largest(before) > kOverRounding * rounding && last <= kSize * largest(before))
      return true;
    after = before;
  }
  return false;
}

}  // namespace rubatlas::point
