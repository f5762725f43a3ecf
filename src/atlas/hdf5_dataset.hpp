/// A dataset of an HDF5 file: its numbers, whole or in blocks, and the scales of its axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "atlas/hdf5_handle.hpp"
#include "atlas/hdf5_object.hpp"

namespace rubatlas::atlas {

/// An N-d array in C order. Reading converts between number types as HDF5 does.
class Dataset : public Object {
 public:
  explicit Dataset(Handle handle) : Object(std::move(handle)) {}

  [[nodiscard]] Shape shape() const;
  /// True when the dataset stores numbers of this type (or texts). HDF5 itself would convert them silently.
  template <Number T>
  [[nodiscard]] bool holds() const;
  [[nodiscard]] bool holds_texts() const;
  /// Bytes of one element in the file.
  [[nodiscard]] std::size_t number_size() const;
  /// True when its numbers are stored in another file than the dataset itself.
  [[nodiscard]] bool is_elsewhere() const;
  /// Where its numbers begin in the file [B]; empty where they are chunked or compressed.
  [[nodiscard]] std::optional<std::uint64_t> offset() const;
  /// Product of the extents.
  [[nodiscard]] std::size_t size() const;

  /// The whole array; `values` has `size()` numbers.
  template <Number T>
  void write(std::span<const T> values);
  template <Number T>
  [[nodiscard]] std::vector<T> read() const;

  /// The block of extent `count` at `start`, one entry per axis. Not collective: any rank may call it at any
  /// time.
  template <Number T>
  void write_block(const Shape& start, const Shape& count, std::span<const T> values);
  /// The same, with the numbers as the file stores them.
  void write_bytes(const Shape& start, const Shape& count, std::span<const std::byte> bytes);
  template <Number T>
  [[nodiscard]] std::vector<T> read_block(const Shape& start, const Shape& count) const;

  /// Makes this 1-d dataset a dimension scale of that name.
  void make_scale(const std::string& name);
  /// Says that `axis` of this dataset runs along `scale`.
  void attach_scale(std::size_t axis, const Dataset& scale);
  /// Path of the first scale of an axis, without its leading slash; empty when it has none.
  [[nodiscard]] std::string scale_name(std::size_t axis) const;
  /// True when this dataset is itself a dimension scale.
  [[nodiscard]] bool is_scale() const;
};

}  // namespace rubatlas::atlas
