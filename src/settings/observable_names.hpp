/// The words that a scene may use under `observables`, in the order of the datasets in an atlas.
///
/// The reader checks a scene against these words. What each word means (unit, inner axes, the class that
/// computes the row) is in `observables/list.cpp`, which lists the same words in the same order; a test
/// compares the two lists.
#pragma once

#include <span>
#include <string_view>

namespace rubatlas::settings {

/// Every observable that an atlas can keep.
std::span<const std::string_view> observable_names();

/// The observables of a scene that names none.
std::span<const std::string_view> default_observable_names();

}  // namespace rubatlas::settings
