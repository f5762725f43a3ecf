/// The course of one number along a parameter, in words: "widens from 0.16 at ζ = 0.01 to 0.24 at ζ = 0.05,
/// then shortens to 0.1 at ζ = 0.3".
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace rubatlas::analysis {

struct CoursePoint {
  double value;
  std::string at;  ///< value of the parameter, as text
};

/// A change counts if it exceeds both an absolute amount and a share of the largest value.
struct Noticeable {
  double absolute = 0.0;
  double share = 0.1;
};

struct CourseWords {
  std::string_view subject;  ///< subject of the first verb; empty where the context names it
  std::string_view grows;
  std::string_view shrinks;
};

/// Ascending along the parameter. An interior extreme is named when it stands out from both ends by a
/// noticeable amount. Empty when nothing noticeable happens, or when there are fewer than two points.
std::string describe_course(std::span<const CoursePoint> course, const CourseWords& words,
                            const Noticeable& noticeable,
                            const std::function<std::string(const CoursePoint&)>& number);

}  // namespace rubatlas::analysis
