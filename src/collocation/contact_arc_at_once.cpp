// Events that leave no interval to be made: contacts that are all but impacts, and guards that are met where
// an interval begins.

#include <algorithm>
#include <cmath>
#include <complex>

#include "collocation/contact_arc.hpp"

namespace rubatlas::collocation {

/// Whether a contact that begins at the ring lasts no longer than that, as first estimated.
bool ContactArc::is_shorter_than(double duration) const {
  if (!begins_ || machine().ring.is_massless() || predictor_.duration() > duration) return false;
  const double rounding = contact::gap_rounding(law_->geometry(blade_), pose(blade_, end_));
  return std::abs(at_end_.start_gap) <= rounding;
}

/// A contact that is shorter than times are rounded is an impact: nothing changes meanwhile but that its
/// force −F (n + c t) turns the tip's velocity along n round.
void ContactArc::rebound() {
  const Touch touch = touch_of(blade_, end_);
  const contact::Pose there = pose(blade_, end_);
  const contact::BladeDirection er = blades_->direction(blade_, blades_->first(end_.time));
  const double speed = blades_->angular_speed(end_.time);
  const std::complex<double> place =
      std::complex<double>(there.radial + numbers(blade_).reach, there.tangential) *
      std::complex<double>(er.cosine, er.sine);
  const double distance = std::abs(place);
  // It leaves the ring by no less than velocities are rounded, or it would stay there for ever.
  const double rounding = 1e-3 * slip_rounding();
  const double outwards =
      std::max(rounding, 0.5 * contact::gap_rate(law_->geometry(blade_), there, speed) / distance);
  const double coefficient = law_->friction_coefficient(touch, there, law_->force(touch, there, speed));
  const std::complex<double> change =
      -2.0 * outwards * place / distance * std::complex<double>(1.0, coefficient);
  const double shaft_share = rotor_->force_unit / whole_->closing_unit();
  end_.bodies[2] += shaft_share * change.real();
  end_.bodies[3] += shaft_share * change.imag();
  end_.bodies[6] -= (1.0 - shaft_share) * change.real();
  end_.bodies[7] -= (1.0 - shaft_share) * change.imag();
  end_at_once({Guard::under_load, 0.0, blade_, 0.0});
}

/// Whether the motion up to a guard that could not be located within the trial is no more than its error.
bool ContactArc::is_met_at_once(const Ending& ending) const {
  switch (guard_of_tip(ending.guard)) {
    case Guard::slip_reversal:
      if (!contact_.leans) return false;  // it would reverse again at once
      break;
    case Guard::fold:  // it has been passed by what sweeps leave
    case Guard::loosening:
    case Guard::shortening_limit:
    case Guard::shaft_at_ring:
      break;
    case Guard::unbent:
    case Guard::under_load: {
      if (machine().ring.is_massless()) return false;  // its velocity jumps
      const contact::Pose there = pose(blade_, end_);
      if (contact::gap_rate(law_->geometry(blade_), there, blades_->angular_speed(end_.time)) > 0.0)
        return false;
      break;
    }
    default:  // it would be met again at once
      return false;
  }
  return moves_little(std::max(0.0, ending.fraction) * trial().elapsed.at_end());
}

/// Whether shaft and ring move by less than the tolerance until then [τ from where the next interval begins].
bool ContactArc::moves_little(double late) const {
  const auto moved = [&](const Body& body) {
    const double velocity = std::hypot(body.start[2], body.start[3]);
    const double acceleration = std::hypot(body.ax[0], body.ay[0]);
    return std::abs(late) * std::max(velocity, acceleration);
  };
  return moved(trial().shaft) < tolerance_ && moved(trial().ring) < tolerance_;
}

/// Whether a blade moves off the ring that is all but unbent and has left it before anything has moved, or
/// that bends where the tolerance has already let its tip leave.
bool ContactArc::lifts_off_at_once() const {
  if (law_->is_rigid() || is_straight(blade_) || machine().ring.is_massless()) return false;
  if (law_->releases_at_fold(blade_)) return false;
  if (at_end_.start_gap > 0.0 && !(end_.bending.argument < kNextToUnbent)) return false;
  const double rate =
      contact::gap_rate(law_->geometry(blade_), pose(blade_, end_), blades_->angular_speed(end_.time));
  return rate < 0.0 && moves_little(-at_end_.start_gap / rate);
}

/// The next event is where the next interval would begin.
void ContactArc::end_at_once(const Ending& ending) {
  start_ = end_;
  ending_ = ending;
  ending_.fraction = 0.0;
}

/// The blade whose tip is at the ring where an arc begins, or beyond it by what the tolerance lets it, and
/// moves outwards. In a ring with dampers it is inside: it had lifted off there.
int ContactArc::touches_at_once() const {
  if (!begins_) return kNoBlade;
  for (const Other& other : others_) {
    const contact::Pose there = pose(other.blade, end_);
    const contact::Geometry geometry = law_->geometry(other.blade);
    const bool touches = law_->ends_at_ring() ? there.gap >= -contact::gap_rounding(geometry, there)
                                              : starts_inside(other.blade);
    if (touches && contact::gap_rate(geometry, there, blades_->angular_speed(end_.time)) > 0.0)
      return other.blade;
  }
  return kNoBlade;
}

}  // namespace rubatlas::collocation
