#include "solve/work_meter.hpp"

#include <algorithm>
#include <numeric>

namespace rubatlas::solve {
namespace {

/// Between two looks: far below what a user notices, far above what a look costs.
constexpr std::int64_t kBetweenLooks = 2'000'000;

}  // namespace

const std::int64_t WorkPrice::kAttempt = 1'500;
const std::int64_t WorkPrice::kForce = 1'500;
const std::int64_t WorkPrice::kCurve = 80;
const std::int64_t WorkPrice::kInclinedCurve = 500;
const std::int64_t WorkPrice::kGap = 400;
const std::int64_t WorkPrice::kEvent = 2'000;
const std::int64_t WorkPrice::kRevolution = 100'000'000;
const std::int64_t WorkPrice::kSteppedRevolution = 10'000'000'000;

void WorkMeter::begin_revolution(const GoOn& go_on) {
  spent_before_ = total();
  spent_.fill(0);
  until_look_ = kBetweenLooks;
  go_on_ = &go_on;
  why_ = StatusDetail::none;
}

std::int64_t WorkMeter::total() const {
  return std::accumulate(spent_.begin(), spent_.end(), spent_before_);
}

bool WorkMeter::look() {
  constexpr std::array kDetails{StatusDetail::contact_work, StatusDetail::flight_work,
                                StatusDetail::event_work};
  if (ended()) return false;
  if (total() - spent_before_ > allowed_) {
    const auto most = std::max_element(spent_.begin(), spent_.end()) - spent_.begin();
    why_ = kDetails[static_cast<std::size_t>(most)];
  } else if (go_on_ != nullptr && *go_on_ && !(*go_on_)()) {
    why_ = StatusDetail::given_up;
  }
  if (ended()) return false;
  until_look_ = kBetweenLooks;
  return true;
}

}  // namespace rubatlas::solve
