/// Contacts of one elastic blade or of few, interval by interval, from where one of them begins to where the
/// next one begins or ends.
///
/// The contact of one blade, which leads, is an arc in the plane (τ, p): up from the touch-down, over the
/// largest bending, and down to the lift-off at p = 0, or at g = 0 under load on the receding side, or to the
/// fold where time turns round (MODEL 4.2). An interval is a stretch of this arc (`interval.hpp`). Its first
/// guess is that of an earlier contact which began alike, or a circular arc (`predictor.hpp`).
///
/// The others are bent as the shaft's motion has it. The one that lifts off next has
/// to lead: near its lift-off its bending is no smooth function of time.
///
/// Where no interval can be made the next event is at hand: a contact that is shorter than times are rounded
/// is an impact, and a guard may be met where an interval begins. Where it cannot be told which, the arc
/// gives up, and the point ends as `step_too_short`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "collocation/blades_in_contact.hpp"
#include "collocation/earlier_contacts.hpp"
#include "collocation/interval.hpp"
#include "collocation/interval_samples.hpp"
#include "collocation/law.hpp"
#include "collocation/machine_in_time.hpp"
#include "collocation/predictor.hpp"
#include "collocation/straight_tips.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::collocation {

class ContactArc {
 public:
  /// `tolerance`: local error, accuracy.tolerance × δc [m]; `max_shortening`: of δ/L. Machine and law must
  /// outlive the arc. A ring that moves is a body.
  ContactArc(const rotor::Machine& machine, Law& law, double tolerance, double max_shortening);
  ContactArc(const ContactArc&) = delete;
  ContactArc& operator=(const ContactArc&) = delete;

  /// A place on the contact's curve.
  struct Point {
    double time = 0.0;  ///< τ of the revolution
    rotor::ShaftAndRing bodies = rotor::ShaftAndRing::Zero();
    Bending bending;                 ///< of the leading blade
    std::vector<Bending> further{};  ///< of the others, with p² in place of p
  };

  /// Begins where these blades touch, and finds what of their contacts follows from all of them: λ of a tip
  /// that skims, c of rigid tips at rest. Ends there where the shaft is not within the ring, or the limit of
  /// a shortening is passed.
  void begin(double time, const rotor::ShaftAndRing& bodies, std::span<Touch> touching);

  enum class Outcome : std::uint8_t { made, gives_up };
  /// Makes the next interval, from the end of the one before.
  Outcome make();
  /// What ends an interval: the leading blade lifts off unbent or under load, or comes to the fold of its
  /// branch or to the end of the chart of its equilibria; the slip of a blade reverses; a tip at rest comes
  /// loose; a straight blade is pressed in; another blade touches down; a blade comes to the limit of its
  /// shortening, or the shaft to the ring (MODEL 5).
  enum class Guard : std::uint8_t {
    none,
    unbent,
    under_load,
    fold,
    chart_end,
    slip_reversal,
    loosening,
    pressed_in,
    touch_down,
    shortening_limit,
    shaft_at_ring
  };
  struct Ending {
    Guard guard = Guard::none;
    double fraction = 1.0;  ///< θ
    int blade = -1;
    double slope = 0.0;  ///< by θ of the guard's quantity, which passes through zero there
    /// The tip that touches down has been free inside a ring with dampers, and turns outwards (MODEL 7.16).
    bool inside = false;
  };
  /// Of the interval that has been made.
  [[nodiscard]] const Ending& ending() const { return ending_; }
  [[nodiscard]] const Point& start() const { return start_; }
  [[nodiscard]] const Point& end() const { return end_; }

