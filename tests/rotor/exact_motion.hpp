/// The rotor's linear motion as the exponential of its matrix, in 60-digit arithmetic: no closed form, no
/// case distinctions.
///
/// z'' + 2ζ z' + z = a e^{i(Ωτ + γ)}, z = x + iy, with the forcing turned by its own equation. Works at any
/// damping and any speed ratio, resonance included.
#pragma once

#include <complex>

namespace rubatlas::rotor {

/// z and z' [m, m per unit τ].
struct Motion {
  std::complex<double> position;
  std::complex<double> velocity;
};

/// Motion at τ > 0 from `start` at τ = 0; `forcing` is a e^{iγ} [m per unit τ²].
Motion exact_motion(double damping_ratio, double speed_ratio, const Motion& start,
                    std::complex<double> forcing, double time);

}  // namespace rubatlas::rotor
