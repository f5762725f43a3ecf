/// A motion whose machine changes from revolution to revolution: blades that wear, a speed that ramps.
///
/// Both have one mechanism. Within a revolution the machine does not change, and the motion is that of any
/// other rotor. Between two revolutions a motion with the new speed and lengths takes over the state and the
/// contacts. Where nothing has changed the old motion goes on.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "modes/motion_listener.hpp"
#include "motion/point_motion.hpp"
#include "settings/effects/list.hpp"
#include "settings/scene.hpp"
#include "trajectory/motion_piece.hpp"
#include "trajectory/places_in_piece.hpp"

namespace rubatlas::motion {

/// The work of friction at each tip over one revolution, from the pieces of its motion: a listener that
/// passes everything on to another listener.
class FrictionWork final : public modes::MotionListener {
 public:
  explicit FrictionWork(int blade_count) : work_(static_cast<std::size_t>(blade_count), 0.0) {}

  /// Starts a revolution that `listener` follows.
  void begin(modes::MotionListener& listener) {
    listener_ = &listener;
    work_.assign(work_.size(), 0.0);
  }
  /// W of each blade since `begin` [J].
  [[nodiscard]] std::span<const double> of_blades() const { return work_; }

  void piece(trajectory::MotionPiece& piece) override {
    listener_->piece(piece);
    places_.rubs(piece, [&](const trajectory::Rub& rub) {
      work_[static_cast<std::size_t>(piece.blade(rub.contact))] += std::abs(rub.weight * rub.friction_power);
    });
  }
  void event(const modes::Event& event) override { listener_->event(event); }
  void speed_changes(double speed_ratio) override { listener_->speed_changes(speed_ratio); }

 private:
  modes::MotionListener* listener_ = nullptr;
  std::vector<double> work_;
  trajectory::PlacesInPiece places_;
};

/// The scene has an effect that changes the machine between revolutions.
bool changes_between_revolutions(const settings::Scene& line);

class ChangingMotion final : public PointMotion {
 public:
  /// `make` outlives the motion. `memory`: lengths lost before the point, one a blade; empty for new blades.
  ChangingMotion(const settings::Scene& line, double speed_ratio, const Memory& memory,
                 const MakeMotion& make);

  ending::StatusDetail start(const PointStart& start) override { return motion_->start(start); }
  ending::StatusDetail revolution(modes::MotionListener& listener, const modes::GoOn& go_on,
                                  int number) override;

  [[nodiscard]] rotor::ShaftAndRing state() const override { return motion_->state(); }
  /// The length that each blade has lost [m].
  [[nodiscard]] Memory memory() const override { return Memory(lost_); }
  [[nodiscard]] double clearance_growth() const override;
  [[nodiscard]] WorkCounts work() const override { return motion_->work(); }

 private:
  ending::StatusDetail change(modes::MotionListener& listener, int number);
  ending::StatusDetail wear_off();

  const MakeMotion* make_;
  double first_speed_;  ///< Ω of the transient and the first sampled revolution
  double speed_;        ///< Ω now
  std::optional<effects::SpeedRamp> ramp_;
  std::optional<effects::Wear> wear_;
  std::vector<double> lost_;         ///< of each blade [m]; empty where no blade wears
  std::vector<double> lost_before_;  ///< when the point started
  double longest_loss_ = 0.0;        ///< [m]
  bool shorter_ = false;             ///< a blade has lost length in the last revolution
  std::optional<FrictionWork> friction_work_;
  std::unique_ptr<PointMotion> motion_;
};

}  // namespace rubatlas::motion
