/// Blades in contact: where they stand between two intervals, and the first guess of what the further ones,
/// which do not lead, do in the next.
#pragma once

#include "blade/inclined_elastica.hpp"
#include "collocation/interval.hpp"
#include "contact/elastica_contact.hpp"
#include "rotor/bodies.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::collocation {

/// A blade that touches the ring.
struct Touch {
  int blade;
  double slip;             ///< s = ±1
  double bending;          ///< u of a blade under an axial load; 0: it touches down
  blade::Bend bend{};      ///< κ and φ of a blade under an inclined load; φ = 0: it touches down
  double holding = 0.0;    ///< c of a rigid tip at rest
  double yielding = 0.0;   ///< y of a ring with dampers under the tip [m]
  bool straight = false;   ///< as in `TipStart`
  bool skims = false;      ///< it stays on the ring under a share of its force (MODEL 4.9)
  double share = 1.0;      ///< λ of such a tip
  bool just_bent = false;  ///< the load of a ring with dampers has, from u = 0 at once

  [[nodiscard]] bool touches_down() const { return bending == 0.0 && bend.amplitude == 0.0 && !straight; }
};

/// How a quantity goes on in τ.
struct Course {
  double value = 0.0;
  double rate = 0.0;
  double half_curvature = 0.0;  ///< half of its second derivative

  [[nodiscard]] double after(double elapsed) const {
    return value + elapsed * (rate + elapsed * half_curvature);
  }
};

/// One of them where the next interval starts.
struct BladeStart : TipStart {
  /// d(R + y)²/dτ of a ring with dampers [m² per unit τ], where the contact, or its leader, is new.
  double ring_opens = 0.0;
  // Of a further blade. p² is smooth in time where p starts from 0.
  Course square{};  ///< p²
  Course lean{};    ///< l of a blade under an inclined load
};

/// How a quantity goes on from the end of an interval, as the last three nodes have it.
Course course_at_end(const Interval& made, const AtNodes& nodes);
/// A blade there, from the end of the interval. `further`: it does not lead.
void go_on(const Interval& made, const TipInTime& tip, bool further, BladeStart& start);

/// τ since the start of an interval, as its arc has been guessed.
AtNodes guessed_times(const Interval& next);
/// First guess of a further blade where that of the times is known.
void guess(const BladeStart& start, const AtNodes& elapsed, TipInTime& tip);

}  // namespace rubatlas::collocation
