#include "analysis/rules/edge_search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/rules/class.hpp"

namespace rubatlas::analysis {
namespace {

/// A round divides an interval into so many.
constexpr std::size_t kDivision = 4;

}  // namespace

EdgeSearch::EdgeSearch(std::span<const double> speed_ratio, std::span<const std::uint8_t> motion,
                       double resolution, bool swept)
    : resolution_(resolution), swept_(swept), given_(speed_ratio.size()), count_(speed_ratio.size()) {
  if (given_ < 2 || motion.size() != given_ || motion.front() == motion.back() || !(resolution > 0.0)) {
    throw std::invalid_argument("an edge lies between two speeds with different motions");
  }
  for (std::size_t i = 0; i < given_; ++i) {
    tried_.push_back({speed_ratio[i], motion[i], i, i == 0 ? i : i - 1});
  }
  last_motion_ = motion.back();
}

std::size_t EdgeSearch::last_of_first() const {
  std::size_t place = 0;
  while (place + 1 < tried_.size() && tried_[place + 1].motion == tried_.front().motion) ++place;
  return place;
}

std::size_t EdgeSearch::first_of_last() const {
  std::size_t place = tried_.size() - 1;
  while (place > 0 && tried_[place].motion == last_motion_ && tried_[place - 1].motion == last_motion_)
    --place;
  return place;
}

std::vector<std::size_t> EdgeSearch::intervals() const {
  if (tried_.back().motion != last_motion_) return {};  // nothing between is the edge that was looked for
  const std::size_t near = last_of_first();
  const std::size_t far = first_of_last() - 1;
  return near == far ? std::vector{near} : std::vector{near, far};
}

double EdgeSearch::length(std::size_t near_side) const {
  return std::abs(tried_[near_side + 1].speed_ratio - tried_[near_side].speed_ratio);
}

std::vector<EdgeRequest> EdgeSearch::next() const {
  std::vector<EdgeRequest> requests;
  if (points() >= kMostPoints) return requests;
  const auto all = intervals();
  for (const std::size_t place : all) {
    if (length(place) <= resolution_) continue;
    const double near = tried_[place].speed_ratio;
    const double step = (tried_[place + 1].speed_ratio - near) / static_cast<double>(kDivision);
    for (std::size_t i = 1; i < kDivision; ++i) {
      requests.push_back({near + step * static_cast<double>(i), tried_[place].number});
    }
  }
  if (!requests.empty() || !swept_) return requests;
  for (const std::size_t place : all) {
    const Tried& far = tried_[place + 1];
    if (far.from != tried_[place].number) requests.push_back({far.speed_ratio, tried_[place].number});
  }
  return requests;
}

void EdgeSearch::take(std::span<const std::uint8_t> motion) {
  const auto requests = next();
  if (motion.size() != requests.size()) throw std::invalid_argument("a round has one class for each point");
  const bool ascending = tried_.back().speed_ratio > tried_.front().speed_ratio;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const Tried found{requests[i].speed_ratio, motion[i], count_++, requests[i].from};
    const auto place = std::ranges::find_if(tried_, [&](const Tried& tried) {
      return ascending ? tried.speed_ratio >= found.speed_ratio : tried.speed_ratio <= found.speed_ratio;
    });
    if (place->speed_ratio == found.speed_ratio) {  // tried once more
      *place = found;
    } else {
      tried_.insert(place, found);
    }
  }
}

EdgeOutcome EdgeSearch::outcome() const {
  if (tried_.back().motion != last_motion_) {
    return tried_.back().motion == tried_.front().motion ? EdgeOutcome::overrun : EdgeOutcome::divided;
  }
  const std::size_t first = last_of_first() + 1;
  const std::size_t end = first_of_last();
  if (first == end) return length(first - 1) <= resolution_ ? EdgeOutcome::sharp : EdgeOutcome::divided;
  const auto between = std::span(tried_).subspan(first, end - first);
  const bool all_unresolved = std::ranges::all_of(
      between, [](const Tried& tried) { return tried.motion == motion_class::kUnresolved; });
  return all_unresolved ? EdgeOutcome::slow : EdgeOutcome::divided;
}

std::size_t EdgeSearch::expected_points() const {
  std::size_t expected = 0;
  if (points() >= kMostPoints) return expected;
  for (const std::size_t place : intervals()) {
    for (double left = length(place); left > resolution_; left /= static_cast<double>(kDivision)) {
      expected += kDivision - 1;
    }
  }
  return expected;
}

}  // namespace rubatlas::analysis
