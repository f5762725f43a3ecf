#include "modes/work_meter.hpp"

#include <algorithm>
#include <numeric>

namespace rubatlas::modes {
namespace {

/// Work between two checks: far less than a user notices, far more than a check costs.
constexpr std::int64_t kBetweenLooks = 2'000'000;

}  // namespace

void WorkMeter::begin_revolution(const GoOn& go_on) {
  spent_before_ = total();
  spent_.fill(0);
  ++revolutions_;
  const std::int64_t of_point = std::max(bound_->point, revolutions_ * bound_->of_each_revolution);
  allowed_ = std::min(bound_->revolution, of_point - spent_before_);
  until_look_ = kBetweenLooks;
  go_on_ = &go_on;
  why_ = ending::StatusDetail::none;
}

std::int64_t WorkMeter::total() const {
  return std::accumulate(spent_.begin(), spent_.end(), spent_before_);
}

bool WorkMeter::look() {
  constexpr std::array kDetails{ending::StatusDetail::contact_work, ending::StatusDetail::flight_work,
                                ending::StatusDetail::event_work};
  if (ended()) return false;
  if (total() - spent_before_ > allowed_) {
    const auto most = std::max_element(spent_.begin(), spent_.end()) - spent_.begin();
    why_ = kDetails[static_cast<std::size_t>(most)];
  } else if (go_on_ != nullptr && *go_on_ && !(*go_on_)()) {
    why_ = ending::StatusDetail::given_up;
  }
  if (ended()) return false;
  until_look_ = kBetweenLooks;
  return true;
}

}  // namespace rubatlas::modes
