#include "settings/range.hpp"

#include <fmt/format.h>

namespace rubatlas::settings {

bool Range::contains(double value) const {
  const bool above = low_excluded ? value > low : value >= low;
  const bool below = high_excluded ? value < high : value <= high;
  return above && below;
}

std::string Range::text() const {
  return fmt::format("{}{}, {}{}", low_excluded ? '(' : '[', low, high, high_excluded ? ')' : ']');
}

}  // namespace rubatlas::settings
