/// The displacement that a user does not want to be passed: `--limit "0.5 mm"`, `--limit "0.5 clearances"`.
#pragma once

#include <optional>
#include <string_view>

#include "settings/scene.hpp"

namespace rubatlas::analysis {

struct DisplacementLimit {
  double number = 0.5;
  double unit = 0.0;  ///< [m]; 0: the clearance, or L/10 where there is none

  [[nodiscard]] double metres(const settings::Scene& scene) const;
};

constexpr const char* kLimitAllowed =
    "a number above zero with its unit, m, mm, um, µm or clearances, such as \"0.5 mm\"";

/// None for a text that is not what `kLimitAllowed` says.
[[nodiscard]] std::optional<DisplacementLimit> parse_limit(std::string_view text);

}  // namespace rubatlas::analysis
