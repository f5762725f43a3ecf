#include "analysis/rules/sensitivity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/rules/course.hpp"
#include "analysis/rules/evidence_text.hpp"

namespace rubatlas::analysis {
namespace {

/// "a to b", or "a" where both read the same.
std::string from_to(const std::string& first, const std::string& last) {
  return first == last ? first : fmt::format("{} to {}", first, last);
}

/// A series of lines along one parameter.
class Series {
 public:
  Series(const Parameter& parameter, std::size_t axis, SpeedScale scale,
         std::vector<const LineSummary*> lines)
      : parameter_(parameter), axis_(axis), scale_(scale), lines_(std::move(lines)) {
    for (const auto* line : lines_) values_.push_back(line->parameters[axis_]);
  }

  [[nodiscard]] std::string region(std::size_t which) const {
    const auto of = [which](const LineSummary& line) -> const Region& { return line.regions[which]; };
    std::vector<std::string> parts = presences([&](const LineSummary& line) { return of(line).presence; });
    const auto present = [&](const LineSummary& line) { return of(line).present(); };
    const auto closed = [&](const LineSummary& line) {
      return present(line) && !std::isnan(of(line).width());
    };
    const auto extent = [&](const LineSummary& line) { return extent_text(of(line)); };
    // The width of a region that is open on a side is unknown; the text shows its known part.
    std::vector<const LineSummary*> open;
    std::ranges::copy_if(lines_, std::back_inserter(open),
                         [&](const LineSummary* line) { return present(*line) && !closed(*line); });
    if (!open.empty()) {
      std::vector<double> picked(open.size());
      std::ranges::transform(open, picked.begin(),
                             [&](const LineSummary* line) { return line->parameters[axis_]; });
      parts.push_back(fmt::format("known as {} {}", from_to(extent(*open.front()), extent(*open.back())),
                                  parameter_.where(picked, values_)));
    }

    const auto widths = course(present, [&](const LineSummary& l) { return of(l).width(); });
    const auto with_extent = [&](const CoursePoint& p) {
      return fmt::format("{:.3f} ({})", p.value, extent(line_at(p)));
    };
    auto words =
        describe_course(widths, {"", "widens", "shortens"}, noticeable_place(kNoticeableWidth), with_extent);
    if (words.empty() && widths.size() > 1) {
      const auto middles =
          course(closed, [&](const LineSummary& l) { return 0.5 * (of(l).from + of(l).to); });
      const Noticeable place{scale_.speed_ratio(kNoticeableWidth), 0.0};
      words = describe_course(middles, {"", "moves up", "moves down"}, place,
                              [&](const CoursePoint& p) { return extent(line_at(p)); });
      if (words.empty()) {
        words = fmt::format("keeps its extent ({})",
                            from_to(extent(line_at(widths.front())), extent(line_at(widths.back()))));
      }
    } else if (widths.size() == 1) {
      words = fmt::format("{} at {}", extent(line_at(widths.front())), widths.front().at);
    }
    add(parts, words);
    if (widths.empty()) {
      const auto add_end = [&](const char* subject, bool Region::*is_open, double Region::*end) {
        const auto places =
            course([&](const LineSummary& line) { return present(line) && !(of(line).*is_open); },
                   [&](const LineSummary& line) { return of(line).*end; });
        add(parts, describe_course(places, {subject, "moves up", "moves down"},
                                   {scale_.speed_ratio(kNoticeableWidth), 0.0},
                                   [](const CoursePoint& p) { return fmt::format("{:.3f}", p.value); }));
      };
      add_end("its beginning", &Region::begins_open, &Region::from);
      add_end("its end", &Region::ends_open, &Region::to);
    }

    const auto shares = course(present, [&](const LineSummary& l) { return of(l).aperiodic_share; });
    add(parts,
        describe_course(shares, {"aperiodic share", "grows", "falls"}, {kNoticeableShare, 0.0},
                        [](const CoursePoint& p) { return fmt::format("{:.0f} %", 100.0 * p.value); }));
    const auto peaks = course(present, [&](const LineSummary& l) { return of(l).peak_displacement; });
    add(parts, describe_course(peaks, {"peak displacement", "grows", "falls"}, {0.0, kNoticeableChange},
                               [](const CoursePoint& p) { return millimetres(p.value); }));
    return fmt::format("{}", fmt::join(parts, "; "));
  }

