/// Keeps a motion as uniform samples: what the command `orbit` shows.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "solve/line_solver.hpp"
#include "solve/motion_listener.hpp"

namespace rubatlas::solve {

class OrbitListener final : public MotionListener {
 public:
  OrbitListener(double period, int samples_per_revolution, int blade_count)
      : period_(period), samples_per_revolution_(samples_per_revolution), blade_count_(blade_count) {}

  void piece(observables::MotionPiece& piece) override {
    for (; sample_ < samples_per_revolution_; ++sample_) {
      const double time = period_ * sample_ / samples_per_revolution_;
      if (time >= piece.end()) return;
      orbit_.time.push_back(begin_ + (period_ * (revolution_ - since_) + time));
      orbit_.state.push_back(piece.state(time));
      const std::size_t first = orbit_.force.size();
      orbit_.force.resize(first + static_cast<std::size_t>(blade_count_), 0.0);
      for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
        orbit_.force[first + static_cast<std::size_t>(piece.blade(contact))] =
            piece.normal_force(contact, time);
      }
    }
  }

  void speed_changes(double speed_ratio) override {
    begin_ += period_ * (revolution_ - since_);
    since_ = revolution_;
    period_ = 2.0 * std::numbers::pi / std::abs(speed_ratio);
  }

  void revolution_ends(const SectionState& section) {
    orbit_.sections.push_back(section);
    sample_ = 0;
    ++revolution_;
  }

  [[nodiscard]] Orbit take() { return std::move(orbit_); }

 private:
  double period_;
  int samples_per_revolution_;
  int blade_count_;
  int sample_ = 0;  ///< next one within the revolution
  int revolution_ = 0;
  double begin_ = 0.0;  ///< τ when the revolution `since_` began, the first at the present speed
  int since_ = 0;
  Orbit orbit_;
};

}  // namespace rubatlas::solve
