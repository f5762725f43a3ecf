/// What the methods of integration do, one row each: `explain` tells it, and what combines follows from it.
#pragma once

#include <string_view>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// What a method of integration does (`Accuracy::method`).
struct MethodOfIntegration {
  Method method;
  bool takes_effects;         ///< besides the unbalance
  bool flies_in_closed_form;  ///< else flight is integrated in steps, too
  bool keeps_tolerance;       ///< else all steps of a revolution have the same size
  std::string_view pair;      ///< the Runge–Kutta method
  std::string_view guards;    ///< how touch-down, lift-off and slip reversal are found
  std::string_view force;     ///< how a blade's force is found; empty: as `Family::contact` says
};
const MethodOfIntegration& method_of(const Scene& scene);

}  // namespace rubatlas::settings
