/// How an effect describes itself: its section of the scene with its quantities, its equation and source, how
/// flight is computed under the effect, and which invariants it breaks.
///
/// An effect is one struct of settings in one file, with
///     static constexpr Description kDescription;   what it is
///     static constexpr auto quantities();          a tuple of `Field<&Settings::member>`
///     bool acts() const;                           false at zero strength, which equals an absent effect
/// and one line in `list.hpp`. Reader, error texts, canonical text, sweeps, `explain` and the tables of the
/// documentation follow from this description.
#pragma once

#include <string_view>

#include "settings/range.hpp"

namespace rubatlas::effects {

struct Description {
  std::string_view section;   ///< of the scene, as a JSON pointer
  std::string_view meaning;   ///< one phrase
  std::string_view equation;  ///< what it adds to the equations of motion
  std::string_view source;    ///< MODEL section, or textbook
  std::string_view flight;    ///< how flight stays exact under it
  std::string_view breaks;    ///< invariants tested by `tests/hard` that do not hold under it; empty: none
};

/// What an effect remembers from point to point besides the state: numbers along one inner axis of the atlas,
/// in the dataset `/final_state_<effect>`. An effect that has such a memory says so by a member
///     static constexpr Memory kMemory;
/// Its length is that of the axis (`observables/list.hpp`): n for "blade", 4 for "component".
struct Memory {
  std::string_view inner_axis;
  std::string_view units;
  std::string_view long_name;
};

/// One quantity of an effect; its kind follows from the member's type.
template <auto Member>
struct Field {
  std::string_view pointer;  ///< where it stands in the scene file
  std::string_view symbol;
  std::string_view unit;
  std::string_view meaning;
  std::string_view source;
  settings::Range range{};
};

}  // namespace rubatlas::effects
