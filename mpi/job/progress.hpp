/// The progress of a job on stderr: a bar, plain lines, or nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "mpi/say.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::mpi {

/// The progress of a job in numbers.
struct Standing {
  std::size_t total = 0;       ///< points of the atlas
  std::size_t finished = 0;    ///< points of any status except pending, those of earlier runs included
  std::size_t outside = 0;     ///< of these, points that left the model's validity, which is a result
  std::size_t failed = 0;      ///< of these, points that could not be integrated
  std::size_t computed = 0;    ///< in this run
  double seconds = 0.0;        ///< of this run
  double seconds_left = -1.0;  ///< negative: not known yet

  /// Counts one more point with this status; a pending point does not count.
  void count(ending::PointStatus status);
};

/// "1 h 02 min", "3 min 05 s", "12.3 s".
std::string readable_duration(double seconds);
/// One line of at most `width` columns: a bar if there is room, points, rate, time left, failures if any.
std::string bar_line(const Standing& standing, std::size_t width);
/// The same without the bar.
std::string plain_line(const Standing& standing);
/// "5845 done, 1355 outside the model, 0 failed".
std::string outcomes(const Standing& standing);
/// The last line of a job.
std::string summary_line(const Standing& standing);

/// Numbers of an atlas with this `/status`.
Standing standing_of(std::span<const std::uint8_t> status);
/// Exit code of a program that leaves an atlas in this state (`exit_code.hpp`).
int exit_code_of(const Standing& standing);

enum class ProgressStyle : std::uint8_t { automatic, bar, plain, off };

class Progress {
 public:
  explicit Progress(ProgressStyle style);

  /// True when the display is due again; a call costs a look at the clock.
  [[nodiscard]] bool is_due() const;
  void show(const Standing& standing);
  /// Prints a sentence in between, in every style.
  void announce(std::string_view sentence);
  /// Prints the last state and the summary; nothing in the style `off`.
  void finish(const Standing& standing);

 private:
  ProgressStyle style_;
  std::chrono::steady_clock::time_point next_;
  RewrittenLine bar_;
};

}  // namespace rubatlas::mpi
