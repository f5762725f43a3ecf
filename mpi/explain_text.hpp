/// How `explain` lays out what it says.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace rubatlas::mpi {

/// "heading", then lines of a name in a fixed column and what is to be said about it.
class Text {
 public:
  void heading(std::string_view title) { text_ += fmt::format("\n{}\n", title); }
  /// Columns are counted in letters: names hold Greek ones.
  void line(std::string_view name, std::string_view content) {
    constexpr std::size_t kColumn = 26;
    const auto letters = static_cast<std::size_t>(std::count_if(name.begin(), name.end(), [](char byte) {
      return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
    }));
    text_ += fmt::format("  {}{} {}\n", name, std::string(letters < kColumn ? kColumn - letters : 0, ' '),
                         content);
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

}  // namespace rubatlas::mpi
