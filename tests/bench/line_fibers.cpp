#include "line_fibers.hpp"

#include <boost/context/fixedsize_stack.hpp>

namespace rubatlas::bench {

LineFibers* LineFibers::current = nullptr;

namespace {
constexpr std::size_t kStackBytes = 256 * 1024;
constexpr std::size_t kMostLanes = 8;
}  // namespace

LineFibers::LineFibers(std::size_t alive, std::size_t fewest) : alive_(alive), fewest_(fewest) {}

LaneCounts LineFibers::run(const std::vector<std::function<void()>>& lines) {
  current = this;
  counts_ = {};
  std::size_t next_line = 0;
  const auto start_next = [&](Line& line) {
    start(lines[next_line++], line);
    ready_.push_back(&line);
  };
  while (lines_.size() < alive_ && next_line < lines.size()) {
    lines_.push_back(std::make_unique<Line>());
    start_next(*lines_.back());
  }
  while (next_ready_ < ready_.size() || !requests_.empty()) {
    if (next_ready_ == ready_.size() || requests_.size() == kMostLanes) make_requests();
    running_ = ready_[next_ready_++];
    running_->fiber = std::move(running_->fiber).resume();
    if (!running_->fiber && next_line < lines.size()) start_next(*running_);
  }
  lines_.clear();
  return counts_;
}

void LineFibers::start(const std::function<void()>& work, Line& line) {
  line.fiber = boost::context::fiber(std::allocator_arg, boost::context::fixedsize_stack(kStackBytes),
                                     [this, &work](boost::context::fiber&& caller) {
                                       caller_ = std::move(caller);
                                       work();
                                       return std::move(caller_);
                                     });
}

bool LineFibers::attempt(LaneSystem& system, LaneStep& step, double size) {
  Line* const self = running_;
  requests_.push_back({&system, &step, size});
  askers_.push_back(self);
  caller_ = std::move(caller_).resume();
  return self->attempted;
}

void LineFibers::make_requests() {
  const std::size_t count = requests_.size();
  const auto make = [&](auto& lanes) {
    lanes.pack(requests_);
    lanes.attempt();
    const auto made = lanes.unpack();
    for (std::size_t i = 0; i < count; ++i) askers_[i]->attempted = made[i];
    ++counts_.batches;
    counts_.in_lanes += count;
  };
  if (count < fewest_) {
    for (std::size_t i = 0; i < count; ++i) {
      askers_[i]->attempted = requests_[i].step->attempt(*requests_[i].system, requests_[i].size);
    }
    counts_.alone += count;
  } else if (count <= 4) {
    make(*four_);
  } else {
    make(*eight_);
  }
  // Those who wait already go on first.
  ready_.erase(ready_.begin(), ready_.begin() + static_cast<std::ptrdiff_t>(next_ready_));
  next_ready_ = 0;
  ready_.insert(ready_.end(), askers_.begin(), askers_.end());
  requests_.clear();
  askers_.clear();
}

}  // namespace rubatlas::bench
