/// A parameter of an atlas as it is written in a text: symbol, value, unit.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "plan/grid.hpp"

namespace rubatlas::analysis {

struct Parameter {
  std::string name;            ///< of the axis, for example damping_ratio
  std::string symbol;          ///< ζ; the name where there is none
  std::string unit;            ///< as shown, empty where dimensionless
  double factor = 1.0;         ///< from the file's unit to the one shown
  std::vector<double> values;  ///< ascending, in the file's unit

  /// "0.1", "0.5 mm", "1e-05 kg m", and for the direction "up".
  [[nodiscard]] std::string value_text(double value) const;
  /// "ζ = 0.1".
  [[nodiscard]] std::string text(double value) const;
  /// The given values, picked out of the axis: "at every ζ", "at ζ ≤ 0.02", "at ζ ≥ 0.2", "at ζ = 0.05, 0.1".
  [[nodiscard]] std::string where(std::span<const double> picked, std::span<const double> from) const;
};

/// One for each axis except the last (the speed ratio), in their order.
std::vector<Parameter> parameters_of(std::span<const plan::Axis> axes);

/// A length as text: "15.4 mm".
std::string millimetres(double metres);

}  // namespace rubatlas::analysis
