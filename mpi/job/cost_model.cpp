#include "mpi/job/cost_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rubatlas::mpi {
namespace {

constexpr std::size_t kMostStretches = 64;

}  // namespace

CostModel::CostModel(std::size_t speed_count)
    : width_((speed_count + kMostStretches - 1) / kMostStretches),
      stretches_((speed_count + width_ - 1) / width_) {}

void CostModel::record(std::size_t speed_index, double seconds) {
  assume(speed_index, seconds);
  total_seconds_ += seconds;
}

void CostModel::assume(std::size_t speed_index, double seconds) {
  Stretch& stretch = stretches_[speed_index / width_];
  stretch.seconds += seconds;
  ++stretch.count;
  stale_ = true;
}

double CostModel::expected(std::size_t first, std::size_t last) const {
  if (stale_) refresh();
  return up_to(last) - up_to(first);
}

double CostModel::up_to(std::size_t speed_index) const {
  const std::size_t number = std::min(speed_index / width_, stretches_.size() - 1);
  const Stretch& stretch = stretches_[number];
  return stretch.cumulated + stretch.mean * static_cast<double>(speed_index - number * width_);
}

void CostModel::refresh() const {
  std::optional<std::size_t> measured;  // the last measured stretch
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    if (stretches_[i].count == 0) continue;
    const double mean = stretches_[i].seconds / static_cast<double>(stretches_[i].count);
    const std::size_t from = measured.value_or(i);
    const double before = measured ? stretches_[from].mean : mean;
    for (std::size_t between = measured ? from + 1 : 0; between < i; ++between) {
      stretches_[between].mean =
          measured
              ? std::lerp(before, mean, static_cast<double>(between - from) / static_cast<double>(i - from))
              : mean;
    }
    stretches_[i].mean = mean;
    measured = i;
  }
  if (measured) {
    for (std::size_t i = *measured + 1; i < stretches_.size(); ++i) {
      stretches_[i].mean = stretches_[*measured].mean;
    }
  }
  double cumulated = 0.0;
  for (Stretch& stretch : stretches_) {
    stretch.cumulated = cumulated;
    cumulated += stretch.mean * static_cast<double>(width_);
  }
  stale_ = false;
}

}  // namespace rubatlas::mpi
