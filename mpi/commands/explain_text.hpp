/// How `explain` lays out what it says.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubatlas::mpi {

/// "heading", then lines of a name in a fixed column and what is to be said about it.
class Text {
 public:
  void heading(std::string_view title) { text_ += fmt::format("\n{}\n", title); }
  /// fmt counts the width in characters, not in bytes, since names hold Greek letters.
  void line(std::string_view name, std::string_view content) {
    text_ += fmt::format("  {:<26} {}\n", name, content);
  }
  void note(std::string_view content) { text_ += fmt::format("  - {}\n", content); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// A length in the unit that an engineer would read it in.
inline std::string length(double metres) {
  const double size = std::abs(metres);
  if (size == 0.0) return "0 mm";
  if (size >= 1.0) return fmt::format("{:.6g} m", metres);
  return size >= 1e-4 ? fmt::format("{:.6g} mm", 1e3 * metres) : fmt::format("{:.6g} µm", 1e6 * metres);
}

/// One value or a range of them, with a unit; an empty one for a number without.
inline std::string between(double low, double high, std::string_view unit) {
  const std::string suffix = unit.empty() ? "" : fmt::format(" {}", unit);
  return low == high ? fmt::format("{:.4g}{}", low, suffix)
                     : fmt::format("{:.4g} to {:.4g}{}", low, high, suffix);
}

/// A few values one by one, more of them as a range.
inline std::string values_text(const std::vector<double>& values) {
  constexpr std::size_t kShown = 8;
  if (values.size() <= kShown) return fmt::format("{}", fmt::join(values, ", "));
  return fmt::format("{} to {}", values.front(), values.back());
}

}  // namespace rubatlas::mpi
