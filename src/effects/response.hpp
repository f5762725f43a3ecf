/// The motion of the free rotor under a forcing, and how forcings add up.
///
/// A forcing has
///     kPresent, amplitude()          a bound of the acceleration [m per unit τ²]
///     acceleration(time)             at time τ of the revolution
///     steady(time)                   the steady response, where it is known to exist
///     from_rest(start, elapsed, free, kernel)   the motion a time after rest at `start`, in closed form
#pragma once

#include <complex>
#include <optional>

#include "rotor/free_motion.hpp"

namespace rubatlas::effects {

/// Position [m] and velocity [m per unit τ], as x + iy.
struct Response {
  std::complex<double> position;
  std::complex<double> velocity;
};

/// A rotor on which nothing acts but shaft and ring.
class NoForcing {
 public:
  static constexpr bool kPresent = false;
};

/// Two forcings at once: the shaft is linear.
template <class First, class Second>
class Together {
 public:
  static constexpr bool kPresent = true;
  using Complex = std::complex<double>;

  Together(First first, Second second) : first_(first), second_(second) {}

  [[nodiscard]] double amplitude() const { return first_.amplitude() + second_.amplitude(); }
  [[nodiscard]] Complex acceleration(double time) const {
    return first_.acceleration(time) + second_.acceleration(time);
  }
  [[nodiscard]] std::optional<Response> steady(double time) const {
    const auto first = first_.steady(time);
    const auto second = second_.steady(time);
    if (!first || !second) return std::nullopt;
    return Response{first->position + second->position, first->velocity + second->velocity};
  }
  [[nodiscard]] Response from_rest(double start, double elapsed, const rotor::FreeMotion& free,
                                   const rotor::FreeMotion::Kernel& kernel) const {
    const Response first = first_.from_rest(start, elapsed, free, kernel);
    const Response second = second_.from_rest(start, elapsed, free, kernel);
    return {first.position + second.position, first.velocity + second.velocity};
  }

 private:
  First first_;
  Second second_;
};

}  // namespace rubatlas::effects
