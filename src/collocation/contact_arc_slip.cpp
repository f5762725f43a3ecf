// How tips set out to slip, and what holds straight ones at rest.

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "collocation/contact_arc.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::collocation {

/// The sign of v where it starts from zero: that of s, or, of a straight tip that may slip back, of dv/dτ.
/// `acceleration`: of the shaft, seen from the ring.
void ContactArc::set_out(TipStart& tip, const std::complex<double>& acceleration) const {
  if (tip.slip == 0.0 || std::abs(tip.at_start.slip_velocity) > slip_rounding()) return;
  const double ahead = law_->may_slip_back() && is_straight(tip.number)
                           ? straight_tips_.slip_acceleration(tip.number, state_at(end_), acceleration)
                           : tip.slip;
  tip.at_start.slip_velocity = std::copysign(std::numeric_limits<double>::min(), ahead);
}

/// The same of bent tips that may slip back, which the solved interval tells: their v follows from how they
/// bend.
void ContactArc::set_out_as_solved() {
  if (!law_->may_slip_back()) return;
  const double left = std::max(slip_rounding(), kClosest * tolerance_);
  for (std::size_t k = 0; k < tips_.size(); ++k) {
    BladeStart& tip = tips_[k];
    TipInTime& solved = trial().tips[k];
    if (tip.slip != 0.0 && !is_straight(tip.number) && slips_from_zero(tip.at_start.slip_velocity)) {
      const auto known =
          std::ranges::find_if(solved.slip_velocity.value, [left](double v) { return std::abs(v) > left; });
      if (known != solved.slip_velocity.value.end())
        tip.at_start.slip_velocity = std::copysign(tip.at_start.slip_velocity, *known);
    }
    solved.at_start.slip_velocity = tip.at_start.slip_velocity;
  }
}

/// Puts a tip that skims on the ring, g = 0 and dg/dτ = 0: what its last hop has left of them would take it
/// off.
void ContactArc::put_on_ring(int blade, Point& point) const {
  rotor::put_on_ring(*whole_, law_->geometry(blade), direction(blade, point.time),
                     whole_->blades.angular_speed(point.time), point.bodies);
}

/// Finds λ of the tip that skims, under the forces of the others.
void ContactArc::skim(std::span<Touch> touching, const Point& point) const {
  const rotor::ContactState state = state_at(point);
  Touch& skims = *std::ranges::find(touching, true, &Touch::skims);
  std::complex<double> others;
  for (const Touch& touch : touching) {
    if (!touch.skims) others += contact::on_rotor(force(touch, point), direction(touch.blade, point.time));
  }
  skims.share = 1.0;
  const contact::Geometry geometry = law_->geometry(skims.blade);
  const contact::Pose there = pose(skims.blade, point);
  skims.share = rotor::skimming_share(*whole_, geometry, direction(skims.blade, point.time), there, state,
                                      others, force(skims, point));
}

/// Takes from the shaft's velocity what is left of v of straight tips at rest at the end, which is not to
/// drift, and of a tip whose slip has reversed, the shortest way: its v does not jump where s changes, and
/// its sign would be taken for that of what follows.
void ContactArc::bring_to_rest(int reversed) {
  if (reversed == kNoBlade && leading().slip != 0.0 && tips_.size() == 1) return;
  std::vector<int> tips;
  for (const BladeStart& tip : tips_) {
    if (tip.slip == 0.0 && tip.number != reversed && is_straight(tip.number)) tips.push_back(tip.number);
  }
  if (reversed != kNoBlade) tips.push_back(reversed);
  rotor::ContactState state = state_at(end_);
  straight_tips_.bring_to_rest(tips, state);
  end_.bodies = rotor::bodies(state);
}

}  // namespace rubatlas::collocation
