#include "plan/part.hpp"

#include <charconv>

namespace rubatlas::plan {
namespace {

/// A whole number from 1 to a million: products with numbers of lines then stay within 64 bits.
std::optional<std::size_t> read_count(std::string_view text) {
  constexpr std::size_t kMost = 1'000'000;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > kMost)
    return std::nullopt;
  return value;
}

}  // namespace

PointRange points_of(const Part& part, std::size_t lines, std::size_t speeds) {
  return {(part.number - 1) * lines / part.count * speeds, part.number * lines / part.count * speeds};
}

PointRange points_of(const Part& part, const Grid& grid) {
  return points_of(part, grid.line_count(), grid.speed_count());
}

std::string text_of(const Part& part) {
  return std::to_string(part.number) + "/" + std::to_string(part.count);
}

std::optional<Part> read_part(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = read_count(text.substr(0, slash));
  const auto count = read_count(text.substr(slash + 1));
  if (!number || !count || *number > *count) return std::nullopt;
  return Part{*number, *count};
}

}  // namespace rubatlas::plan
