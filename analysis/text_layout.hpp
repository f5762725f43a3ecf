/// Lines of a terminal. Widths are counted in characters, not in bytes, since the texts contain ζ, Ω and ×.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rubatlas::analysis {

/// Width of a text for the terminal.
constexpr std::size_t kColumns = 110;

/// Characters of a UTF-8 text.
[[nodiscard]] std::size_t character_count(std::string_view text);

/// `text` followed by blanks up to `width` characters, and by two at least.
std::string padded(std::string_view text, std::size_t width);

/// `text` broken at blanks into lines of up to `width` characters, the indentation included. The first line
/// begins with `label`, padded to `indentation`.
std::string paragraph(std::string_view label, std::string_view text, std::size_t indentation,
                      std::size_t width);

}  // namespace rubatlas::analysis
