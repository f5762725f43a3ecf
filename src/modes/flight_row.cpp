#include "modes/flight_row.hpp"

namespace rubatlas::modes {

FlightRow::FlightRow(const rotor::Machine& machine, double spacing)
    : misalignment_(machine.constants.misalignment),
      states_(machine, spacing),
      turn_(machine.blades, spacing) {
  if (const rotor::RingBody* body = machine.ring_body()) ring_.emplace(*body, spacing);
}

void FlightRow::start(double time, const rotor::ShaftAndRing& bodies, double fourth_bound) {
  start_ = rotor::from_ring(bodies);
  remainder_ = remainder(fourth_bound, spacing());
  states_.start(time, rotor::shaft(bodies));
  turn_.start(time);
  if (ring_) {
    const rotor::RingBody::State from = rotor::ring(bodies);
    ring_->free.move(from[0], from[2] / ring_->frequency, ring_->rx, ring_->rvx);
    ring_->free.move(from[1], from[3] / ring_->frequency, ring_->ry, ring_->rvy);
    ring_->rvx *= ring_->frequency;
    ring_->rvy *= ring_->frequency;
    ring_->x = states_.x() - ring_->rx;
    ring_->y = states_.y() - ring_->ry;
    ring_->vx = states_.vx() - ring_->rvx;
    ring_->vy = states_.vy() - ring_->rvy;
  }
  const Values& x = ring_ ? ring_->x : states_.x();
  const Values& y = ring_ ? ring_->y : states_.y();
  const Values& vx = ring_ ? ring_->vx : states_.vx();
  const Values& vy = ring_ ? ring_->vy : states_.vy();
  y_ = y + misalignment_;
  square_ = x * x + y_ * y_;
  square_rate_ = 2.0 * (x * vx + y_ * vy);
}

rotor::ShaftAndRing FlightRow::state(int i) const {
  rotor::ShaftAndRing bodies = rotor::shaft_and_ring(states_.state(i));
  if (ring_) bodies.tail<4>() << ring_->rx[i], ring_->ry[i], ring_->rvx[i], ring_->rvy[i];
  return bodies;
}

}  // namespace rubatlas::modes
