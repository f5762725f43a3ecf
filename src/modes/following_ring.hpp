/// Mode: rigid blades in a ring without mass, which all blades in contact push together: the ring stands
/// where its spring balances their forces.
///
///     kr r = ΣNk,   Nk = kt (|pk| − R) (n + sμ t)        pk = c − r + (rh+L) er
///
/// Nk is what the rigid blade k does to the ring (MODEL 4.7), pk its tip as seen from the ring's centre, n
/// the direction of pk and t across it. Each force depends on r, and so on the other forces. The two
/// unknowns, the components of r, are found by Newton's method with Ak = dNk/dpk = kt (I + sμ J)(n nᵀ + (1 −
/// R/|pk|)(I − n nᵀ)), where J is a quarter turn; r' follows from (kr I + ΣAk) r' = ΣAk p'k, where p' is
/// taken with the ring at rest. Source: statics.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/pose.hpp"
#include "modes/solved.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::modes {

/// The equations of `Solved`, with the ring where its spring balances the blades. Place and velocity of the
/// ring are not degrees of freedom; they follow from the shaft's state.
template <class Law>
class FollowingRing : public Solved<Law> {
 public:
  using Base = Solved<Law>;
  using Base::Base;
  static constexpr bool kHasPath = false;
  using FullState = rotor::ContactState;

  bool operator()(const FullState& state, FullState& derivative) {
    FullState placed = state;
    return place_ring(placed) && Base::operator()(placed, derivative);
  }

  void project(FullState& state) const { place_ring(state); }
  void place(FullState& state) const { place_ring(state); }

  template <class Search>
  void guards(Search& search) {
    touch_downs_and_lift_offs(*this, search);
    // The rate of the ring does not tell how the ring moves on, so that no bound excludes these guards.
    for (std::size_t i = 0; i < this->contacts_.size(); ++i) this->slip_guard(*this, search, i, false);
    this->loss_of_validity(*this, search, std::numeric_limits<double>::infinity());
  }

  /// Puts the ring of a state where its spring balances the open contacts. False where there is no such place
  /// (MODEL 5).
  bool place_ring(FullState& state) const {
    Balance balance;
    for (int step = 0; step < kMostSteps; ++step) {
      balance = weigh(state);
      const Eigen::Vector2d move = balance.stiffness.inverse() * balance.excess;
      if (!move.allFinite()) return false;
      state.segment<2>(kRing) += move.array();
      if (move.norm() <= kResolution * this->law_->of(0).geometry().ring_radius) {
        const Eigen::Vector2d velocity = balance.stiffness.inverse() * balance.carried;
        state.segment<2>(kRing + 2) = velocity.array();
        return true;
      }
    }
    return false;
  }

  /// Finds the ring's place and the contacts together: `touches(blade)` opens the contact of a blade that
  /// reaches into the ring at its place, and the contact of a blade that does not is closed. (The place jumps
  /// where friction reverses.) False also where a tip would stick, since its friction would be another
  /// unknown (MODEL 5).
  template <class Touches>
  bool settle(rotor::ShaftAndRing& bodies, double time, std::vector<OpenContact>& contacts, Touches touches) {
    const double radius = this->law_->of(0).geometry().ring_radius;
    const double rounding = kGapRounding * radius * radius;
    for (int change = 0; change <= 2 * this->blades().count(); ++change) {
      FullState full;
      this->open(time, bodies, contacts, full);
      if (!place_ring(full)) return false;
      bodies = rotor::bodies(full);
      int enters = -1;
      double deepest = rounding;
      auto leaves = contacts.end();
      for (int k = 0; k < this->blades().count(); ++k) {
        const double gap = this->pose(k, full).gap;
        const auto open = std::ranges::find(contacts, k, &OpenContact::blade);
        if (open == contacts.end() && gap > deepest) {
          deepest = gap;
          enters = k;
        }
        if (open != contacts.end() && gap < -rounding) leaves = open;
      }
      if (leaves != contacts.end()) {
        contacts.erase(leaves);
      } else if (enters < 0) {
        return slides(full);
      } else if (!touches(enters)) {
        return false;
      }
    }
    return false;
  }

 private:
  /// Of R²: rounding of g where a touch-down or a lift-off has been located.
  static constexpr double kGapRounding = 32.0 * std::numeric_limits<double>::epsilon();
  static constexpr int kRing = 6;  ///< place of r in a state in contact
  static constexpr int kMostSteps = 30;
  /// Of R: the next step of Newton's method, which is quadratic, is below the rounding of r.
  static constexpr double kResolution = 1e-12;

  struct Balance {
    Eigen::Vector2d excess;     ///< ΣNk − kr r [N]
    Eigen::Matrix2d stiffness;  ///< kr I + ΣAk [N/m]
    Eigen::Vector2d carried;    ///< ΣAk p'k [N per unit τ]
  };

  /// All open contacts slip in the direction of their s.
  [[nodiscard]] bool slides(const FullState& state) const {
    const double speed = this->blades().angular_speed(state[rotor::kTime]);
    return std::ranges::all_of(this->contacts(), [&](const OpenContact& contact) {
      const contact::Geometry& geometry = this->law_->of(contact.blade).geometry();
      const double velocity =
          contact::undeformed_slip_velocity(geometry, this->pose(contact.blade, state), speed);
      return contact.slip * velocity >=
             -contact::kSlipRounding * std::abs(this->rotor().speed_ratio) * geometry.ring_radius;
    });
  }

  [[nodiscard]] Balance weigh(const FullState& state) const {
    const double stiffness = this->machine().following_ring()->stiffness;
    const rotor::State seen = rotor::from_ring(state);
    Balance balance{-stiffness * state.segment<2>(kRing).matrix(), stiffness * Eigen::Matrix2d::Identity(),
                    Eigen::Vector2d::Zero()};
    const contact::BladeDirection first = this->blades().first(state[rotor::kTime]);
    const double speed = this->blades().angular_speed(state[rotor::kTime]);
    for (const OpenContact& contact : this->contacts()) {
      const auto& law = this->law_->of(contact.blade);
      const contact::Geometry& geometry = law.geometry();
      const contact::BladeDirection er = this->blades().direction(contact.blade, first);
      const contact::Pose at = rotor::pose_of(this->rotor(), geometry, er, seen);
      const Eigen::Vector2d tip(seen[0] + geometry.reach * er.cosine,
                                seen[1] + this->rotor().misalignment + geometry.reach * er.sine);
      const double distance = tip.norm();
      const double depth = at.gap / (distance + geometry.ring_radius);
      const Eigen::Vector2d normal = tip / distance;
      const double friction = law.friction().coefficient(0.0, contact.slip);
      Eigen::Matrix2d with_friction;
      with_friction << 1.0, -friction, friction, 1.0;
      balance.excess += law.stiffness() * depth * with_friction * normal;
      const Eigen::Matrix2d along = normal * normal.transpose();
      const Eigen::Matrix2d change = law.stiffness() * with_friction *
                                     (along + depth / distance * (Eigen::Matrix2d::Identity() - along));
      balance.stiffness += change;
      const Eigen::Vector2d velocity(state[2] - speed * geometry.reach * er.sine,
                                     state[3] + speed * geometry.reach * er.cosine);
      balance.carried += change * velocity;
    }
    return balance;
  }
};

}  // namespace rubatlas::modes
