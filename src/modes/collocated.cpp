#include "modes/collocated.hpp"

#include "modes/friction_power.hpp"

namespace rubatlas::modes {

bool Collocated::start(double time, const Bodies& state, const std::vector<OpenContact>& contacts) {
  if (contacts.size() != 1) return false;
  contact_ = contacts.front();
  pending_ = false;
  start_ = rotor::full_state(state, time, contact_.bending);
  if (applies_) arc_.begin(time, state, contact_.blade, contact_.slip, contact_.bending);
  return true;
}

ModeEnd Collocated::advance(double until, MotionListener& listener) {
  if (!applies_) return {Guard::hands_over, contact_.blade};
  while (true) {
    if (pending_) {
      const double end = arc_.end().time;
      const bool beyond = end > until;
      piece_end_ = beyond ? until : end;
      if (piece_end_ > piece_begin_) listener.piece(*this);
      if (meter_->ended()) return {Guard::failed, -1, meter_->why()};
      piece_begin_ = piece_end_;
      if (beyond) return {Guard::horizon};
      pending_ = false;
      if (arc_.lifts_off()) return {Guard::lift_off, contact_.blade};
    }
    if (!meter_->spend(Work::contact, WorkPrice::kAttempt + WorkPrice::kForce))
      return {Guard::failed, -1, meter_->why()};
    if (arc_.make() == collocation::ContactArc::Outcome::gives_up) return {Guard::hands_over, contact_.blade};
    pending_ = true;
    piece_begin_ = arc_.start().time;
  }
}

void Collocated::shift_time(double period) {
  arc_.shift_time(period);
  piece_begin_ -= period;
  piece_end_ -= period;
}

Collocated::FullState Collocated::end_state() const {
  if (!applies_) return start_;
  const auto& end = arc_.end();
  return rotor::full_state(end.state, end.time, arc_.bending(end.argument));
}
OpenContact Collocated::contact_at_end(std::size_t /*contact*/) const {
  OpenContact open = contact_;
  if (applies_) open.bending = arc_.bending(arc_.end().argument);
  return open;
}
OpenContact Collocated::contact_at(std::size_t /*contact*/, double time) const {
  OpenContact open = contact_;
  open.bending = arc_.bending_at(arc_.fraction_at(time));
  return open;
}

double Collocated::place_x(double time) {
  return arc_.place_at(arc_.fraction_at(time))[0];
}

contact::TipForce Collocated::force(double time) {
  const contact::BladeDirection er = blades_->direction(contact_.blade, blades_->first(time));
  const contact::Pose pose = rotor::pose_of(*rotor_, law_->geometry(), er, arc_.state_at(time));
  // The state is accurate at any time, the bending between the nodes is not: it follows from h = 0.
  double bending = arc_.bending_at(arc_.fraction_at(time));
  if (bending > 0.0) bending = law_->solve_near(pose, contact_.slip, bending).value_or(bending);
  return law_->constraint(pose, contact_.slip, bending, rotor_->speed_ratio).force;
}
double Collocated::normal_force(std::size_t /*contact*/, double time) {
  return force(time).normal;
}
double Collocated::root_strain(std::size_t /*contact*/, double time) {
  return force(time).root_strain;
}
double Collocated::friction_power(std::size_t /*contact*/, double time) {
  return modes::friction_power(*law_, force(time));
}

}  // namespace rubatlas::modes
