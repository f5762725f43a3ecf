/// An unbalance on a shaft whose speed ripples, as a sum of harmonics.
#pragma once

#include <vector>

#include "rotor/harmonic.hpp"
#include "settings/effects/speed_ripple.hpp"

namespace rubatlas::rotor {

/// What an unbalance of me/m [m] at the phase γ becomes: side bands until they are below rounding.
std::vector<Harmonic> rippled_unbalance(const effects::SpeedRipple& ripple, double specific_moment,
                                        double phase, double speed_ratio, double damping_ratio);

}  // namespace rubatlas::rotor