  /// θ in the interval that has been made where it has reached a time.
  [[nodiscard]] double fraction_at(double time) const;
  /// There, as accurate as at the end of an interval: solves the stretch up to there.
  [[nodiscard]] Point solved_at(double time);
  /// Where F, or else the strain at the root, as kept at the nodes, is largest between two times of the
  /// interval; none where that is not larger than `known`.
  [[nodiscard]] std::optional<Point> most_loaded(int blade, bool of_force, double from, double to,
                                                 double known);
  /// The largest |z| between two times of the interval [m], or `known` where it is not larger than that.
  [[nodiscard]] double largest_displacement(double from, double to, double known);
  /// Shaft's place x, y [m] at θ, on the interval's polynomials.
  [[nodiscard]] std::array<double, 2> place_at(double fraction) const;
  [[nodiscard]] Point point_at(double fraction) const;
  [[nodiscard]] Point at_node(std::size_t node) const { return at_node(made(), node); }
  /// A tip in contact throughout the interval.
  [[nodiscard]] const TipInTime& tip(int blade) const { return tip_of(made(), blade); }
  /// er of a blade there.
  [[nodiscard]] contact::BladeDirection direction_at_node(int blade, std::size_t node) const;
  /// Of a quadrature over the interval, of order 15 [in τ].
  [[nodiscard]] double weight_of_node(std::size_t node) const {
    return kNodeTables.integral[node].at_end() * made().time_slope[node];
  }
  /// The last node is where the interval ends, but for what has been left where a guard was located.
  [[nodiscard]] bool ends_at_last_node() const;
  /// dτ/dθ, dp/dθ and dl/dθ of the leading blade there.
  [[nodiscard]] Law::Tangent direction_at(double fraction) const;
  /// er of a blade at a time, and where it stands.
  [[nodiscard]] contact::BladeDirection direction(int blade, double time) const {
    return whole_->blades.direction(blade, whole_->blades.first(time));
  }
  [[nodiscard]] contact::Pose pose(int blade, const Point& point, const contact::BladeDirection& er) const {
    return straight_tips_.pose(blade, point.bodies, er);
  }
  [[nodiscard]] contact::Pose pose(int blade, const Point& point) const {
    return pose(blade, point, direction(blade, point.time));
  }
  [[nodiscard]] TipPlace tip_place(int blade, const Point& point) const {
    return {pose(blade, point), whole_->blades.angular_speed(point.time)};
  }
  /// How far a blade in contact is bent there.
  [[nodiscard]] Bending bending_of(int blade, const Point& point) const;
  /// Its contact there.
  [[nodiscard]] Touch touch_of(int blade, const Point& point) const;
  /// Force of a contact there.
  [[nodiscard]] contact::TipForce force(const Touch& touch, const Point& point) const {
    return law_->force(touch, tip_place(touch.blade, point));
  }
  /// Bound of the gaps of the blades that do not touch, within the interval [m²].
  [[nodiscard]] double gap_bound_of_others() const {
    double largest = -std::numeric_limits<double>::infinity();
    for (const int blade : others_) largest = std::max(largest, gap_bound(blade, made()));
    return largest;
  }
  /// θ and g where the tip of a blade, straight, is farthest out within the interval, if it is there.
  [[nodiscard]] std::optional<integrate::Sample> top_of_tip(int blade) const {
    return top_of(course_of_tip(made(), blade));
  }
  /// At θ, or close by: the end of the stretch up to there, solved for itself.
  [[nodiscard]] Point solved_at_fraction(double fraction);
  /// Bound of |z| in the interval [m].
  [[nodiscard]] double displacement_bound() const { return solver_.largest_displacement(made()); }

  /// Sets the time back by a revolution.
  void shift_time(double period);

  /// The blade that leads.
  [[nodiscard]] int leader() const { return tips_.front().number; }

  // What it cost.
  [[nodiscard]] std::uint64_t intervals() const { return interval_count_; }
  [[nodiscard]] std::uint64_t rejected() const { return rejected_; }
  [[nodiscard]] std::uint64_t sweeps() const { return sweeps_; }

 private:
  static constexpr int kNoBlade = -1;
  static constexpr int kMostLeadChanges = 2;  ///< where no interval is made between them
  /// [τ]: times and gaps of so short a contact, which count from where it begins, are rounding; and of one
  /// that may be all but rounding.
  static constexpr double kImpact = 1e-14;
  static constexpr double kAllButImpact = 1e-11;
  /// Of the tolerance: what sweeps may leave, and where a ring with dampers keeps it.
  static constexpr double kClosest = 0.2;
  static constexpr double kClosestOnDampers = 0.1;
  /// p: the force of a blade that is bent less is some 1e-9 of EI/L².
  static constexpr double kNextToUnbent = 1e-4;

