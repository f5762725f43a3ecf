/// A motion whose machine changes from revolution to revolution: blades that wear, a speed that ramps.
///
/// One mechanism for both. Within a revolution nothing changes, and the motion is that of any other rotor;
/// between two revolutions a motion with the new speed and lengths takes over the state and what is in
/// contact. Where nothing has changed the old one goes on.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "effects/list.hpp"
#include "scene/scene.hpp"
#include "solve/friction_work.hpp"
#include "solve/point_motion.hpp"

namespace rubatlas::solve {

/// The scene has an effect that changes the machine between revolutions.
bool changes_between_revolutions(const scene::Scene& line);

class ChangingMotion final : public PointMotion {
 public:
  /// `make` outlives the motion. `memory`: lengths lost before the point, one a blade; empty for new blades.
  ChangingMotion(const scene::Scene& line, double speed_ratio, const Memory& memory, const MakeMotion& make);

  PointStatus start(const PointStart& start) override { return motion_->start(start); }
  PointStatus revolution(MotionListener& listener, const GoOn& go_on, int number) override;
  PointStatus take_over(PointMotion& before) override { return motion_->take_over(before); }

  [[nodiscard]] StatusDetail status_detail() const override {
    return worn_out_ != StatusDetail::none ? worn_out_ : motion_->status_detail();
  }
  [[nodiscard]] ShaftAndRing state() const override { return motion_->state(); }
  /// The length that each blade has lost [m].
  [[nodiscard]] Memory memory() const override { return Memory(lost_); }
  [[nodiscard]] double clearance_growth() const override;
  [[nodiscard]] WorkCounts work() const override;

 private:
  PointStatus change(MotionListener& listener, int number);
  PointStatus wear_off();

  const MakeMotion* make_;
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
  std::unique_ptr<PointMotion> motion_;
  WorkCounts work_;  ///< of the motions before
};

}  // namespace rubatlas::solve
