#include "analysis/rules/same_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rubatlas::analysis {
namespace {

constexpr std::size_t kParts = 10;

double scatter_of_maximum(std::span<const double> sections) {
  const std::size_t count = sections.size() / kStateSize;
  const std::size_t parts = std::min(kParts, count);
  if (parts < 2) return 0.0;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    double largest = 0.0;
    for (std::size_t i = part * count / parts; i < (part + 1) * count / parts; ++i) {
      largest = std::max(largest, std::hypot(sections[kStateSize * i], sections[kStateSize * i + 1]));
    }
    sum += largest;
    sum_of_squares += largest * largest;
  }
  const auto number = static_cast<double>(parts);
  const double variance = (sum_of_squares - sum * sum / number) / (number - 1.0);
  return std::sqrt(std::max(0.0, variance));
}

bool has_section(std::span<const double> sections, const std::array<double, kStateSize>& wanted,
                 double tolerance) {
  for (std::size_t i = 0; i + kStateSize <= sections.size(); i += kStateSize) {
    double square = 0.0;
    for (std::size_t k = 0; k < kStateSize; ++k) {
      square += (sections[i + k] - wanted[k]) * (sections[i + k] - wanted[k]);
    }
    if (std::sqrt(square) <= tolerance) return true;
  }
  return false;
}

}  // namespace

MotionTrace trace_of(std::span<const double> sections, double max_displacement,
                     const ClosingTolerance& closing) {
  return trace_of(classify(sections, closing), sections, max_displacement);
}

MotionTrace trace_of(std::uint8_t motion, std::span<const double> sections, double max_displacement) {
  MotionTrace trace;
  trace.motion = motion;
  if (trace.motion == motion_class::kNone) return trace;
  trace.max_displacement = max_displacement;
  trace.displacement_error = scatter_of_maximum(sections);
  std::ranges::copy(sections.last(kStateSize), trace.section.begin());
  return trace;
}

bool is_same_motion(const MotionTrace& one, std::span<const double> sections, const MotionTrace& other,
                    const ClosingTolerance& closing) {
  if (one.motion != other.motion) return false;
  if (one.motion == motion_class::kNone) return true;
  if (is_periodic(one.motion)) {
    return has_section(sections, other.section,
                       std::max(closing.relative * orbit_size(sections), closing.floor));
  }
  const double error = std::hypot(one.displacement_error, other.displacement_error);
  return std::abs(one.max_displacement - other.max_displacement) <= kStandardErrors * error;
}

}  // namespace rubatlas::analysis
