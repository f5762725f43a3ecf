/// Where a ring without mass stands: where its spring balances the rigid blades that push it.
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

#include "contact/pose.hpp"
#include "rotor/bodies.hpp"
#include "rotor/machine.hpp"

namespace rubatlas::rotor {

/// `Law`: Coulomb friction of rigid blades on springs. `Contacts`: of blades, with their `blade` and `slip`.
template <class Law, class Contacts>
class RingBalance {
 public:
  RingBalance(const Machine& machine, const Law& law, const Contacts& contacts)
      : machine_(machine), law_(law), contacts_(contacts) {}

  /// Puts the ring of a state where it stands. False where there is no such place (MODEL 5).
  bool place(ContactState& state) const {
    for (int step = 0; step < kMostSteps; ++step) {
      const Balance balance = weigh(state);
      const Eigen::Vector2d move = balance.stiffness.inverse() * balance.excess;
      if (!move.allFinite()) return false;
      state.segment<2>(kRing) += move.array();
      if (move.norm() <= kResolution * law_.of(0).geometry().ring_radius) {
        const Eigen::Vector2d velocity = balance.stiffness.inverse() * balance.carried;
        state.segment<2>(kRing + 2) = velocity.array();
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr int kRing = 6;  ///< place of r in a state in contact
  static constexpr int kMostSteps = 30;
  /// Of R: the next step of Newton's method, which is quadratic, is below the rounding of r.
  static constexpr double kResolution = 1e-12;

  struct Balance {
    Eigen::Vector2d excess;     ///< ΣNk − kr r [N]
    Eigen::Matrix2d stiffness;  ///< kr I + ΣAk [N/m]
    Eigen::Vector2d carried;    ///< ΣAk p'k [N per unit τ]
  };
  [[nodiscard]] Balance weigh(const ContactState& state) const {
    const double stiffness = machine_.following_ring()->stiffness;
    const State seen = from_ring(state);
    Balance balance{-stiffness * state.segment<2>(kRing).matrix(), stiffness * Eigen::Matrix2d::Identity(),
                    Eigen::Vector2d::Zero()};
    const contact::BladeDirection first = machine_.blades.first(state[kTime]);
    const double speed = machine_.blades.angular_speed(state[kTime]);
    for (const auto& contact : contacts_) {
      const auto& law = law_.of(contact.blade);
      const contact::Geometry& geometry = law.geometry();
      const contact::BladeDirection er = machine_.blades.direction(contact.blade, first);
      const contact::Pose at = pose_of(machine_.constants, geometry, er, seen);
      const Eigen::Vector2d tip(seen[0] + geometry.reach * er.cosine,
                                seen[1] + machine_.constants.misalignment + geometry.reach * er.sine);
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

  const Machine& machine_;
  const Law& law_;
  const Contacts& contacts_;
};

}  // namespace rubatlas::rotor
