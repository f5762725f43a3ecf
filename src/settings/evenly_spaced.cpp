#include "settings/evenly_spaced.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "settings/document.hpp"

namespace rubatlas::settings {

std::vector<double> evenly_spaced(double from, double to, int count) {
  // With fifty digits the rounding error can change the nearest double only where two doubles are equally
  // near.
  using Wide = boost::multiprecision::cpp_bin_float_50;
  const Wide first(shortest(from));
  const Wide step = (Wide(shortest(to)) - first) / (count - 1);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i + 1 < count; ++i) values.push_back(static_cast<double>(first + i * step));
  values.push_back(to);
  return values;
}

}  // namespace rubatlas::settings
