#include "analysis/rules/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubatlas::analysis {

std::string describe_course(std::span<const CoursePoint> course, const CourseWords& words,
                            const Noticeable& noticeable,
                            const std::function<std::string(const CoursePoint&)>& number) {
  if (course.size() < 2) return {};
  const auto [low, high] = std::ranges::minmax_element(course, {}, &CoursePoint::value);
  const auto& first = course.front();
  const auto& last = course.back();
  const double largest = std::max(std::abs(low->value), std::abs(high->value));
  const double threshold = std::max(noticeable.absolute, noticeable.share * largest);
  const double above = high->value - std::max(first.value, last.value);
  const double below = std::min(first.value, last.value) - low->value;

  const auto begin = words.subject.empty() ? std::string{} : fmt::format("{} ", words.subject);
  const auto at = [&](const CoursePoint& point) { return fmt::format("{} at {}", number(point), point.at); };
  if (std::max(above, below) >= threshold && std::max(above, below) > 0.0) {
    const bool hill = above >= below;
    return fmt::format("{}{} from {} to {}, then {} to {}", begin, hill ? words.grows : words.shrinks,
                       at(first), at(hill ? *high : *low), hill ? words.shrinks : words.grows, at(last));
  }
  const double change = last.value - first.value;
  if (std::abs(change) < threshold || change == 0.0) return {};
  return fmt::format("{}{} from {} to {}", begin, change > 0.0 ? words.grows : words.shrinks, at(first),
                     at(last));
}

}  // namespace rubatlas::analysis
