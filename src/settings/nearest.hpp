/// The known word that is closest to a mistyped one.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace rubatlas::settings {

/// Number of single-letter insertions, deletions, replacements and swaps of neighbours between two words.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known word at the smallest edit distance, the first of equals. `known` must not be empty.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

}  // namespace rubatlas::settings
