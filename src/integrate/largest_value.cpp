#include "integrate/largest_value.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstddef>

namespace rubatlas::integrate {
namespace {

/// By how much the function may exceed a sample before its neighbours: four times what the parabola through
/// the three could.
double excess(const Sample& before, const Sample& at, const Sample& after) {
  const double left = at.argument - before.argument;
  const double right = after.argument - at.argument;
  const double curvature =
      ((after.value - at.value) / right - (at.value - before.value) / left) / (left + right);
  const double width = std::max(left, right);
  return std::abs(curvature) * width * width;
}

}  // namespace

Sample largest_value(FunctionView function, std::span<const Sample> samples, double known) {
  constexpr int kBits = 20;  // of the argument; a maximum is flat, so its value has twice as many
  Sample largest = *std::ranges::max_element(samples, {}, &Sample::value);
  const std::size_t last = samples.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const Sample& before = samples[i == 0 ? 0 : i - 1];
    const Sample& after = samples[std::min(i + 1, last)];
    const double value = samples[i].value;
    if (value < before.value || value < after.value) continue;
    const std::size_t middle = std::clamp(i, std::size_t{1}, last - 1);
    const double most = value + excess(samples[middle - 1], samples[middle], samples[middle + 1]);
    if (!(most > std::max(known, largest.value))) continue;
    const auto [argument, lowest] = boost::math::tools::brent_find_minima(
        [&](double at) { return -function(at); }, before.argument, after.argument, kBits);
    if (-lowest > largest.value) largest = {argument, -lowest};
  }
  return largest;
}

}  // namespace rubatlas::integrate
