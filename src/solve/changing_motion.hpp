/// A motion whose machine changes from revolution to revolution: blades that wear, a speed that ramps.
///
/// One mechanism for both. Within a revolution nothing changes, and the motion is that of any other rotor;
/// between two revolutions a motion with the new speed and lengths takes over the state and what is in
/// contact. Where nothing has changed the old one goes on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "effects/list.hpp"
#include "scene/scene.hpp"
#include "solve/friction_work.hpp"
#include "solve/line_solver.hpp"
#include "solve/motion_listener.hpp"
#include "solve/rotor.hpp"

namespace rubatlas::solve {

/// The scene has an effect that changes the machine between revolutions.
inline bool changes_between_revolutions(const scene::Scene& line) {
  using effects::Effects;
  return effects::acts<&Effects::wear>(line) || effects::acts<&Effects::speed_ramp>(line);
}

/// `make(speed_ratio, lost)` makes a motion: `lost` is the length that each blade has lost [m], empty where
/// no blade wears. With the interface of a motion.
template <class Make>
class ChangingMotion {
 public:
  /// `memory`: lengths lost before the point, one a blade; empty for new blades.
  ChangingMotion(const scene::Scene& line, double speed_ratio, const Memory& memory, Make make)
      : make_(std::move(make)),
        first_sampled_(line.protocol.transient_revolutions),
        first_speed_(speed_ratio),
        speed_(speed_ratio) {
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
    motion_ = make_(speed_, lost_);
  }

  PointStatus start(const State& state) { return motion_->start(state); }

  /// The revolution of this number, counted from 0 through the transient.
  PointStatus revolution(MotionListener& listener, const GoOn& go_on, int number) {
    const PointStatus status = change(listener, number);
    if (status != PointStatus::done) return status;
    if (!wear_) return motion_->revolution(listener, go_on);
    friction_work_->begin(listener);
    const PointStatus end = motion_->revolution(*friction_work_, go_on);
    return end == PointStatus::done ? wear_off() : end;
  }
  /// What ended the motion, where that is not done.
  [[nodiscard]] StatusDetail status_detail() const {
    return worn_out_ != StatusDetail::none ? worn_out_ : motion_->status_detail();
  }

  [[nodiscard]] State state() const { return motion_->state(); }
  [[nodiscard]] WorkCounts work() const {
    WorkCounts sum = work_;
    sum += motion_->work();
    sum.price = motion_->work().price;  // its meter has gone on with that of the motions before
    return sum;
  }
  /// What the next point is to know: the length that each blade has lost [m].
  [[nodiscard]] Memory memory() const { return Memory(lost_); }
  /// Largest growth of a blade's clearance since the point started [m].
  [[nodiscard]] double clearance_growth() const {
    double largest = 0.0;
    for (std::size_t k = 0; k < lost_.size(); ++k) largest = std::max(largest, lost_[k] - lost_before_[k]);
    return largest;
  }

 private:
  /// Lets the motion of the next revolution take over, if it is another.
  PointStatus change(MotionListener& listener, int number) {
    const double speed = ramp_ ? ramp_->speed_ratio(first_speed_, number - first_sampled_) : speed_;
    const bool faster = speed != speed_;
    if (!faster && !shorter_) return PointStatus::done;
    speed_ = speed;
    shorter_ = false;
    work_ += motion_->work();
    auto next = make_(speed_, lost_);
    const PointStatus status = next->take_over(motion_->hand_over());
    motion_ = std::move(next);
    if (faster) listener.speed_changes(speed_);
    return status;
  }

  /// What the revolution's friction has worn off is missing from now on.
  PointStatus wear_off() {
    const std::span<const double> work = friction_work_->of_blades();
    for (std::size_t k = 0; k < lost_.size(); ++k) {
      const double loss = wear_->rate * work[k];
      if (loss > 0.0) shorter_ = true;
      lost_[k] += loss;
      if (!std::isfinite(loss)) worn_out_ = StatusDetail::beyond_precision;
      if (lost_[k] > longest_loss_) worn_out_ = StatusDetail::worn_out;
      if (worn_out_ != StatusDetail::none) break;
    }
    return status_of(worn_out_);
  }

  Make make_;
  int first_sampled_;
  double first_speed_;  ///< Ω of the transient and the first sampled revolution
  double speed_;        ///< Ω now
  std::optional<effects::SpeedRamp> ramp_;
  std::optional<effects::Wear> wear_;
  std::vector<double> lost_;                    ///< of each blade [m]; empty where no blade wears
  std::vector<double> lost_before_;             ///< when the point started
  double longest_loss_ = 0.0;                   ///< [m]
  bool shorter_ = false;                        ///< a blade has lost length in the last revolution
  StatusDetail worn_out_ = StatusDetail::none;  ///< what wear ends the point with
  std::optional<FrictionWork> friction_work_;
  decltype(std::declval<Make>()(1.0, std::span<const double>{})) motion_;
  WorkCounts work_;  ///< of the motions before
};

}  // namespace rubatlas::solve
