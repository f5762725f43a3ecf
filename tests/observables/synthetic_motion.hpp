/// Motions that are known exactly, cut into pieces as an integrator would.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "observables/observable.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::observables {

/// A contact of a piece: blade, normal force and root strain over the time since the revolution started.
struct SyntheticContact {
  int blade = 0;
  std::function<double(double)> force;
  std::function<double(double)> strain;
  bool peaks = true;  ///< the load rises and falls again within the piece
  /// All that the force does; none: it pushes along x, and does not rub.
  std::function<trajectory::ContactForce(double)> action = nullptr;
};

class SyntheticPiece final : public trajectory::MotionPiece {
 public:
  SyntheticPiece(double begin, double end, std::function<trajectory::State(double)> motion,
                 std::vector<SyntheticContact> contacts = {},
                 double bound = std::numeric_limits<double>::infinity())
      : begin_(begin), end_(end), motion_(std::move(motion)), contacts_(std::move(contacts)), bound_(bound) {}

  [[nodiscard]] double begin() const override { return begin_; }
  [[nodiscard]] double end() const override { return end_; }
  [[nodiscard]] trajectory::State state(double time) override {
    ++states_;
    return motion_(time);
  }
  [[nodiscard]] double displacement_bound() const override { return bound_; }
  [[nodiscard]] std::size_t contact_count() const override { return contacts_.size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return contacts_[contact].blade; }
  [[nodiscard]] bool load_peaks(std::size_t contact) const override { return contacts_[contact].peaks; }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, double time) override {
    if (contacts_[contact].action) return contacts_[contact].action(time);
    const double force = contacts_[contact].force(time);
    return {-force, force, 0.0, 1.0, 0.0, 0.0, contacts_[contact].strain(time)};
  }
  [[nodiscard]] trajectory::Tip tip(int blade, double time) override {
    return tips_ ? tips_(blade, time) : trajectory::Tip{-1.0, 0.0, 0.0};
  }
  /// Gives the piece tips; without them none comes near the ring.
  void set_tips(std::function<trajectory::Tip(int, double)> tips) { tips_ = std::move(tips); }

  /// How often the motion was asked for.
  [[nodiscard]] int states() const { return states_; }

 private:
  double begin_;
  double end_;
  std::function<trajectory::State(double)> motion_;
  std::vector<SyntheticContact> contacts_;
  double bound_;
  std::function<trajectory::Tip(int, double)> tips_;
  int states_ = 0;
};

inline trajectory::PointConstants point_at(double speed_ratio, int blade_count) {
  return {2 * std::numbers::pi / speed_ratio, speed_ratio, blade_count};
}

/// Feeds whole revolutions of a motion in τ since the point started, each in uneven pieces.
inline void feed(Observable& observable, const trajectory::PointConstants& point, int revolutions,
                 const std::function<trajectory::State(double)>& motion) {
  observable.begin(point);
  for (int r = 0; r < revolutions; ++r) {
    const auto within = [&motion, &point, r](double time) { return motion(r * point.period + time); };
    double from = 0.0;
    for (const double part : {0.0713, 0.2, 1.0 / 3, 0.5, 0.501, 0.9, 1.0}) {
      SyntheticPiece piece(from, point.period * part, within);
      observable.piece(piece);
      from = point.period * part;
    }
    observable.revolution_ends(motion((r + 1) * point.period));
  }
}

}  // namespace rubatlas::observables
