/// The automaton of a blade (MODEL 4.10): its modes, the guards that end them, what the reset does, and the
/// mode that follows. Where two rows have one mode and one guard, the reset decides by the place of the tip.
///
/// The page has the same table; a test compares the two, and another one follows the events of random motions
/// through the rows.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "modes/motion_listener.hpp"

namespace rubatlas::motion {

enum class BladeMode : std::uint8_t {
  free,   ///< no contact
  slips,  ///< on the ring, bent where it bends: friction has the direction s
  rests,  ///< on the ring without slip, held by friction
  stands  ///< straight on the ring: the column below its Euler load; on dampers, under too small a load; or
          ///< it skims (MODEL 4.9)
};

struct Transition {
  BladeMode mode;
  modes::Guard guard;
  std::string_view reset;
  BladeMode next;
  bool told;  ///< to the listeners of the motion, as an event
};

inline constexpr std::array kTransitions{
    Transition{BladeMode::free, modes::Guard::touch_down,
               "s from the slip of the tip; the first root of h = 0", BladeMode::slips, true},
    Transition{BladeMode::free, modes::Guard::touch_down, "c that holds the tip", BladeMode::rests, true},
    Transition{BladeMode::free, modes::Guard::touch_down, "s likewise; no load that bends the blade",
               BladeMode::stands, true},
    Transition{BladeMode::slips, modes::Guard::lift_off, "the contact closes", BladeMode::free, true},
    Transition{BladeMode::slips, modes::Guard::lift_off, "the blade is unbent, the tip still in the ring",
               BladeMode::stands, false},
    Transition{BladeMode::slips, modes::Guard::slip_reversal, "s becomes −s; the first root of h = 0",
               BladeMode::slips, true},
    Transition{BladeMode::slips, modes::Guard::slip_reversal, "c that holds the tip", BladeMode::rests, true},
    Transition{BladeMode::slips, modes::Guard::snap, "the next root of h = 0", BladeMode::slips, true},
    Transition{BladeMode::slips, modes::Guard::snap, "the straight column", BladeMode::stands, true},
    Transition{BladeMode::rests, modes::Guard::comes_loose, "s from the pull, or the larger s v",
               BladeMode::slips, true},
    Transition{BladeMode::rests, modes::Guard::lift_off, "the contact closes", BladeMode::free, true},
    Transition{BladeMode::stands, modes::Guard::pressed_in, "the blade bends under its load",
               BladeMode::slips, false},
    Transition{BladeMode::stands, modes::Guard::snap, "the bent root of h = 0", BladeMode::slips, true},
    Transition{BladeMode::stands, modes::Guard::slip_reversal, "s becomes −s", BladeMode::stands, true},
    Transition{BladeMode::stands, modes::Guard::lift_off, "the contact closes", BladeMode::free, true},
};

}  // namespace rubatlas::motion
