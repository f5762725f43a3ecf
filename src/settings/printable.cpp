#include "settings/printable.hpp"

#include <algorithm>

namespace rubatlas::settings {
namespace {

unsigned char byte_of(char c) {
  return static_cast<unsigned char>(c);
}

/// Length in bytes of the character that begins with this byte; 0 where no character does.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

bool is_control(std::string_view character) {
  const unsigned char first = byte_of(character.front());
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  return first == 0xC2 && byte_of(character[1]) < 0xA0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto character = text.substr(0, std::max<std::size_t>(length_of(byte_of(text.front())), 1));
    const bool whole =
        length_of(byte_of(text.front())) == character.size() &&
        std::ranges::all_of(character.substr(1), [](char c) { return (byte_of(c) & 0xC0U) == 0x80U; });
    if (!whole) {
      result += '?';
      text.remove_prefix(1);
      continue;
    }
    if (!is_control(character)) result += character;
    text.remove_prefix(character.size());
  }
  return result;
}

}  // namespace rubatlas::settings
