#include "motion/changing_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace rubatlas::motion {

bool changes_between_revolutions(const settings::Scene& line) {
  using effects::Effects;
  return effects::acts<&Effects::wear>(line) || effects::acts<&Effects::speed_ramp>(line);
}

ChangingMotion::ChangingMotion(const settings::Scene& line, double speed_ratio, const Memory& memory,
                               const MakeMotion& make)
    : make_(&make), first_speed_(speed_ratio), speed_(speed_ratio) {
  if (effects::acts<&effects::Effects::wear>(line)) {
    wear_ = *line.wear;
    longest_loss_ = wear_->max_loss * line.blades.length;
    const auto blades = static_cast<std::size_t>(line.blades.count);
    const std::span<const double> before = wear_->carries_over ? memory.view() : std::span<const double>{};
    lost_.assign(blades, 0.0);
    std::copy_n(before.begin(), std::min(before.size(), blades), lost_.begin());
    lost_before_ = lost_;
    friction_work_.emplace(line.blades.count);
  }
  if (effects::acts<&effects::Effects::speed_ramp>(line)) ramp_ = *line.speed_ramp;
  motion_ = make(speed_, lost_);
}

ending::StatusDetail ChangingMotion::revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                                int number) {
  const ending::StatusDetail changed = change(listener, number);
  if (changed != ending::StatusDetail::none) return changed;
  if (!wear_) return motion_->revolution(listener, go_on, number);
  friction_work_->begin(listener);
  const ending::StatusDetail end = motion_->revolution(*friction_work_, go_on, number);
  return end == ending::StatusDetail::none ? wear_off() : end;
}

double ChangingMotion::clearance_growth() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < lost_.size(); ++k) largest = std::max(largest, lost_[k] - lost_before_[k]);
  return largest;
}

/// Makes a new motion for the next revolution and lets it take over, if speed or lengths have changed.
ending::StatusDetail ChangingMotion::change(modes::MotionListener& listener, int number) {
  const double speed = ramp_ ? ramp_->speed_ratio(first_speed_, number) : speed_;
  const bool faster = speed != speed_;
  if (!faster && !shorter_) return ending::StatusDetail::none;
  speed_ = speed;
  shorter_ = false;
  auto next = (*make_)(speed_, lost_);
  const ending::StatusDetail why = next->take_over(*motion_);
  motion_ = std::move(next);
  if (faster) listener.speed_changes(speed_);
  return why;
}

/// Takes off what the friction of the revolution has worn off; a blade that has lost too much ends the point.
ending::StatusDetail ChangingMotion::wear_off() {
  const std::span<const double> work = friction_work_->of_blades();
  for (std::size_t k = 0; k < lost_.size(); ++k) {
    const double loss = wear_->rate * work[k];
    if (loss > 0.0) shorter_ = true;
    lost_[k] += loss;
    if (lost_[k] > longest_loss_) return ending::StatusDetail::worn_out;
    if (!std::isfinite(loss)) return ending::StatusDetail::beyond_precision;
  }
  return ending::StatusDetail::none;
}

}  // namespace rubatlas::motion
