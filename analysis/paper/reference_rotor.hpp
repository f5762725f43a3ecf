/// The rotors of the paper's statements, and the quantities that an atlas has to share with them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "settings/scene.hpp"

namespace rubatlas::analysis {

/// A quantity that the paper gives rounded, and half a unit of its last digit.
struct Rounded {
  std::string_view pointer;
  double half_digit;
};

/// A rotor of the paper as a scene, and the quantities of this scene that matter for a statement.
struct ReferenceRotor {
  std::string name;       ///< "the paper's default rotor"
  settings::Scene scene;  ///< its quantities
  /// JSON pointers of the quantities that an atlas has to share, unless it sweeps them.
  std::vector<std::string_view> fixed;
  /// Axes whose value the paper does not give, or does not rely on. A statement is judged once for each of
  /// their values.
  std::vector<std::string_view> open;
  /// Quantities that have to agree within the digits of the paper. All others have to agree as decimals: the
  /// clearance is the difference of three lengths, and the rig's blades reach into the ring by a hundredth of
  /// a millimetre only.
  std::vector<Rounded> rounded{};

  /// The reason why a scene is another rotor; empty when it is this one. A scene with an effect that this
  /// rotor does not have (a side load, say) is another rotor.
  [[nodiscard]] std::string difference(const settings::Scene& other) const;
  /// Whether a quantity has this rotor's value, within the digits in which the paper gives it.
  [[nodiscard]] bool agrees(std::string_view pointer, double value, double own) const;
  /// Value of an axis in this rotor; 0 for an absent effect and for the direction (up).
  [[nodiscard]] double usual(std::string_view axis) const;
};

/// MODEL 6.1. Open: stiffness of the ring, phase of the unbalance, direction of the sweep.
ReferenceRotor default_rotor();
/// The default rotor with any number of blades.
ReferenceRotor default_rotor_of_any_count();
/// MODEL 6.2. Open besides: modal mass and friction, which the paper does not give.
ReferenceRotor test_rig();

/// Compares decimals stored as binary64 within nine digits, which is closer than any two values of a grid and
/// wider than their rounding.
[[nodiscard]] bool same_decimal(double a, double b);

}  // namespace rubatlas::analysis
