#include "mpi/job/cost_model.hpp"

namespace rubatlas::mpi {

CostModel::CostModel(std::size_t speed_count)
    : seconds_(speed_count, 0.0), count_(speed_count, 0), cumulated_(speed_count + 1, 0.0) {}

void CostModel::record(std::size_t speed_index, double seconds) {
  seconds_[speed_index] += seconds;
  ++count_[speed_index];
  total_seconds_ += seconds;
  ++total_count_;
  stale_ = true;
}

double CostModel::expected(std::size_t first, std::size_t last) const {
  if (stale_) refresh();
  return cumulated_[last] - cumulated_[first];
}

void CostModel::refresh() const {
  const double mean = total_seconds_ > 0.0 ? total_seconds_ / static_cast<double>(total_count_) : 1.0;
  for (std::size_t i = 0; i < seconds_.size(); ++i) {
    const double cost = count_[i] > 0 ? seconds_[i] / static_cast<double>(count_[i]) : mean;
    cumulated_[i + 1] = cumulated_[i] + cost;
  }
  stale_ = false;
}

}  // namespace rubatlas::mpi
