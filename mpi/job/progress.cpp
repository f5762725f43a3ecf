#include "mpi/job/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mpi/exit_code.hpp"
#include "mpi/say.hpp"

namespace rubatlas::mpi {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kBarPeriod{200};
constexpr milliseconds kLinePeriod{5000};

/// Under mpirun stderr is a pipe; the width is then taken from the shell's COLUMNS, if it is exported.
std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  if (const char* columns = std::getenv("COLUMNS")) {
    if (const long width = std::strtol(columns, nullptr, 10); width > 0)
      return static_cast<std::size_t>(width);
  }
  return 80;
}

/// Points per second of this run, never written with a power of ten.
std::string rate(const Standing& standing) {
  const double value =
      standing.seconds > 0.0 ? static_cast<double>(standing.computed) / standing.seconds : 0.0;
  return value < 100.0 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

std::string counts(const Standing& standing) {
  std::string text = fmt::format("{}/{} points", standing.finished, standing.total);
  if (standing.computed > 0 && standing.seconds > 0.0) text += "  " + rate(standing) + "/s";
  if (standing.seconds_left >= 0.0) text += "  ETA " + readable_duration(standing.seconds_left);
  if (standing.outside > 0) text += fmt::format("  {} outside", standing.outside);
  if (standing.failed > 0) text += fmt::format("  {} failed", standing.failed);
  return text;
}

}  // namespace

void Standing::count(ending::PointStatus status) {
  if (status == ending::PointStatus::pending) return;
  ++finished;
  if (status == ending::PointStatus::left_validity) ++outside;
  if (status == ending::PointStatus::integrator_failed) ++failed;
}

std::string readable_duration(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string bar_line(const Standing& standing, std::size_t width) {
  const std::string text = counts(standing);
  constexpr std::size_t kFrame = 4;  // "[" and "]" and two blanks
  constexpr std::size_t kShortestBar = 10;
  constexpr std::size_t kLongestBar = 40;
  if (width < text.size() + kFrame + kShortestBar) return text.substr(0, width);
  const std::size_t length = std::min(kLongestBar, width - text.size() - kFrame);
  const std::size_t full = standing.total == 0 ? length : length * standing.finished / standing.total;
  return fmt::format("[{:#<{}}{:.<{}}]  {}", "", full, "", length - full, text);
}

std::string plain_line(const Standing& standing) {
  const double share = standing.total == 0
                           ? 1.0
                           : static_cast<double>(standing.finished) / static_cast<double>(standing.total);
  return fmt::format("{:3.0f} %  {}", std::floor(100.0 * share), counts(standing));
}

std::string outcomes(const Standing& standing) {
  return fmt::format("{} done, {} outside the model, {} failed",
                     standing.finished - standing.outside - standing.failed, standing.outside,
                     standing.failed);
}

std::string summary_line(const Standing& standing) {
  return fmt::format("{} of {} points: {}; {} computed in {}, {} points/s", standing.finished, standing.total,
                     outcomes(standing), standing.computed, readable_duration(standing.seconds),
                     rate(standing));
}

Standing standing_of(std::span<const std::uint8_t> status) {
  Standing standing;
  standing.total = status.size();
  for (const auto code : status) standing.count(static_cast<ending::PointStatus>(code));
  return standing;
}

int exit_code_of(const Standing& standing) {
  if (standing.finished < standing.total) return exit_code::kInterrupted;
  return standing.failed > 0 ? exit_code::kSomePointsFailed : exit_code::kDone;
}

Progress::Progress(ProgressStyle style)
    : style_(style == ProgressStyle::automatic
                 ? (::isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::plain)
                 : style),
      next_(std::chrono::steady_clock::now() + (style_ == ProgressStyle::plain ? kLinePeriod : kBarPeriod)) {}

bool Progress::is_due() const {
  return style_ != ProgressStyle::off && std::chrono::steady_clock::now() >= next_;
}

void Progress::show(const Standing& standing) {
  if (style_ == ProgressStyle::off) return;
  next_ = std::chrono::steady_clock::now() + (style_ == ProgressStyle::plain ? kLinePeriod : kBarPeriod);
  if (style_ == ProgressStyle::plain) return say_sentence(plain_line(standing));
  // The last column stays free: some terminals wrap when it is written.
  bar_.show(bar_line(standing, terminal_width() - 1));
}

void Progress::announce(std::string_view sentence) {
  bar_.leave();
  say_sentence(sentence);
}

void Progress::finish(const Standing& standing) {
  if (style_ == ProgressStyle::off) return;
  if (style_ == ProgressStyle::bar) {
    show(standing);
    bar_.leave();
  }
  say_sentence(summary_line(standing));
}

}  // namespace rubatlas::mpi
