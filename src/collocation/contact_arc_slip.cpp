// How tips set out to slip, and what holds straight ones at rest.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <span>

#include "collocation/contact_arc.hpp"
#include "contact/sticking.hpp"
#include "rotor/skimming.hpp"

namespace rubatlas::collocation {

/// The sign of v where it starts from zero: that of s, or, of a straight tip that may slip back, of dv/dτ.
/// `acceleration`: of the shaft, seen from the ring.
void ContactArc::set_out(TipStart& tip, const std::complex<double>& acceleration) const {
  if (tip.slip == 0.0 || std::abs(tip.start_slip_velocity) > slip_rounding()) return;
  const double ahead = law_->may_slip_back() && is_straight(tip.number)
                           ? slip_acceleration(tip.number, end_, acceleration)
                           : tip.slip;
  tip.start_slip_velocity = std::copysign(std::numeric_limits<double>::min(), ahead);
}

/// The same of bent tips that may slip back, which the solved interval tells: their v follows from how they
/// bend.
void ContactArc::set_out_as_solved() {
  if (!law_->may_slip_back()) return;
  const double left = std::max(slip_rounding(), kClosest * tolerance_);
  for (std::size_t k = 0; k < tips_.size(); ++k) {
    BladeStart& tip = tips_[k];
    TipInTime& solved = trial().tips[k];
    if (tip.slip != 0.0 && !is_straight(tip.number) && slips_from_zero(tip.start_slip_velocity)) {
      const auto known =
          std::ranges::find_if(solved.slip_velocity.value, [left](double v) { return std::abs(v) > left; });
      if (known != solved.slip_velocity.value.end())
        tip.start_slip_velocity = std::copysign(tip.start_slip_velocity, *known);
    }
    solved.start_slip_velocity = tip.start_slip_velocity;
  }
}

/// dv/dτ of a straight tip under an acceleration of the shaft, seen from the ring.
double ContactArc::slip_acceleration(int blade, const Point& point,
                                     const std::complex<double>& acceleration) const {
  const contact::BladeDirection er = direction(blade, point.time);
  const contact::Geometry geometry = law_->geometry(blade);
  const std::complex<double> seen = acceleration * std::complex<double>(er.cosine, -er.sine);
  const double turning = geometry.reach * blades_->angular_acceleration(point.time);
  return contact::slip_acceleration(geometry, pose(blade, point), blades_->angular_speed(point.time),
                                    {seen.real(), seen.imag() + turning});
}

/// Direction of the slip of a straight tip.
std::complex<double> ContactArc::tangent(int blade, const Point& point) const {
  const contact::BladeDirection er = direction(blade, point.time);
  return contact::tangent(law_->geometry(blade), pose(blade, point)) *
         std::complex<double>(er.cosine, er.sine);
}

/// Finds c of rigid tips at rest among all that touch: those that take away dv/dτ of each.
void ContactArc::hold(std::span<Touch> touching, const Point& point) const {
  std::complex<double> sum;
  for (Touch& touch : touching) {
    touch.holding = 0.0;
    sum += contact::on_rotor(force(touch, point), direction(touch.blade, point.time));
  }
  const std::complex<double> acceleration =
      whole_->acceleration(rotor::full_state(point.bodies, point.time, 0.0), sum).shaft;
  std::array<contact::AtRest, contact::kMostAtRest> tips{};
  std::array<Touch*, contact::kMostAtRest> touches{};
  std::size_t count = 0;
  for (Touch& touch : touching) {
    if (touch.slip != 0.0 || count == contact::kMostAtRest) continue;
    touches[count] = &touch;
    tips[count++] = {tangent(touch.blade, point), slip_acceleration(touch.blade, point, acceleration)};
  }
  contact::share_out(std::span(tips).first(count));
  for (std::size_t i = 0; i < count; ++i)
    touches[i]->holding = tips[i].pull / (force(*touches[i], point).normal * rotor_->force_unit);
}

/// Finds λ of the tip that skims, under the forces of the others.
void ContactArc::skim(std::span<Touch> touching, const Point& point) const {
  const rotor::ContactState state = rotor::full_state(point.bodies, point.time, 0.0);
  Touch& skims = *std::ranges::find(touching, true, &Touch::skims);
  std::complex<double> others;
  for (const Touch& touch : touching) {
    if (!touch.skims) others += contact::on_rotor(force(touch, point), direction(touch.blade, point.time));
  }
  skims.share = 1.0;
  const contact::Geometry geometry = law_->geometry(skims.blade);
  const contact::Pose there = pose(skims.blade, point);
  skims.share = -rotor::free_gap_curvature(*whole_, geometry, direction(skims.blade, point.time), there,
                                           state, others) /
                rotor::pushed_gap_curvature(*whole_, geometry, there, force(skims, point));
}

/// The blade of the tip that skims, or none.
int ContactArc::skimming_blade() const {
  const auto skims = std::ranges::find(tips_, true, &TipStart::skims);
  return skims == tips_.end() ? kNoBlade : skims->number;
}

/// Takes from the shaft's velocity what is left of v of straight tips at rest at the end, which is not to
/// drift, and of a tip whose slip has reversed, the shortest way: its v does not jump where s changes, and
/// its sign would be taken for that of what follows.
void ContactArc::bring_to_rest(int reversed) {
  if (reversed == kNoBlade && leading().slip != 0.0 && tips_.size() == 1) return;
  std::array<contact::AtRest, contact::kMostAtRest> tips{};
  std::size_t count = 0;
  const auto take = [&](int blade) {
    if (count == contact::kMostAtRest) return;
    const double v = contact::undeformed_slip_velocity(law_->geometry(blade), pose(blade, end_),
                                                       blades_->angular_speed(end_.time));
    tips[count++] = {tangent(blade, end_), v};
  };
  for (const BladeStart& tip : tips_) {
    if (tip.slip == 0.0 && tip.number != reversed && is_straight(tip.number)) take(tip.number);
  }
  if (reversed != kNoBlade) take(reversed);
  contact::share_out(std::span(tips).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    end_.bodies[2] -= tips[i].pull * tips[i].tangent.real();
    end_.bodies[3] -= tips[i].pull * tips[i].tangent.imag();
  }
}

}  // namespace rubatlas::collocation
