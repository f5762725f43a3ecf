/// The rotors that the paper's statements are about: what an atlas must have in common with them.
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

/// A rotor of the paper, as a scene, and how much of that scene a statement needs.
struct ReferenceRotor {
  std::string name;       ///< "the paper's default rotor"
  settings::Scene scene;  ///< its quantities
  /// JSON pointers of the quantities that an atlas must share where it does not sweep them.
  std::vector<std::string_view> fixed;
  /// Axes whose value the paper does not give, or gives without meaning it: a statement is judged once for
  /// each of their values.
  std::vector<std::string_view> open;
  /// Quantities that agree within the digits of the paper. All others agree as decimals do: the clearance is
  /// the difference of three lengths, and a hundredth of a millimetre is the whole reach of the rig's blades.
  std::vector<Rounded> rounded{};

  /// Why a scene is another rotor; empty when it is this one. Effects that the rotor has not (a side load)
  /// make it another one.
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

/// Decimals as binary64: nine digits tell values apart and forgive rounding.
[[nodiscard]] bool same_decimal(double a, double b);

}  // namespace rubatlas::analysis
