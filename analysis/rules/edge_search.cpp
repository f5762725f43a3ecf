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

std::vector<EdgeSearch::Change> EdgeSearch::changes() const {
  std::vector<Change> found;
  std::size_t before = 0;
  for (std::size_t i = 1; i < tried_.size(); ++i) {
    if (tried_[i].motion == motion_class::kUnresolved) continue;
    if (tried_[i].motion != tried_[before].motion) found.push_back({before, i});
    before = i;
  }
  return found;
}

bool EdgeSearch::alternates(std::span<const Change> changes) const {
  return std::ranges::any_of(changes, [&](const Change& change) {
    const auto motion = tried_[change.far].motion;
    return std::ranges::any_of(changes, [&](const Change& other) {
      return other.near < change.far && tried_[other.near].motion == motion;
    });
  });
}

std::vector<std::size_t> EdgeSearch::intervals() const {
  std::vector<std::size_t> sides;
  if (has_lost_its_end()) return sides;
  const auto all = changes();
  if (alternates(all)) return {all.front().near, all.back().far - 1};
  for (const auto& [near, far] : all) {
    sides.push_back(near);
    if (far != near + 1) sides.push_back(far - 1);
  }
  return sides;
}

double EdgeSearch::length(std::size_t near) const {
  return std::abs(tried_[near + 1].speed_ratio - tried_[near].speed_ratio);
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
  const bool ascending = is_ascending();
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

FoundEdge EdgeSearch::edge_between(std::size_t near, std::size_t far, EdgeOutcome outcome) const {
  return {tried_[near].speed_ratio, tried_[far].speed_ratio, tried_[near].motion, tried_[far].motion,
          outcome};
}

FoundEdge EdgeSearch::last_edge(std::span<const Change> changes) const {
  const std::size_t last = tried_.size() - 1;
  std::size_t near = changes.empty() ? last : changes.front().near;
  while (tried_[near].motion != tried_.front().motion) --near;
  const bool is_unresolved = tried_[last].motion == motion_class::kUnresolved;
  const auto outcome = is_unresolved ? EdgeOutcome::slow : EdgeOutcome::overrun;
  auto edge = edge_between(near, last, outcome);
  edge.far_motion = last_motion_;
  return edge;
}

std::vector<FoundEdge> EdgeSearch::edges() const {
  const auto all = changes();
  if (has_lost_its_end()) {
    return {last_edge(all)};
  }
  const auto sides = intervals();
  const bool is_narrow =
      std::ranges::all_of(sides, [&](std::size_t near) { return length(near) <= resolution_; });
  if (alternates(all) || !is_narrow) {
    return {edge_between(all.front().near, all.back().far, EdgeOutcome::divided)};
  }
  std::vector<FoundEdge> edges;
  edges.reserve(all.size());
  for (const auto& [near, far] : all) {
    edges.push_back(edge_between(near, far, far == near + 1 ? EdgeOutcome::sharp : EdgeOutcome::slow));
  }
  return edges;
}

std::size_t EdgeSearch::expected_points() const {
  std::size_t expected = 0;
  if (points() >= kMostPoints) return expected;
  for (const std::size_t place : intervals()) {
    double left = length(place);
    while (left > resolution_) {
      expected += kDivision - 1;
      left /= static_cast<double>(kDivision);
    }
  }
  return expected;
}

}  // namespace rubatlas::analysis