  void lead(double time, const rotor::ShaftAndRing& bodies, std::span<Touch> touching, std::size_t leader);
  [[nodiscard]] const Blade& numbers(int blade) const { return numbers_[static_cast<std::size_t>(blade)]; }
  [[nodiscard]] const Machine& machine() const { return machine_.numbers(); }
  /// dg/dτ of a straight tip that stands there at the end [m² per unit τ].
  [[nodiscard]] double gap_rate_at_end(int blade, const contact::Pose& there) const {
    return contact::gap_rate(law_->geometry(blade), there, whole_->blades.angular_speed(end_.time));
  }
  /// Cosine and sine of the angle from the leading blade to another.
  [[nodiscard]] std::array<double, 2> offset_of(int blade) const {
    const contact::BladeDirection& from = from_first_[static_cast<std::size_t>(leader())];
    const contact::BladeDirection& to = from_first_[static_cast<std::size_t>(blade)];
    return {to.cosine * from.cosine + to.sine * from.sine, to.sine * from.cosine - to.cosine * from.sine};
  }
  static void move(Point& point, const Interval& interval, double late);
  void predict(const Touch& touch, const TipPlace& at);
  void set_out(TipStart& tip, const std::complex<double>& acceleration) const;
  void set_out_as_solved();
  [[nodiscard]] static rotor::ContactState state_at(const Point& point) {
    return rotor::full_state(point.bodies, point.time, 0.0);
  }
  void put_on_ring(int blade, Point& point) const;
  void skim(std::span<Touch> touching, const Point& point) const;
  /// Where a blade in contact stands in `tips_`.
  [[nodiscard]] std::size_t number_of(int blade) const {
    std::size_t number = 0;
    while (tips_[number].number != blade) ++number;
    return number;
  }
  [[nodiscard]] const BladeStart& leading() const { return tips_.front(); }
  [[nodiscard]] const Interval& made() const { return intervals_[made_]; }
  [[nodiscard]] Interval& trial() { return intervals_[1 - made_]; }
  [[nodiscard]] const Interval& trial() const { return intervals_[1 - made_]; }
  void look_for_earlier();
  /// A part of the interval: two times, and θ of each.
  struct Stretch {
    double from, to;     ///< τ of the revolution
    double first, last;  ///< θ
  };
  [[nodiscard]] Stretch stretch(double from, double to) const;
  [[nodiscard]] Point solved_in(const Stretch& stretch, double fraction);
  [[nodiscard]] double nearer_to_top(int blade, const Point& there, double fraction) const;
  void start_next(Interval& next) const;
  /// `closest`: what sweeps may leave, if less than usual, where a guard is located [m per unit τ].
  bool solve(Interval& interval, bool warm, double closest = std::numeric_limits<double>::infinity());
  /// One elastic blade under an axial load makes all of the force.
  [[nodiscard]] bool is_lone() const { return tips_.size() == 1 && !law_->leans() && !law_->is_rigid(); }
  // Error of a velocity between the nodes [m per unit τ]: what is allowed at a tolerance [m] to all but a
  // lone blade, what is allowed now, and that of an interval.
  [[nodiscard]] static double allowed_at(double tolerance, double clearance);
  [[nodiscard]] double allowed_between_nodes() const;
  [[nodiscard]] static double error_between_nodes(const Interval& interval);
  [[nodiscard]] double left_out_of_lone(const Interval& interval) const;
  [[nodiscard]] double error_of(const Interval& interval) const;
  [[nodiscard]] bool stays_valid(const Ending& ending) const;
  [[nodiscard]] Ending guard_of_contacts(const Interval& interval) const;
  [[nodiscard]] AtPlaces validity_left(const Interval& interval, Guard guard, int blade) const;
  [[nodiscard]] const TipInTime& tip_of(const Interval& interval, int blade) const {
    return interval.tips[number_of(blade)];
  }
  [[nodiscard]] TipCourse course_of_tip(const Interval& interval, int blade) const {
    return collocation::course_of_tip(machine(), interval, numbers(blade), offset_of(blade));
  }
  [[nodiscard]] std::optional<Ending> touch_down(const Interval& interval, Ending before) const;
  [[nodiscard]] int touches_at_once() const;
  [[nodiscard]] bool is_shorter_than(double duration) const;
  Outcome rebound();
  [[nodiscard]] Guard guard_of_tip(Guard guard) const;
  [[nodiscard]] bool is_met_at_once(const Ending& ending) const;
  [[nodiscard]] bool moves_little(double late) const;
  [[nodiscard]] bool lifts_off_at_once() const;
  Outcome end_at_once(Guard guard, int blade);
  [[nodiscard]] bool starts_inside(int blade) const;
  [[nodiscard]] double gap_bound(int blade, const Interval& interval) const {
    return solver_.largest_gap(machine(), interval, numbers(blade), offset_of(blade));
  }
  [[nodiscard]] bool stays_off(int blade, const Interval& interval, bool touches_at_end) const;
  /// Whether the trial can be the next interval, up to its ending, and whether that is a stretch of it. Or
  /// its ending is met at once, where it starts.
  enum class Verdict : std::uint8_t { holds, holds_in_part, too_long, another_leads, at_once };
  Verdict judge(Ending& ending);
  bool solve_next(bool learns);
  void goes_on(const Ending& ending);
  [[nodiscard]] std::vector<Touch> touching_at(const Point& point) const;
  bool begin_anew(std::size_t leader);
  void leave_earlier();
  void guess_further(Interval& next) const;
  bool cut(const Interval& whole, double fraction, Interval& stretch,
           double closest = std::numeric_limits<double>::infinity());
  /// `set_out` has given v its sign.
  [[nodiscard]] static bool slips_from_zero(double start_velocity) {
    return std::abs(start_velocity) == std::numeric_limits<double>::min();
  }
  /// |v| of a slip reversal that has been located [m per unit τ].
  [[nodiscard]] double slip_rounding() const { return straight_tips_.slip_rounding(end_.bodies); }
  /// A blade in contact does not bend: it is rigid, or stands straight.
  [[nodiscard]] bool is_straight(int blade) const {
    if (law_->is_rigid()) return true;
    return tips_[number_of(blade)].straight;
  }
  /// The contact of the leading blade, bent, goes on beyond the ring up to its fold.
  [[nodiscard]] bool is_held_beyond_ring() const {
    return law_->releases_at_fold(leader()) && !is_straight(leader());
  }
  /// Slip to this side may reverse.
  [[nodiscard]] bool reverses(double slip) const { return law_->has_slip_state() && slip != 0.0; }
  [[nodiscard]] bool is_next_to_unbent(const Interval& interval) const;
  [[nodiscard]] double left_at_end(const Ending& ending, const Interval& interval) const;
  bool cut_at(const Interval& whole, Ending& ending, Interval& shorter);
  /// A place of an interval. `value`: of a quantity there, from that at the start and those at the nodes.
  template <class Value>
  [[nodiscard]] static Point read(const Interval& in, const Value& value) {
    const auto bending = [&](double argument, const TipInTime& tip) {
      return Bending{argument, value(tip.start_lean, tip.lean), value(tip.start_yielding, tip.yielding),
                     value(tip.start_gap_measure, tip.gap_measure) - kShareBeyond};
    };
    Point point{.time = in.start_time + value(0.0, in.elapsed),
                .bending = bending(value(in.start_argument, in.argument), in.leader())};
    const auto place = [&](const Body& body, Eigen::Index first) {
      point.bodies.segment<4>(first) << value(body.start[0], body.x), value(body.start[1], body.y),
          value(body.start[2], body.vx), value(body.start[3], body.vy);
    };
    place(in.shaft, 0);
    place(in.ring, 4);
    for (const TipInTime& further : in.further())
      point.further.push_back(bending(value(further.start_square, further.square), further));
    return point;
  }
  [[nodiscard]] static Point at_node(const Interval& interval, std::size_t node);
  [[nodiscard]] static Point end_of(const Interval& interval) { return at_node(interval, kNodes - 1); }
  void bring_to_rest(int reversed);
  void go_on_to_ring(const Interval& interval, int blade);
  void end_at(const Interval& interval, const Ending& ending);

