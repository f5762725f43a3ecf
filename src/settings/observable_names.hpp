/// The words that a scene's list `observables` may hold, in the order in which an atlas keeps them.
///
/// The observables themselves live one folder on; only their names are here, so that a scene can be checked
/// without linking what computes them.
#pragma once

#include <span>
#include <string_view>

namespace rubatlas::settings {

/// Every observable that an atlas can keep.
std::span<const std::string_view> observable_names();

/// Those that an atlas keeps when the scene does not say.
std::span<const std::string_view> default_observable_names();

}  // namespace rubatlas::settings
