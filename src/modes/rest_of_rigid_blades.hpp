/// Which tips of rigid blades rest on the ring: the friction on a tip at rest is the one that keeps it there.
///
/// The slip velocities v of the tips at rest stay zero, and dv/dτ of each is linear in the friction q = c
/// F/(m ωn²) at all of them (`contact/sticking.hpp`), so that q solves a system with the cosines between the
/// tangents (`collocation/straight_tips.hpp`). A tip comes loose where |c| > μs (Filippov's sliding mode on v
/// = 0; with two tips, on the intersection). No more than two can rest: with v = Ω (|r| − p·n), p the rotor's
/// instantaneous centre, all of them touch the ring where a tangent to it leads to p.
#pragma once

#include <vector>

#include "collocation/straight_tips.hpp"
#include "modes/rest_judge.hpp"
#include "rotor/bodies.hpp"

namespace rubatlas::modes {

class RestOfRigidBlades : public RestJudge, public collocation::StraightTips {
 public:
  using StraightTips::StraightTips;

  /// Of the contacts with s = 0 in a state, those stay at rest that friction can hold; the others get the
  /// direction in which they are pulled. A rigid tip can always do either: true.
  bool settle(const State& state, std::vector<OpenContact>& contacts) override;
  /// Where two tips rest already, a third passes through.
  bool arrest(const State& state, const std::vector<OpenContact>& contacts, OpenContact& contact) override;
  /// It slips the way it is pulled.
  bool let_go(const State& state, const std::vector<OpenContact>& contacts, OpenContact& contact) override;

  /// What friction has to give on a tip that is held in a state beyond what it can [N]: the tip comes loose
  /// where it is positive.
  [[nodiscard]] double excess(const State& state, const OpenContact& held) const;
};

}  // namespace rubatlas::modes
