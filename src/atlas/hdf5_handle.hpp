/// What the layer over HDF5 is made of (`hdf5.hpp`): identifiers that are closed by their destructors,
/// shapes, and the numbers that a file may hold.
///
/// `hdf5.h` stays out of this header: an identifier is HDF5's `hid_t`, a 64-bit integer.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rubatlas::atlas {

using Identifier = std::int64_t;
using Shape = std::vector<std::size_t>;

/// Number of elements.
std::size_t product(const Shape& shape);

/// What a dataset or an attribute may hold: f8, u1, u2, i4, u4 and i8 in h5py's words.
template <typename T>
concept Number = std::same_as<T, double> || std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::int32_t> || std::same_as<T, std::uint32_t> || std::same_as<T, std::int64_t>;

/// Owns one HDF5 identifier and closes it.
class Handle {
 public:
  using Close = int (*)(Identifier);

  Handle() = default;
  Handle(Identifier identifier, Close closer) : identifier_(identifier), close_(closer) {}
  Handle(Handle&& other) noexcept
      : identifier_(std::exchange(other.identifier_, kNone)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(identifier_, other.identifier_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (identifier_ != kNone) close_(identifier_);
  }

  [[nodiscard]] Identifier get() const { return identifier_; }
  [[nodiscard]] bool is_open() const { return identifier_ != kNone; }
  /// Closes at once and reports a failure, which a destructor cannot do. Throws EnvironmentError.
  void close();

 private:
  static constexpr Identifier kNone = -1;
  Identifier identifier_ = kNone;
  Close close_ = nullptr;
};

}  // namespace rubatlas::atlas
