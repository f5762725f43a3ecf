/// Mode: a tip that skims the ring, the motion to which ever smaller hops tend where the force starts from a
/// finite value (MODEL 4.2, 4.6).
///
/// On the receding side a blade that touches down is thrown back at once. Where the free motion then leads it
/// to the ring again, the hops grow smaller without end; in their limit the tip stays on g = 0 under the
/// share λ of its force that holds it there,
///     g'' (free) + λ g'' (full force) = 0,   0 <= λ <= 1
/// (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988, §4: the convex combination of
/// the two sides; in λ also the share of time that hops spend in contact). At λ = 0 the tip leaves the ring,
/// at λ = 1 it is pressed in. The tip is that of the first contact; the others bear their full force.
#pragma once

#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "contact/pose.hpp"
#include "modes/guards.hpp"
#include "modes/open_contact.hpp"
#include "modes/solved.hpp"
#include "rotor/constants.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::modes {

class Skimming : public Solved {
 public:
  using Solved::Solved;
  static constexpr bool kHasPath = false;

  bool operator()(const FullState& state, FullState& derivative) {
    ++evaluations_;
    const contact::BladeDirection first = first_blade(state);
    std::complex<double> others;
    for (std::size_t i = 1; i < contacts_.size(); ++i) {
      if (!add_force(state, first, i, others)) return false;
    }
    Balance balance;
    if (!weigh(state, contacts_.front(), others, balance)) return false;
    forces_.front() = balance.force;
    set_derivative(state, others + balance.share * balance.pushed, derivative);
    watch_shortening(shortening());
    return true;
  }

  /// λ in a state; NaN where a blade has no force.
  [[nodiscard]] double share(const FullState& state) const {
    Balance balance;
    const auto others = force_of_others(state, contacts_);
    OpenContact contact = contacts_.front();
    if (!others || !weigh(state, contact, *others, balance)) return std::numeric_limits<double>::quiet_NaN();
    return balance.share;
  }
  /// λ times what the blade that skims does in full; nothing where a blade has no force.
  [[nodiscard]] contact::TipForce force(std::size_t contact, const FullState& state) const {
    if (contact > 0) return Solved::force(contact, state);
    Balance balance{};
    OpenContact open = contacts_.front();
    const auto others = force_of_others(state, contacts_);
    if (!others || !weigh(state, open, *others, balance)) return {};
    return balance.force;
  }

  /// Whether the first of these contacts, which touches down in a state, begins to skim: the blade would be
  /// thrown back and return, at most `hop` [m] away from the ring.
  [[nodiscard]] bool begins(const FullState& state, const std::vector<OpenContact>& contacts,
                            double hop) const {
    const auto others = force_of_others(state, contacts);
    if (!others) return false;
    // Hops are seldom that low: the blade's force is asked for only where they are.
    OpenContact contact = contacts.front();
    const FreeMotion free = free_motion(state, contact.blade, *others);
    const contact::Geometry& geometry = law_->geometry(contact.blade);
    const double rate = contact::gap_rate(geometry, free.pose, blades().angular_speed(state[rotor::kTime]));
    if (!(rate * rate <= 4.0 * geometry.ring_radius * hop * free.curvature)) return false;
    Balance balance;
    return weigh(state, contact, *others, balance) && balance.share > 0.0 && balance.share < 1.0;
  }

  void project(FullState& state) const {
    const int skims = contacts_.front().blade;
    rotor::put_on_ring(machine(), law_->geometry(skims), direction(state, skims),
                       blades().angular_speed(state[rotor::kTime]), state);
  }

  template <class Step>
  [[nodiscard]] double scaled_error(const Step& step) const {
    const bool alone = contacts_.size() == 1;
    return error_of(step, acceleration_, alone, [](const FullState&) { return 0.0; });
  }

  /// The tip leaves the ring at λ = 0 and is pressed in at λ = 1; both by so much that rounding does not lead
  /// it back.
  template <class Search>
  void guards(Search& search) {
    const int skims = contacts_.front().blade;
    const auto at = [&](double part) { return share(search.step().at_fraction(part)); };
    search.look_for([&](double part) { return -kShareBeyond - at(part); }, {Guard::lift_off, skims});
    search.look_for([&](double part) { return at(part) - (1.0 + kShareBeyond); }, {Guard::pressed_in, skims});
    guards_but_of(skims, search);
  }

 private:
  static constexpr double kShareBeyond = 1e-9;  ///< of λ past 0 or 1

  /// Free motion against the blade's full force.
  struct Balance {
    std::complex<double> pushed;  ///< its full force on the rotor [N]
    double share;                 ///< λ
    contact::TipForce force;      ///< λ times the force
  };

  [[nodiscard]] contact::BladeDirection direction(const FullState& state, int blade) const {
    return blades().direction(blade, first_blade(state));
  }

  /// What the contacts behind the first do to the rotor [N]; none where one has no force.
  [[nodiscard]] std::optional<std::complex<double>> force_of_others(
      const FullState& state, const std::vector<OpenContact>& contacts) const {
    std::complex<double> sum;
    for (std::size_t i = 1; i < contacts.size(); ++i) {
      OpenContact open = contacts[i];
      contact::TipForce force{};
      if (!law_->respond(place(open.blade, state), open, force)) return std::nullopt;
      sum += contact::on_rotor(force, direction(state, open.blade));
    }
    return sum;
  }

  /// The motion without the blade, under the force of the others, as the blade sees it.
  struct FreeMotion {
    contact::BladeDirection direction;
    contact::Pose pose;
    double curvature;  ///< g'' [m²]
  };
  [[nodiscard]] FreeMotion free_motion(const FullState& state, int blade,
                                       const std::complex<double>& others) const {
    const contact::Geometry& geometry = law_->geometry(blade);
    FreeMotion free;
    free.direction = direction(state, blade);
    free.pose = rotor::pose_of(rotor(), geometry, free.direction, rotor::from_ring(state));
    free.curvature = rotor::free_gap_curvature(machine(), geometry, free.direction, free.pose, state, others);
    return free;
  }

  bool weigh(const FullState& state, OpenContact& contact, const std::complex<double>& others,
             Balance& balance) const {
    const FreeMotion free = free_motion(state, contact.blade, others);
    const contact::BladeDirection& er = free.direction;
    const contact::Pose& at = free.pose;
    contact::TipForce& force = balance.force;
    if (!law_->respond({at, blades().angular_speed(state[rotor::kTime])}, contact, force)) return false;
    balance.pushed = contact::on_rotor(force, er);
    balance.share =
        -free.curvature / rotor::pushed_gap_curvature(machine(), law_->geometry(contact.blade), at, force);
    force = rotor::share_of(force, balance.share);
    return true;
  }
};

}  // namespace rubatlas::modes
