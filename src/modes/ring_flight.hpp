/// Flight of a shaft and a ring body, both in closed form, with the interface of `Flight`: while no blade
/// touches, shaft and ring move independently. The search for touch-downs needs the shaft's motion as seen
/// from the ring.
#pragma once

#include <algorithm>
#include <complex>

#include "modes/flight.hpp"
#include "rotor/bodies.hpp"
#include "rotor/ring_body.hpp"

namespace rubatlas::modes {

/// Bounds of shaft and ring while they fly.
struct ShaftAndRingBound {
  double shaft;          ///< of |z| and |z'|
  double ring_position;  ///< of |r|
  double ring_velocity;  ///< of |r'|, and of the ring's energy norm
};
inline double position_bound(const ShaftAndRingBound& bound) {
  return bound.shaft + bound.ring_position;
}
inline double velocity_bound(const ShaftAndRingBound& bound) {
  return bound.shaft + bound.ring_velocity;
}

/// Flight of a shaft in a ring without mass, which stays at its place of rest: all of it is the shaft's.
template <class ShaftForcing>
class Flight<rotor::WithFollowingRing<ShaftForcing>> {
 public:
  using OfShaft = Flight<ShaftForcing>;
  using Complex = std::complex<double>;

  Flight(const rotor::RotorConstants& rotor, const rotor::FreeMotion& free,
         const rotor::WithFollowingRing<ShaftForcing>& forcing)
      : Flight(rotor, free, forcing.shaft) {}

  void start(double time, const rotor::ShaftAndRing& bodies) { shaft_.start(time, rotor::shaft(bodies)); }
  [[nodiscard]] bool is_isotropic() const { return shaft_.is_isotropic(); }
  [[nodiscard]] double start_time() const { return shaft_.start_time(); }
  [[nodiscard]] rotor::ShaftAndRing state(double time) const {
    return rotor::ring_at_rest<rotor::WithFollowingRing<ShaftForcing>>(shaft_.state(time));
  }
  /// z'' − r'' [m per unit τ²].
  [[nodiscard]] Complex acceleration(double time, const rotor::ShaftAndRing& bodies) const {
    return shaft_.acceleration(time, rotor::shaft(bodies));
  }
  [[nodiscard]] auto amplitude_bound(double time, const rotor::ShaftAndRing& bodies, double horizon) const {
    return shaft_.amplitude_bound(time, rotor::shaft(bodies), horizon);
  }
  /// Bound of |z|.
  [[nodiscard]] double displacement_bound(double time, const rotor::ShaftAndRing& bodies,
                                          double horizon) const {
    return shaft_.displacement_bound(time, rotor::shaft(bodies), horizon);
  }
  /// Bound of |z − r|.
  [[nodiscard]] double bound_from_ring(double time, const rotor::ShaftAndRing& bodies, double horizon) const {
    return displacement_bound(time, bodies, horizon);
  }
  template <class Bound>
  [[nodiscard]] double second_bound(const Bound& bound) const {
    return shaft_.second_bound(bound);
  }
  template <class Bound>
  [[nodiscard]] double third_bound(const Bound& bound) const {
    return shaft_.third_bound(bound);
  }
  [[nodiscard]] double forcing_bound() const { return shaft_.forcing_bound(); }
  [[nodiscard]] double time_of_bound() const { return modes::time_of_bound(shaft_); }
  [[nodiscard]] std::int64_t price_of_state() const { return modes::price_of_state(shaft_); }
  [[nodiscard]] bool resolves(double time) const { return shaft_.resolves(time); }

 protected:
  Flight(const rotor::RotorConstants& rotor, const rotor::FreeMotion& free, const ShaftForcing& forcing)
      : shaft_(rotor, free, forcing) {}

  OfShaft shaft_;
};

/// The same of a shaft and a ring that is a body: what depends on where the ring is has its share.
template <class ShaftForcing>
class Flight<rotor::WithRingBody<ShaftForcing>> : public Flight<rotor::WithFollowingRing<ShaftForcing>> {
 public:
  using Base = Flight<rotor::WithFollowingRing<ShaftForcing>>;
  using typename Base::Complex;

  Flight(const rotor::RotorConstants& rotor, const rotor::FreeMotion& free,
         const rotor::WithRingBody<ShaftForcing>& forcing)
      : Base(rotor, free, forcing.shaft), ring_(&forcing.ring) {}

  void start(double time, const rotor::ShaftAndRing& bodies) {
    Base::start(time, bodies);
    ring_start_ = rotor::ring(bodies);
  }
  [[nodiscard]] bool is_isotropic() const { return false; }  // the ring moves, too
  [[nodiscard]] rotor::ShaftAndRing state(double time) const {
    rotor::ShaftAndRing bodies;
    bodies << this->shaft_.state(time), ring_->free(ring_start_, time - this->start_time());
    return bodies;
  }
  [[nodiscard]] Complex acceleration(double time, const rotor::ShaftAndRing& bodies) const {
    return Base::acceleration(time, bodies) - ring_->acceleration(rotor::ring(bodies), 0.0);
  }
  [[nodiscard]] ShaftAndRingBound amplitude_bound(double time, const rotor::ShaftAndRing& bodies,
                                                  double horizon) const {
    const double norm = ring_->energy_norm(rotor::ring(bodies));
    return {Base::amplitude_bound(time, bodies, horizon), norm / ring_->frequency(), norm};
  }
  [[nodiscard]] double bound_from_ring(double time, const rotor::ShaftAndRing& bodies, double horizon) const {
    return this->displacement_bound(time, bodies, horizon) +
           ring_->energy_norm(rotor::ring(bodies)) / ring_->frequency();
  }
  [[nodiscard]] double second_bound(const ShaftAndRingBound& bound) const {
    return this->shaft_.second_bound(bound.shaft) + ring_->second_bound(bound.ring_velocity);
  }
  [[nodiscard]] double third_bound(const ShaftAndRingBound& bound) const {
    return this->shaft_.third_bound(bound.shaft) + ring_->third_bound(bound.ring_velocity);
  }

 private:
  const rotor::RingBody* ring_;
  rotor::RingBody::State ring_start_ = rotor::RingBody::State::Zero();
};

}  // namespace rubatlas::modes
