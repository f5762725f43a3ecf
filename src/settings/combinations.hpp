/// The one table of what combines with what: effects, contact laws and methods of integration.
///
/// The reader refuses a scene by `refusal_of_combination`. The solver and `explain` ask
/// `combination_of` which family of motions a line of the scene has, and which effects these motions consume.
/// A family is a row of `families()`; it takes a line if the contact law is among its laws and all acting
/// effects are among those that it consumes. The first family that takes the line computes it, so that a
/// motion does no work for effects that do not act. A test compares the two lists: a scene is refused if and
/// only if no family takes it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// A set of effects of the list (`effects/list.hpp`).
class EffectSet {
 public:
  constexpr EffectSet() = default;

  template <auto Effect>
  [[nodiscard]] constexpr bool contains() const {
    return (bits_ & bit<Effect>()) != 0;
  }
  template <auto Effect>
  constexpr void insert() {
    bits_ |= bit<Effect>();
  }
  /// By the place in `effects::listed`.
  [[nodiscard]] bool contains(std::size_t place) const { return (bits_ >> place & 1U) != 0; }
  void insert(std::size_t place) { bits_ |= 1U << place; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool is_within(EffectSet other) const { return (bits_ & ~other.bits_) == 0; }

  constexpr friend EffectSet operator|(EffectSet a, EffectSet b) { return EffectSet(a.bits_ | b.bits_); }
  constexpr friend EffectSet operator&(EffectSet a, EffectSet b) { return EffectSet(a.bits_ & b.bits_); }
  /// The effects of `a` that are not in `b`.
  constexpr friend EffectSet operator-(EffectSet a, EffectSet b) { return EffectSet(a.bits_ & ~b.bits_); }
  friend bool operator==(EffectSet, EffectSet) = default;

  /// Sections of these effects in the scene, in the order of the list, for example "/unbalance".
  [[nodiscard]] std::vector<std::string_view> sections() const;

 private:
  constexpr explicit EffectSet(std::uint32_t bits) : bits_(bits) {}

  /// 0 for an effect that the build leaves out.
  template <auto Effect>
  static constexpr std::uint32_t bit() {
    std::uint32_t found = 0;
    std::uint32_t next = 1;
    effects::for_each_effect([&]<auto Other>() {
      if constexpr (std::is_same_v<effects::Settings<Other>, effects::Settings<Effect>>) found = next;
      next <<= 1U;
    });
    return found;
  }

  std::uint32_t bits_ = 0;
};

template <auto... Effect>
constexpr EffectSet effect_set() {
  EffectSet result;
  (result.insert<Effect>(), ...);
  return result;
}

/// Effects whose section the scene has, whatever their strength.
EffectSet given(const Scene& scene);

/// The ring is a body without mass at some point of the grid.
bool ring_has_no_mass(const Scene& scene);

/// Effects that have nothing to act on without friction: no tip sticks, and there is no friction to be
/// regularised.
constexpr EffectSet kNeedFriction =
    effect_set<&effects::Effects::regularised_friction, &effects::Effects::stick>();

/// Effects that act on a line: present, of a strength that is not zero, and with something to act on.
EffectSet acting(const Scene& line);

/// Why the effects, contact law and method of the scene cannot be combined, as an error text that starts with
/// a JSON pointer: the first row of the table of refusals that applies. None where the scene can be computed.
std::optional<std::string> refusal_of_combination(const Scene& scene);

/// The kinds of motions, as `explain` tells them apart: by the law of contact and by what acts.
enum class MotionFamily : std::uint8_t {
  paper_s_rotor,
  rigid_blades,
  sticking_rigid_blades,
  elastic_blades,
  directed_elastic_blades,
  sticking_elastic_blades,
  blades_on_damped_ring,
  blades_in_ring_body,
  blades_in_ring_without_mass,
};

/// How contact is computed, in plain words.
struct ContactText {
  std::string_view on_arcs;   ///< by collocation
  std::string_view in_steps;  ///< by any other method
};

/// One row of the table.
struct Family {
  MotionFamily kind;
  std::string_view name;         ///< in plain words
  std::vector<ContactLaw> laws;  ///< contact laws that the family is for
  EffectSet consumes;            ///< effects that its motions can compute
  bool (*is_for)(const Scene&);  ///< a further condition on the line; null: none
  ContactText contact;
  std::string_view flight;  ///< what moves in flight besides the shaft; empty: nothing

  [[nodiscard]] bool takes(const Scene& line) const;
};

/// In the order in which they are tried.
std::span<const Family> families();

/// Support of the shaft and drive of the rotor, for the families that compute effects.
enum class Machine : std::uint8_t {
  isotropic_shaft,     ///< at a constant speed
  any_linear_support,  ///< at a speed that may ripple
};

/// How one line is computed.
struct Combination {
  const Family* family = nullptr;  ///< never null
  Machine machine = Machine::isotropic_shaft;
  EffectSet consumed;  ///< effects that the motion computes: the acting ones

  friend bool operator==(const Combination&, const Combination&) = default;
};

/// `line`: a scene with the line's values of all swept quantities. Throws std::logic_error where no family
/// takes the line; the reader refuses such scenes.
Combination combination_of(const Scene& line);

/// The combinations that the lines of a scene have, each once.
std::vector<Combination> combinations_in(const Scene& scene);

}  // namespace rubatlas::settings
