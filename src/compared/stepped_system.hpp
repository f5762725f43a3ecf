/// Right-hand side of the rotor over flight and contact alike, in τ: what the methods without a phase of
/// their own for contact integrate.
///
/// Whether a blade touches is either frozen for a step (`located`, whose steps end at events) or decided by
/// the sign of g wherever the right-hand side is asked for (MODEL 4.1). `Search` says how a blade's force is
/// found: `bool operator()(law, place, contact, force)`.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "contact/tip.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::compared {

/// x, y, x', y', τ.
using SteppedState = Eigen::Array<double, 5, 1>;
constexpr int kSteppedTime = 4;

/// A blade, open or closed, and what the last evaluation found there.
struct SteppedBlade {
  bool open = false;
  double slip = 1.0;           ///< s of an open contact
  double bending = 0.0;        ///< first guess of its root
  double gap = 0.0;            ///< g [m²]
  double slip_velocity = 0.0;  ///< v where there is a force [m per unit τ]
  double shortening = 0.0;     ///< δ/L there [-]
};

template <class Search, bool kFrozen>
class SteppedSystem {
 public:
  SteppedSystem(const rotor::Machine& machine, const collocation::Law& law, Search search)
      : machine_(&machine),
        rotor_(&machine.constants),
        directions_(&machine.blades),
        law_(&law),
        search_(std::move(search)),
        blades_(static_cast<std::size_t>(directions_->count())) {}

  [[nodiscard]] std::vector<SteppedBlade>& blades() { return blades_; }
  [[nodiscard]] const std::vector<SteppedBlade>& blades() const { return blades_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

  [[nodiscard]] double gap_rounding() const { return rotor_->gap_rounding(law_->geometry(0)); }
  [[nodiscard]] contact::Pose pose(std::size_t blade, const SteppedState& state) const {
    return rotor::pose_of(
        *rotor_, law_->geometry(static_cast<int>(blade)),
        directions_->direction(static_cast<int>(blade), directions_->first(state[kSteppedTime])),
        state.head<4>());
  }

  /// False where a blade in contact finds no force (MODEL 5).
  bool operator()(const SteppedState& state, SteppedState& derivative) {
    ++evaluations_;
    const contact::BladeDirection first = directions_->first(state[kSteppedTime]);
    std::complex<double> force;
    for (std::size_t k = 0; k < blades_.size(); ++k) {
      SteppedBlade& blade = blades_[k];
      const contact::BladeDirection er = directions_->direction(static_cast<int>(k), first);
      const contact::Pose at =
          rotor::pose_of(*rotor_, law_->geometry(static_cast<int>(k)), er, state.head<4>());
      blade.gap = at.gap;
      if (!touches(blade, at)) continue;
      contact::TipForce of_tip{};
      if (!find_force(k, at, blade.bending, of_tip)) return false;
      blade.slip_velocity = of_tip.slip_velocity;
      blade.shortening = of_tip.shortening;
      force += contact::on_rotor(of_tip, er);
    }
    const std::complex<double> acceleration =
        machine_->shaft.acceleration(*rotor_, state[kSteppedTime], state.head<4>(), force);
    derivative << state[2], state[3], acceleration.real(), acceleration.imag(), 1.0;
    return true;
  }

  /// What a blade does in a state of the last step; all zero where it does not touch or finds no force.
  /// Leaves no trace in first guesses.
  [[nodiscard]] contact::TipForce force(std::size_t blade, const SteppedState& state) const {
    contact::TipForce force{};
    const contact::Pose at = pose(blade, state);
    double bending = blades_[blade].bending;
    if (!touches(blades_[blade], at) || !find_force(blade, at, bending, force)) return {};
    return force;
  }

  /// Largest δ/L of the last evaluation.
  [[nodiscard]] double shortening() const {
    double largest = 0.0;
    for (const SteppedBlade& blade : blades_) {
      if (kFrozen ? blade.open : blade.gap > 0.0) largest = std::max(largest, blade.shortening);
    }
    return largest;
  }

  /// Slip direction that a contact opens with (MODEL 4.4).
  [[nodiscard]] double opening_slip(const contact::Pose& at) const {
    return contact::undeformed_slip_velocity(law_->geometry(0), at, rotor_->speed_ratio) >= 0.0 ? 1.0 : -1.0;
  }

 private:
  [[nodiscard]] static bool touches(const SteppedBlade& blade, const contact::Pose& at) {
    return kFrozen ? blade.open : at.gap > 0.0;
  }
  bool find_force(std::size_t blade, const contact::Pose& at, double& bending,
                  contact::TipForce& force) const {
    // Within a step a blade may touch that was not open at its start.
    const double slip = blades_[blade].open ? blades_[blade].slip : opening_slip(at);
    modes::OpenContact contact{static_cast<int>(blade), slip, bending};
    const bool found = search_(*law_, modes::TipPlace{at, rotor_->speed_ratio}, contact, force);
    bending = contact.bending;
    return found;
  }

  const rotor::Machine* machine_;
  const rotor::RotorConstants* rotor_;
  const rotor::BladeSet* directions_;
  const collocation::Law* law_;
  Search search_;
  std::vector<SteppedBlade> blades_;
  std::uint64_t evaluations_ = 0;
};

/// The root of the contact equation, as accurate as numbers allow.
struct SolvedForce {
  bool operator()(const collocation::Law& law, const modes::TipPlace& at, modes::OpenContact& contact,
                  contact::TipForce& force) const {
    return law.respond(at, contact, force);
  }
};

}  // namespace rubatlas::compared