  const rotor::Machine* whole_;
  Law* law_;
  double tolerance_;  ///< [m]
  MachineInTime machine_;
  std::vector<Blade> numbers_;  ///< of the blades
  IntervalSolver solver_;
  Predictor predictor_;
  StraightTips straight_tips_;
  std::vector<contact::BladeDirection> from_first_;  ///< of the blades from the place of blade 0
  std::vector<int> others_;                          ///< blades that do not touch
  std::vector<BladeStart> tips_;                     ///< where the next interval starts; the first leads
  double allowed_;                                   ///< `allowed_at` the tolerance
  bool ring_keeps_load_;                             ///< it yields to elastic blades in its own time

  bool begins_ = false;  ///< the next interval is the first of the contact
  Ending ending_;
  bool jumps_ = false;       ///< the error of trials does not fall with their length
  bool seeks_fold_ = false;  ///< nothing else has let the arc go on
  int lead_changes_ = 0;     ///< since the last interval
  Point start_, end_;
  contact::BladeDirection er_{};         ///< of the blade at the end
  std::array<Interval, 2> intervals_{};  ///< the last that was made, and the next
  std::size_t made_ = 0;
  EarlierContacts earlier_;
  EarlierContacts::Found found_;  ///< the earlier contact is followed, unless it is null
  std::size_t number_ = 0;        ///< of the next interval in the contact
  double rounding_at_end_ = 0.0;  ///< |v| or other where an ending is
  Bounds bounds_{};               ///< of the interval that has been judged last
  std::uint64_t interval_count_ = 0;
  std::uint64_t rejected_ = 0;
  std::uint64_t sweeps_ = 0;
};

}  // namespace rubatlas::collocation
