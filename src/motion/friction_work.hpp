/// The work of friction at each tip over one revolution, from the pieces of its motion.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "modes/motion_listener.hpp"
#include "trajectory/motion_piece.hpp"
#include "trajectory/places_in_piece.hpp"

namespace rubatlas::motion {

/// A listener that adds up the work of friction and passes everything on to another listener.
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

}  // namespace rubatlas::motion
