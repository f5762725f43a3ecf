#include "atlas/hdf5_handle.hpp"

#include <functional>
#include <numeric>

#include "atlas/environment_error.hpp"
#include "atlas/hdf5_check.hpp"

namespace rubatlas::atlas {

std::size_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

void Handle::close() {
  if (!is_open()) return;
  const std::string what = described(identifier_);
  if (close_(std::exchange(identifier_, kNone)) >= 0) return;
  try {
    throw_hdf5_failure();
  } catch (const Hdf5Failure& failure) {
    throw EnvironmentError(fmt::format("{} cannot be closed: {}", what, failure.what()));
  }
}

}  // namespace rubatlas::atlas