  [[nodiscard]] std::string trigger(std::size_t which) const {
    const auto of = [which](const LineSummary& line) -> const Trigger& { return line.triggers[which]; };
    std::vector<std::string> parts = presences([&](const LineSummary& line) { return of(line).presence; });
    const auto present = [&](const LineSummary& line) { return of(line).presence == Presence::present; };

    const auto places = course(present, [&](const LineSummary& l) { return of(l).speed_ratio; });
    auto words =
        describe_course(places, {"", "moves up", "moves down"}, {scale_.speed_ratio(kNoticeablePlace), 0.0},
                        [](const CoursePoint& p) { return fmt::format("{:.3f}", p.value); });
    if (words.empty() && !places.empty()) {
      const auto [low, high] = std::ranges::minmax_element(places, {}, &CoursePoint::value);
      const auto at = [](const CoursePoint& point) { return fmt::format("{:.3f}", point.value); };
      words = places.size() == 1 ? fmt::format("{} at {}", at(*low), low->at)
                                 : fmt::format("stays at {}", from_to(at(*low), at(*high)));
    }
    add(parts, words);
    const auto rises = course(present, [&](const LineSummary& l) { return of(l).rise(); });
    add(parts, describe_course(rises, {"its rise", "grows", "falls"}, {0.0, kNoticeableChange},
                               [&](const CoursePoint& p) {
                                 return fmt::format("{} (×{:.3g})", millimetres(p.value),
                                                    of(line_at(p)).ratio());
                               }));
    return fmt::format("{}", fmt::join(parts, "; "));
  }

 private:
  [[nodiscard]] Noticeable noticeable_place(double scaled) const {
    return {scale_.speed_ratio(scaled), kNoticeableChange};
  }

  static void add(std::vector<std::string>& parts, std::string words) {
    if (!words.empty()) parts.push_back(std::move(words));
  }

  [[nodiscard]] const LineSummary& line_at(const CoursePoint& point) const {
    const auto found = std::ranges::find_if(lines_, [&](const LineSummary* line) {
      return parameter_.text(line->parameters[axis_]) == point.at;
    });
    return **found;
  }

  template <typename Select, typename Value>
  [[nodiscard]] std::vector<CoursePoint> course(Select select, Value value) const {
    std::vector<CoursePoint> points;
    for (const auto* line : lines_) {
      if (!select(*line)) continue;
      const double number = value(*line);
      if (std::isfinite(number)) points.push_back({number, parameter_.text(line->parameters[axis_])});
    }
    return points;
  }

  /// "absent at …", "merged with region 2 at …", "not covered at …"; empty when present throughout.
  template <typename PresenceOf>
  [[nodiscard]] std::vector<std::string> presences(PresenceOf presence_of) const {
    std::vector<std::string> parts;
    const auto add_where = [&](Presence presence, const char* words) {
      std::vector<double> picked;
      for (const auto* line : lines_) {
        if (presence_of(*line) == presence) picked.push_back(line->parameters[axis_]);
      }
      if (!picked.empty()) parts.push_back(fmt::format("{} {}", words, parameter_.where(picked, values_)));
    };
    add_where(Presence::not_covered, "not covered");
    add_where(Presence::absent, "absent");
    add_where(Presence::merged, "merged with region 2");
    return parts;
  }

  const Parameter& parameter_;
  std::size_t axis_;
  SpeedScale scale_;
  std::vector<const LineSummary*> lines_;
  std::vector<double> values_;
};

std::string fixed_text(std::span<const Parameter> parameters, std::size_t axis, const LineSummary& line) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (i != axis) texts.push_back(parameters[i].text(line.parameters[i]));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

std::vector<Sensitivity> sensitivities(std::span<const Parameter> parameters,
                                       std::span<const LineSummary> lines, SpeedScale scale) {
  std::vector<Sensitivity> result;
  std::size_t block = lines.size();  // of lines that differ in this parameter and those behind it
  for (std::size_t axis = 0; axis < parameters.size(); ++axis) {
    const std::size_t values = parameters[axis].values.size();
    const std::size_t step = block / values;  // to the next value of this parameter
    const std::size_t whole = std::exchange(block, step);
    if (values < 2 || parameters[axis].name == plan::kDirectionAxis) continue;
    for (std::size_t start = 0; start < lines.size(); ++start) {
      if (start % whole >= step) continue;
      Sensitivity sensitivity{.parameter = axis, .fixed = fixed_text(parameters, axis, lines[start])};
      std::vector<const LineSummary*> series_lines;
      for (std::size_t i = 0; i < values; ++i) {
        sensitivity.lines.push_back(start + i * step);
        series_lines.push_back(&lines[start + i * step]);
      }
      const Series series(parameters[axis], axis, scale, std::move(series_lines));
      sensitivity.effects = {{"region 1", series.region(0)},   {"trigger 1", series.trigger(0)},
                             {"region 2", series.region(1)},   {"region 3", series.region(2)},
                             {"trigger 2", series.trigger(1)}, {"region 4", series.region(3)}};
      result.push_back(std::move(sensitivity));
    }
  }
  return result;
}

}  // namespace rubatlas::analysis
