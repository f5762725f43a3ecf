/// Mode: blades in contact, by collocation (`collocation/contact_arc.hpp`), whether their tips slip, rest or
/// skim. Where no interval can be made, the point ends as `step_too_short`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "collocation/contact_arc.hpp"
#include "collocation/law.hpp"
#include "modes/motion_listener.hpp"
#include "modes/phase.hpp"
#include "modes/work_meter.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {

/// One phase for all contacts of a motion.
class Collocated final : public Phase, public ContactPhases {
 public:
  explicit Collocated(const ContactSetup& setup)
      : setup_(setup),
        law_(setup.law),
        arc_(*setup.machine, *setup.law, setup.limits.tolerance, setup.limits.max_shortening) {}

  ending::StatusDetail start(double time, const rotor::ShaftAndRing& state,
                             const std::vector<OpenContact>& contacts) override;

  ModeEnd advance(double until, MotionListener& listener) override;
  void shift_time(double period) override;

  void hand_over(double& time, rotor::ShaftAndRing& bodies, std::vector<OpenContact>& contacts) override;
  Phase& of(const std::vector<OpenContact>& /*contacts*/) override { return *this; }
  void each(const std::function<void(const Phase&)>& use) const override { use(*this); }

  // The piece of motion that is being recorded.
  [[nodiscard]] double begin() const override { return piece_begin_; }
  [[nodiscard]] double end() const override { return piece_end_; }
  [[nodiscard]] trajectory::State state(double time) override {
    pay_for_reading();
    return rotor::as_array(rotor::shaft(arc_.solved_at(time).bodies));
  }
  void places(const trajectory::SampleTimes& times, int first, std::span<double> x,
              std::span<double> y) override;
  [[nodiscard]] double displacement_bound() const override { return arc_.displacement_bound(); }
  [[nodiscard]] double largest_displacement(double known, double speed_ratio) override;
  [[nodiscard]] std::size_t contact_count() const override { return contacts_.size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return contacts_[contact].blade; }
  [[nodiscard]] bool load_peaks(std::size_t /*contact*/) const override { return true; }
  [[nodiscard]] LargestLoad largest(trajectory::Load load, std::size_t contact, double known) override;
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, double time) override;
  [[nodiscard]] trajectory::Tip tip(int blade, double time) override;
  [[nodiscard]] std::optional<trajectory::Pass> nearest_pass(
      double known, const trajectory::PointConstants& point) override;
  [[nodiscard]] trajectory::Tip deepest(std::size_t contact, double enough) override;
  void path(double share, trajectory::PathPoint& point,
            std::vector<trajectory::ContactForce>* forces) override;
  bool solved_places(bool with_forces, const trajectory::VisitPlace& visit) override;
  bool solved_rubs(const trajectory::VisitRub& visit) override;

  /// Right-hand sides: one at each node in each sweep.
  [[nodiscard]] std::uint64_t evaluations() const override { return collocation::kNodes * arc_.sweeps(); }
  [[nodiscard]] std::uint64_t steps() const override { return arc_.intervals(); }
  [[nodiscard]] std::uint64_t rejected() const override { return arc_.rejected(); }

 private:
  using Point = collocation::ContactArc::Point;
  /// Price of an interval.
  [[nodiscard]] std::int64_t price() const {
    return WorkPrice::kAttempt + static_cast<std::int64_t>(contacts_.size()) * WorkPrice::kForce;
  }
  /// Pays for what a listener asks: a place in an interval with its tangents, or all its nodes, take half as
  /// long as the interval.
  void pay_for_reading() { setup_.meter->spend(Work::contact, price() / 2); }
  /// The arc has come to what ends it.
  [[nodiscard]] bool is_at_event() const {
    return arc_.ending().guard != collocation::ContactArc::Guard::none;
  }
  [[nodiscard]] ModeEnd end_of_arc() const;
  [[nodiscard]] trajectory::Tip tip(int blade, const Point& point) const;
  /// The piece is an interval, and not a part of one.
  [[nodiscard]] bool is_whole() const {
    return piece_begin_ == arc_.start().time && piece_end_ == arc_.end().time;
  }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, const Point& point) const {
    return contact_force(contact, point, arc_.direction(blade(contact), point.time));
  }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, const Point& point,
                                                       const contact::BladeDirection& er) const;

  [[nodiscard]] double angular_speed(double time) const { return setup_.machine->blades.angular_speed(time); }

  ContactSetup setup_;
  const Law* law_;
  collocation::ContactArc arc_;
  std::vector<OpenContact> contacts_;  ///< where they began
  std::optional<ModeEnd> at_once_;     ///< one of the blades does not stand where they begin
  bool pending_ = false;               ///< an interval has been made and not been recorded to its end
  std::vector<trajectory::ContactForce> forces_at_node_;
  double piece_begin_ = 0.0;
  double piece_end_ = 0.0;
  /// θ of both, once they are asked for.
  struct Stretch {
    double from, to;
  };
  std::optional<Stretch> piece_stretch_;
};

}  // namespace rubatlas::modes
