/// What a job says on stderr while it runs: a bar, plain lines, or nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "mpi/commands/run.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::mpi {

/// Where a job stands.
struct Standing {
  std::size_t total = 0;       ///< points of the atlas
  std::size_t finished = 0;    ///< of any status but pending, those of earlier runs included
  std::size_t outside = 0;     ///< of them, those that left the model's validity: a result
  std::size_t failed = 0;      ///< of them, those that could not be integrated
  std::size_t computed = 0;    ///< in this run
  double seconds = 0.0;        ///< of this run
  double seconds_left = -1.0;  ///< negative: not known yet

  /// One more point has ended so; those that are pending do not count.
  void count(point::PointStatus status);
};

/// "1 h 02 min", "3 min 05 s", "12.3 s".
std::string readable_duration(double seconds);
/// One line of at most `width` columns: a bar if there is room, points, rate, time left, failures if any.
std::string bar_line(const Standing& standing, std::size_t width);
/// The same without the bar.
std::string plain_line(const Standing& standing);
/// "5845 done, 1355 outside the model, 0 failed".
std::string outcomes(const Standing& standing);
/// How the job ended.
std::string summary_line(const Standing& standing);

/// Of an atlas with this `/status`.
Standing standing_of(std::span<const std::uint8_t> status);
/// What a program ends with that leaves an atlas so (`exit_code.hpp`).
int exit_code_of(const Standing& standing);

class Progress {
 public:
  explicit Progress(ProgressStyle style);

  /// True when it is time to show again; asking costs a look at the clock.
  [[nodiscard]] bool is_due() const;
  void show(const Standing& standing);
  /// A sentence in between, in any style.
  void announce(std::string_view sentence);
  /// The last state and the summary. In the style `off` nothing is said.
  void finish(const Standing& standing);

 private:
  ProgressStyle style_;
  std::chrono::steady_clock::time_point next_;
  std::size_t shown_columns_ = 0;
};

}  // namespace rubatlas::mpi
