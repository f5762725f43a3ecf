// Mode: blades in contact, by collocation (`collocation/contact_arc.hpp`), whether their tips slip, rest or
// skim. Where no interval can be made, the point ends as `step_too_short`.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "collocation/contact_arc.hpp"
#include "modes/phase.hpp"
#include "modes/seen_tip.hpp"
#include "trajectory/motion_piece.hpp"

namespace rubatlas::modes {
namespace {

/// One phase for all contacts of a motion.
class Collocated final : public Phase, public ContactPhases {
 public:
  explicit Collocated(const ContactSetup& setup)
      : setup_(setup),
        law_(setup.law),
        arc_(*setup.machine, *setup.law, setup.limits.tolerance, setup.limits.max_shortening) {}

  ending::StatusDetail start(double time, const rotor::ShaftAndRing& state,
                             const std::vector<OpenContact>& contacts) override {
    using ending::StatusDetail;
    contacts_ = contacts;
    pending_ = false;
    const std::int64_t price_before = price_of_searches(*law_);
    at_once_.reset();
    for (OpenContact& open : contacts_) {
      const TipPlace at = arc_.tip_place(open.blade, {.time = time, .bodies = state, .bending = {}});
      if (const auto found = law_->in_equilibrium(open, at)) {
        open = *found;
        continue;
      }
      if (law_->is_free_at_once(open, at)) {
        at_once_ = {Guard::lift_off, open.blade};
      } else if (open.straight) {
        at_once_ = {Guard::pressed_in, open.blade};
      } else if (open.slip == 0.0) {
        at_once_ = {Guard::comes_loose, open.blade};
      } else if (open.bend.modulus != 0.0) {
        at_once_ = {Guard::snap, open.blade};
      } else {
        at_once_ = {Guard::left_validity, open.blade, StatusDetail::no_equilibrium};
      }
      break;
    }
    setup_.meter->spend(Work::contact, price_of_searches(*law_) - price_before);
    if (at_once_) return StatusDetail::none;
    arc_.begin(time, state, contacts_);
    return is_at_event() ? end_of_arc().why : StatusDetail::none;
  }
  ModeEnd advance(double until, MotionListener& listener) override {
    if (at_once_) return *at_once_;
    while (true) {
      if (pending_) {
        const double end = arc_.end().time;
        const bool beyond = end > until;
        piece_end_ = beyond ? until : end;
        piece_stretch_.reset();
        if (piece_end_ > piece_begin_) listener.piece(*this);
        if (setup_.meter->ended()) return {Guard::failed, -1, setup_.meter->why()};
        piece_begin_ = piece_end_;
        if (beyond) return {Guard::horizon};
        pending_ = false;
        if (is_at_event()) return end_of_arc();
      }
      if (!setup_.meter->spend(Work::contact, price())) return {Guard::failed, -1, setup_.meter->why()};
      const std::uint64_t rejected = arc_.rejected();
      const auto outcome = arc_.make();
      // The price of an interval has a few that are too long in it.
      constexpr std::uint64_t kFew = 8;
      const std::uint64_t too_long = arc_.rejected() - rejected;
      if (too_long > kFew)
        setup_.meter->spend(Work::contact, price() * static_cast<std::int64_t>(too_long - kFew));
      if (outcome == collocation::ContactArc::Outcome::gives_up)
        return {Guard::failed, -1, ending::StatusDetail::step_too_short};
      pending_ = true;
      piece_begin_ = arc_.start().time;
    }
  }
  void shift_time(double period) override {
    arc_.shift_time(period);
    piece_begin_ -= period;
    piece_end_ -= period;
  }
  void hand_over(double& time, rotor::ShaftAndRing& bodies, std::vector<OpenContact>& contacts) override {
    if (at_once_) {
      contacts = contacts_;
      return;
    }
    time = pending_ ? piece_end_ : arc_.end().time;
    bodies = pending_ ? arc_.solved_at(time).bodies : arc_.end().bodies;
    const Point there = pending_ ? arc_.point_at(arc_.fraction_at(time)) : arc_.end();
    for (OpenContact& open : contacts) open = arc_.touch_of(open.blade, there);
  }
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
              std::span<double> y) override {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto place = arc_.place_at(arc_.fraction_at(times[first + static_cast<int>(i)]));
      x[i] = place[0];
      if (!y.empty()) y[i] = place[1];
    }
  }
  [[nodiscard]] double displacement_bound() const override { return arc_.displacement_bound(); }
  double largest_displacement(double known, double /*speed_ratio*/) override {
    return arc_.largest_displacement(piece_begin_, piece_end_, known);
  }
  [[nodiscard]] std::size_t contact_count() const override { return contacts_.size(); }
  [[nodiscard]] int blade(std::size_t contact) const override { return contacts_[contact].blade; }
  [[nodiscard]] bool load_peaks(std::size_t /*contact*/) const override { return true; }
  LargestLoad largest(trajectory::Load load, std::size_t contact, double known) override {
    if (contacts_[contact].skims) return MotionPiece::largest(load, contact, known);
    const bool of_force = load == trajectory::Load::normal_force;
    const auto there = arc_.most_loaded(blade(contact), of_force, piece_begin_, piece_end_, known);
    if (!there) return {piece_begin_, known};
    const trajectory::ContactForce force_there = contact_force(contact, *there);
    return {there->time, of_force ? force_there.normal : force_there.root_strain};
  }
  trajectory::ContactForce contact_force(std::size_t contact, double time) override {
    pay_for_reading();
    return contact_force(contact, arc_.solved_at(time));
  }
  trajectory::Tip tip(int blade, double time) override {
    pay_for_reading();
    return tip(blade, arc_.solved_at(time));
  }
  std::optional<trajectory::Pass> nearest_pass(double known,
                                               const trajectory::PointConstants& point) override {
    if (!is_whole()) return MotionPiece::nearest_pass(known, point);
    const double radius = law_->geometry(0).ring_radius;
    const auto gap_at = [&](double miss) { return miss * (miss - 2.0 * radius); };
    std::optional<trajectory::Pass> nearest;
    if (arc_.gap_bound_of_others() <= gap_at(std::min(known, radius))) return nearest;
    for (int k = 0; k < point.blade_count; ++k) {
      if (std::ranges::find(contacts_, k, &OpenContact::blade) != contacts_.end()) continue;
      const auto top = arc_.top_of_tip(k);
      if (!top || top->value <= gap_at(std::min(known, radius))) continue;
      const Point at = arc_.solved_at_fraction(top->argument);
      const trajectory::Tip there = tip(k, at);
      if (!(there.overlap < 0.0 && -there.overlap < known)) continue;
      known = -there.overlap;
      nearest = trajectory::Pass{known, there.side, k, at.time};
    }
    return nearest;
  }
  trajectory::Tip deepest(std::size_t contact, double enough) override {
    if (!is_whole()) return MotionPiece::deepest(contact, enough);
    const int number = blade(contact);
    const trajectory::Tip at_end = tip(number, arc_.end());
    if (at_end.rate >= 0.0) return at_end;
    const auto top = arc_.top_of_tip(number);
    if (!top) return at_end;
    const bool deep = top->value > enough * (enough + 2.0 * law_->geometry(0).ring_radius);
    return tip(number, deep ? arc_.point_at(top->argument) : arc_.solved_at_fraction(top->argument));
  }
  void path(double share, trajectory::PathPoint& point,
            std::vector<trajectory::ContactForce>* forces) override {
    pay_for_reading();
    if (!piece_stretch_) piece_stretch_ = {arc_.fraction_at(piece_begin_), arc_.fraction_at(piece_end_)};
    const auto [from, to] = *piece_stretch_;
    const double length = to - from;
    const double fraction = from + share * length;
    // The force of a rigid tip is a small difference of places, which err between the nodes.
    const bool explicit_force =
        law_->is_rigid() || std::ranges::count(contacts_, true, &OpenContact::straight) > 0;
    Point there = explicit_force ? arc_.solved_at_fraction(fraction) : arc_.point_at(fraction);
    const collocation::Law::Tangent rate = arc_.direction_at(fraction);
    point.time = there.time;
    point.time_rate = length * rate.time;
    point.state = rotor::as_array(rotor::shaft(there.bodies));
    point.ring = rotor::as_array(rotor::ring(there.bodies));
    if (forces != nullptr) {
      forces->clear();
      for (std::size_t i = 0; i < contacts_.size(); ++i) forces->push_back(contact_force(i, there));
    }
    point.contacts.clear();
    if (any_rests(contacts_)) return;  // whose bends are no coordinates of a path
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const OpenContact open = arc_.touch_of(blade(i), there);
      const bool leads = open.blade == arc_.leader();
      const collocation::Law::Rates rates =
          leads ? law_->rates(open.blade, there.bending, rate) : collocation::Law::Rates{};
      point.contacts.push_back({open.blade, open.slip, open.bending, length * rates.bending, leads,
                                open.bend.modulus, open.bend.amplitude, length * rates.modulus,
                                length * rates.amplitude});
    }
  }
  bool solved_places(bool with_forces, const trajectory::VisitPlace& visit) override {
    if (!is_whole() || !arc_.ends_at_last_node()) return false;
    pay_for_reading();
    for (std::size_t node = 0; node < collocation::kNodes; ++node) {
      const Point there = arc_.at_node(node);
      const trajectory::State state = rotor::as_array(rotor::shaft(there.bodies));
      forces_at_node_.clear();
      for (std::size_t i = 0; with_forces && i < contacts_.size(); ++i)
        forces_at_node_.push_back(contact_force(i, there, arc_.direction_at_node(blade(i), node)));
      visit({arc_.weight_of_node(node), there.time, state, forces_at_node_});
    }
    return true;
  }
  bool solved_rubs(const trajectory::VisitRub& visit) override {
    if (!is_whole() || !arc_.ends_at_last_node()) return false;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const OpenContact& open = contacts_[i];
      const collocation::TipInTime& tip = arc_.tip(open.blade);
      for (std::size_t node = 0; node < collocation::kNodes; ++node) {
        contact::TipForce force{};
        force.normal = tip.normal_force[node];
        force.slip_velocity = tip.slip_velocity[node];
        const double friction = open.slip == 0.0 ? 0.0 : law_->friction_coefficient(open, {}, force);
        visit({i, arc_.weight_of_node(node), force.normal, friction * force.normal * force.slip_velocity});
      }
    }
    return true;
  }

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
  [[nodiscard]] ModeEnd end_of_arc() const {
    using Reason = collocation::ContactArc::Guard;
    const int blade = arc_.ending().blade;
    switch (arc_.ending().guard) {
      case Reason::touch_down:
        return {Guard::touch_down, blade};
      case Reason::slip_reversal:
        return {Guard::slip_reversal, blade};
      case Reason::loosening:
        return {Guard::comes_loose, blade};
      case Reason::pressed_in:
        if (law_->buckles_with_a_jump(arc_.touch_of(blade, arc_.end()), arc_.pose(blade, arc_.end())))
          return {Guard::snap, blade};
        return {Guard::pressed_in, blade};
      case Reason::chart_end:
        return {Guard::snap, blade};
      case Reason::shortening_limit:
        return {Guard::left_validity, blade, ending::StatusDetail::shortening_limit};
      case Reason::shaft_at_ring:
        return {Guard::left_validity, blade, ending::StatusDetail::shaft_at_ring};
      case Reason::fold:
        // What follows on another branch is for the motion to find. A tip is free only outside the ring.
        if (law_->has_branches(blade)) return {Guard::snap, blade};
        if (!law_->releases_at_fold(blade))
          return {Guard::left_validity, blade, ending::StatusDetail::no_equilibrium};
        return {arc_.pose(blade, arc_.end()).gap < 0.0 ? Guard::lift_off : Guard::snap, blade};
      default:
        return {Guard::lift_off, blade};
    }
  }
  [[nodiscard]] trajectory::Tip tip(int blade, const Point& point) const {
    return tip_of(law_->geometry(blade), arc_.pose(blade, point), angular_speed(point.time));
  }
  /// The piece is an interval, and not a part of one.
  [[nodiscard]] bool is_whole() const {
    return piece_begin_ == arc_.start().time && piece_end_ == arc_.end().time;
  }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, const Point& point) const {
    return contact_force(contact, point, arc_.direction(blade(contact), point.time));
  }
  [[nodiscard]] trajectory::ContactForce contact_force(std::size_t contact, const Point& point,
                                                       const contact::BladeDirection& er) const {
    const OpenContact touch = arc_.touch_of(blade(contact), point);
    const contact::Pose at = arc_.pose(touch.blade, point, er);
    const double speed = angular_speed(point.time);
    const contact::TipForce tip_force = law_->force(touch, {at, speed});
    return modes::contact_force(tip_force, touch.slip, law_->friction_coefficient(touch, at, tip_force), er,
                                at, speed);
  }

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

}  // namespace

std::unique_ptr<ContactPhases> phases_on_arcs(const ContactSetup& setup) {
  return std::make_unique<Collocated>(setup);
}

}  // namespace rubatlas::modes
