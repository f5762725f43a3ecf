/// The right-hand side that general solvers integrate: free shaft and contact forces in one, with nothing of
/// this program's integrator in it. Forces come from the function that this program uses itself
/// (`ElasticaContact::respond`, warm-started, summed over the blades by `Solved`).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "collocation/axial_law.hpp"
#include "compared/solved.hpp"
#include "contact/elastica_contact.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::bench {

/// x, y, dx/dτ, dy/dτ [m].
using PeerState = std::array<double, 4>;

/// The rotor with a set of open contacts. A solver with event location opens and closes them where it has
/// located touch-down and lift-off, and integrates smooth equations in between; one without leaves the choice
/// to each evaluation.
class ContactRotor {
 public:
  ContactRotor(const rotor::RotorConstants& rotor, int blade_count, const contact::ElasticaContact& law);
  ContactRotor(const ContactRotor&) = delete;  // parts point at each other
  ContactRotor& operator=(const ContactRotor&) = delete;

  [[nodiscard]] int blade_count() const { return machine_.blades.count(); }
  [[nodiscard]] double period() const { return machine_.constants.period(); }
  /// δc [m]: what tolerances are relative to.
  [[nodiscard]] double clearance() const { return machine_.constants.length_scale; }

  /// Rates of x, y, x', y' with the contacts that are open; false where a force does not exist (MODEL 5).
  bool evaluate(double time, const double* state, double* rates);
  /// The same with the contacts that g > 0 says (MODEL 4.1), slip directions those of the undeformed tips.
  bool evaluate_by_gap(double time, const double* state, double* rates);

  /// g of a blade [m²] and its rate [m² per unit τ].
  [[nodiscard]] double gap(int blade, double time, const double* state) const;
  [[nodiscard]] double gap_rate(int blade, double time, const double* state) const;

  [[nodiscard]] bool is_open(int blade) const { return open_[static_cast<std::size_t>(blade)]; }
  /// Touch-down and lift-off of a blade where it stands.
  void touch_down(int blade, double time, const double* state);
  void lift_off(int blade);

  [[nodiscard]] std::uint64_t right_hand_sides() const { return system_.evaluations(); }
  [[nodiscard]] std::uint64_t touchdowns() const { return touchdowns_; }

  /// For solvers without events: notes which blades touch after a step, and counts those that did not before.
  void count_touchdowns(double time, const double* state);

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  static constexpr modes::WorkBound kNoBound{kNever, kNever, 0};
  void open_contacts() {
    rotor::ContactState unused;
    system_.open(0.0, rotor::ShaftAndRing::Zero(), contacts_, unused);
  }
  [[nodiscard]] contact::Pose pose(int blade, double time, const double* state) const;
  [[nodiscard]] double slip(const contact::Pose& at) const;

  rotor::Machine machine_;
  collocation::AxialLaw law_;
  modes::WorkMeter meter_{kNoBound};
  compared::Solved system_;
  std::vector<bool> open_;
  std::vector<double>
      bending_;  ///< of each blade when it was last loaded: where the search for its force starts
  std::vector<modes::OpenContact> contacts_;
  std::uint64_t touchdowns_ = 0;
};

}  // namespace rubatlas::bench
