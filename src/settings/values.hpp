/// Single values of a scene, held against the table of quantities.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "settings/quantity.hpp"

namespace rubatlas::settings {

/// The value that a quantity is given at a pointer. Throws SceneError where it is of another kind or outside
/// the quantity's range.
Value checked_value(const nlohmann::json& value, std::string_view pointer, const Quantity& entry);
/// The same of a number.
double checked_number(const nlohmann::json& value, std::string_view pointer, const Quantity& entry);

// For messages.

/// The range of a quantity, with its unit.
std::string with_unit(const Quantity& entry);
/// Words as a list, each in quotes.
std::string quoted(std::span<const std::string_view> words);

}  // namespace rubatlas::settings
