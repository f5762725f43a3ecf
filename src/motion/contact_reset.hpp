/// Resets of one contact: what becomes of its unknowns where it opens, snaps, reverses its slip, or goes on
/// after a change of the machine. There is one specialisation for each kind of blade.
///
/// Rigid blades have no unknowns. Blades under an axial load have the bending parameter u, whose root is
/// looked for here (MODEL 4.1 and 4.2). Blades under an inclined load have κ and φ, which the mode that
/// begins finds where it opens (`modes/carried_bends.hpp`).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "contact/pose.hpp"
#include "modes/open_contact.hpp"

namespace rubatlas::motion {

/// Blades with the two unknowns κ and φ, instead of the bending parameter u alone.
template <class Blade>
concept HasTwoUnknowns = requires {
  &Blade::Drift::misdirection;
};

/// What has become of a contact: it stands in equilibrium, it is free, or neither (MODEL 5).
enum class Standing : std::uint8_t { stands, free, lost };

/// Where the tip of a contact is: its pose, and dφ/dτ there.
struct TipPlace {
  contact::Pose pose;
  double speed;
};

/// A reset has nothing to find: the force follows from the gap, or the mode that begins finds it.
struct ResetWithoutUnknowns {
  static constexpr bool kCarries = false;
  template <class Blade>
  static bool open(const Blade& /*blade*/, const TipPlace& /*at*/, modes::OpenContact& /*contact*/) {
    return true;
  }
  template <class Blade>
  static Standing keep(const Blade& /*blade*/, const TipPlace& at, modes::OpenContact& /*contact*/) {
    return at.pose.gap <= 0.0 ? Standing::free : Standing::stands;
  }
  template <class Blade>
  static Standing snap(const Blade& /*blade*/, const TipPlace& /*at*/, modes::OpenContact& /*contact*/) {
    return Standing::lost;
  }
  template <class Blade>
  static bool bend_anew(const Blade& /*blade*/, const TipPlace& /*at*/, modes::OpenContact& /*contact*/) {
    return true;
  }
  template <class Blade>
  static bool straightens(const Blade& /*blade*/, const TipPlace& /*at*/, modes::OpenContact& /*contact*/) {
    return false;
  }
};

/// For rigid blades.
template <class Blade>
struct ContactReset : ResetWithoutUnknowns {};

/// For blades whose bending parameter can be carried as a state.
template <class Blade>
requires Blade::kHasBending struct ContactReset<Blade> {
  static constexpr bool kCarries = true;

  /// A contact opens on the approaching side from zero force, on the receding side from a finite one (MODEL
  /// 4.2). False where no force exists (MODEL 5).
  static bool open(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
        blade.starts_unloaded(at.pose, contact.slip))
      return true;
    const auto root = blade.solve(at.pose, contact.slip);
    if (root) contact.bending = *root;
    return root.has_value();
  }

  /// Goes on where the tip stands now, after a change of the blade or of its speed.
  static Standing keep(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    const bool outside = at.pose.gap <= 0.0;
    if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
        blade.ends_unloaded(at.pose, contact.slip, contact.bending)) {
      contact.bending = 0.0;
      return outside ? Standing::free : Standing::stands;
    }
    if (outside && !blade.releases_at_fold()) return Standing::free;
    const auto root = contact.bending > 0.0 ? follow(blade, at, contact) : blade.solve(at.pose, contact.slip);
    if (!root) return outside ? Standing::free : Standing::lost;
    contact.bending = *root;
    return Standing::stands;
  }

  /// The bending of a contact where its tip stands now: on its branch, or on the next one where a change of
  /// the blade or of its speed, or rounding next to a fold, has taken it past the end.
  static std::optional<double> follow(const Blade& blade, const TipPlace& at,
                                      const modes::OpenContact& contact) {
    const auto root = blade.solve_near(at.pose, contact.slip, contact.bending);
    if (root || !blade.has_branches()) return root;
    return blade.snap(at.pose, contact.slip, contact.bending, at.speed);
  }

  /// Goes from the end of a branch to the next equilibrium in the direction in which the blade moves. Where
  /// there is none, the blade is free if the ring opens and the undeformed tip is outside it.
  static Standing snap(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    const auto root = blade.snap(at.pose, contact.slip, contact.bending, at.speed);
    if (root) {
      contact.bending = *root;
      return Standing::stands;
    }
    const bool free =
        at.pose.gap <= 0.0 && !blade.closes_in(at.pose, contact.slip, contact.bending, at.speed);
    return free ? Standing::free : Standing::lost;
  }

  /// Finds the bending after a change of the slip direction. False where there is none.
  static bool bend_anew(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    const auto root = blade.solve(at.pose, contact.slip);
    contact.bending = root.value_or(0.0);
    return root.has_value();
  }

  /// A column whose u has come to 0 while its tip is still in the ring (g > 0) stands straight from there on.
  static bool straightens(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    if (blade.carried() || at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose)) return false;
    contact.bending = 0.0;
    return true;
  }
};

/// For blades under an inclined load.
template <class Blade>
requires HasTwoUnknowns<Blade>
struct ContactReset<Blade> : ResetWithoutUnknowns {
  /// Snaps to another equilibrium on the side to which the blade is bent, or, where there is none, to one on
  /// the other side.
  static Standing snap(const Blade& blade, const TipPlace& at, modes::OpenContact& contact) {
    constexpr double kSame = 1e-3;  // of κ: a root so close to the fold is the one that ends there
    const double modulus = contact.bend.modulus;
    const double side = std::copysign(1.0, modulus);
    auto root = blade.solve(at.pose, contact.slip, at.speed, side);
    if (root && std::abs(root->modulus - modulus) < kSame * std::abs(modulus)) root = std::nullopt;
    if (!root) root = blade.solve(at.pose, contact.slip, at.speed, -side);
    if (!root) return Standing::lost;
    contact.bend = *root;
    return Standing::stands;
  }
};

}  // namespace rubatlas::motion
