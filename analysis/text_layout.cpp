#include "analysis/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubatlas::analysis {

std::size_t character_count(std::string_view text) {
  // Every byte but the continuation bytes 10xxxxxx begins a character.
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(std::string_view text, std::size_t width) {
  return fmt::format("{:<{}}", text, std::max(width, character_count(text) + 2));
}

namespace {

/// Words that stay on the line of the word before them: "ζ = 0.1", "17 mm", "4 %".
bool belongs_to_the_word_before(std::string_view word) {
  static constexpr std::array<std::string_view, 7> kWords{"=", "≤", "≥", "%", "mm", "kg", "m"};
  const auto bare = word.substr(0, std::min(word.size(), word.find_last_not_of(",;.):") + 1));
  return std::ranges::find(kWords, bare) != kWords.end();
}

/// The end of the first part of a text that must not be broken: a blank, or the end of the text.
std::size_t end_of_piece(std::string_view text) {
  auto end = text.find(' ');
  while (end != std::string_view::npos) {
    const auto next_end = text.find(' ', end + 1);
    const auto next =
        text.substr(end + 1, next_end == std::string_view::npos ? next_end : next_end - end - 1);
    const auto before = text.substr(0, end);
    const bool relation = before.ends_with("=") || before.ends_with("≤") || before.ends_with("≥");
    if (!relation && !belongs_to_the_word_before(next)) break;
    end = next_end;
  }
  return end;
}

}  // namespace

std::string paragraph(std::string_view label, std::string_view text, std::size_t indentation,
                      std::size_t width) {
  std::string result = padded(label, indentation);
  std::size_t column = character_count(result);
  bool fresh = true;
  while (!text.empty()) {
    const auto blank = end_of_piece(text);
    const auto word = text.substr(0, blank);
    text = blank == std::string_view::npos ? std::string_view{} : text.substr(blank + 1);
    const std::size_t needed = character_count(word) + (fresh ? 0 : 1);
    if (!fresh && column + needed > width) {
      result += '\n';
      result.append(indentation, ' ');
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
