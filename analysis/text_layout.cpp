#include "analysis/text_layout.hpp"

#include <algorithm>

namespace rubatlas::analysis {

std::size_t character_count(std::string_view text) {
  // Every byte but the continuation bytes 10xxxxxx begins a character.
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(std::string_view text, std::size_t width) {
  const std::size_t count = character_count(text);
  return std::string(text) + std::string(std::max<std::size_t>(width, count + 2) - count, ' ');
}

std::string paragraph(std::string_view label, std::string_view text, std::size_t indentation,
                      std::size_t width) {
  std::string result = padded(label, indentation);
  std::size_t column = character_count(result);
  bool fresh = true;
  while (!text.empty()) {
    const auto blank = text.find(' ');
    const auto word = text.substr(0, blank);
    text = blank == std::string_view::npos ? std::string_view{} : text.substr(blank + 1);
    const std::size_t needed = character_count(word) + (fresh ? 0 : 1);
    if (!fresh && column + needed > width) {
      result += "\n" + std::string(indentation, ' ');
      column = indentation;
      fresh = true;
    }
    if (!fresh) result += ' ';
    result += word;
    column += character_count(word) + (fresh ? 0 : 1);
    fresh = false;
  }
  return result + "\n";
}

}  // namespace rubatlas::analysis
