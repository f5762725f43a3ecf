/// A thin layer over the C interface of HDF5 1.10: handles are closed by their destructors, and failing calls
/// throw.
///
/// What the rest of the project may rely on:
///  - every failing call throws `EnvironmentError` with the file, the dataset and the system's reason;
///  - no dataset and no group stores a time stamp, so that equal contents give equal bytes;
///  - numbers in the file are little-endian on every machine; texts are UTF-8;
///  - files are created and read with the serial driver; `File::open_to_write` goes through MPI-IO when MPI
///  is
///    initialised (then it is collective over all ranks), and then no calls here but those that
///    write or read values are legal until `close`, since creating and flushing are collective.
///
/// `hdf5.h` stays out of this header: an identifier is HDF5's `hid_t`, a 64-bit integer.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rubatlas::atlas {

using Identifier = std::int64_t;
using Shape = std::vector<std::size_t>;

/// Number of elements.
std::size_t product(const Shape& shape);

/// What a dataset or an attribute may hold: f8, u1, i4, u4 and i8 in h5py's words.
template <typename T>
concept Number = std::same_as<T, double> || std::same_as<T, std::uint8_t> || std::same_as<T, std::int32_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::int64_t>;

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

/// An object with attributes: a dataset, a group, the root.
class Object {
 public:
  explicit Object(Handle handle) : handle_(std::move(handle)) {}

  void set_text(const std::string& name, const std::string& value);
  template <Number T>
  void set_number(const std::string& name, T value);
  template <Number T>
  void set_numbers(const std::string& name, std::span<const T> values);

  [[nodiscard]] bool has_attribute(const std::string& name) const;
  /// Throws EnvironmentError when there is no such attribute or when it is not a text.
  [[nodiscard]] std::string text(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;

  [[nodiscard]] Identifier identifier() const { return handle_.get(); }
  /// HDF5 closes a file, and under MPI finishes it, only when every object in it is closed.
  void close() { handle_.close(); }

 private:
  Handle handle_;
};

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

/// A file. Paths are absolute or relative to the root; missing groups on the way are created.
class File {
 public:
  /// A new file, made with the serial driver, with large datasets at multiples of 1 MiB, as parallel file
  /// systems like them; an existing file is overwritten (`publish.hpp` makes temporary
  /// names for new files).
  static File create(const std::filesystem::path& path);
  static File open_to_read(const std::filesystem::path& path);
  /// Open with MPI-IO when MPI is initialised, else with the serial driver, unbuffered: a block is in the
  /// operating system's hands when `write_block` returns. Takes no lock (see `lock.hpp`).
  static File open_to_write(const std::filesystem::path& path);

  /// The root group, for its attributes.
  [[nodiscard]] Object root() const;
  Object create_group(const std::string& path);
  [[nodiscard]] Object group(const std::string& path) const;

  template <Number T>
  Dataset create_dataset(const std::string& path, const Shape& shape);
  /// The space is reserved at once and never filled: parts that are not written occupy no disk and read as
  /// zeros.
  template <Number T>
  Dataset create_sparse_dataset(const std::string& path, const Shape& shape);
  /// Every entry is `fill` until it is written.
  template <Number T>
  Dataset create_filled_dataset(const std::string& path, const Shape& shape, T fill);
  /// Compressed, in chunks of consecutive numbers; what is not written reads as `fill`. Chunks that are
  /// written in order are compressed once each.
  template <Number T>
  Dataset create_packed_dataset(const std::string& path, const Shape& shape, T fill);
  /// A scalar string dataset (variable length).
  Dataset create_text(const std::string& path, const std::string& text);
  /// A 1-d array of fixed-length strings, padded with zeros.
  Dataset create_texts(const std::string& path, const std::vector<std::string>& texts);

  /// True when there is a dataset or group of that path.
  [[nodiscard]] bool has(const std::string& path) const;
  /// True when the path leads to a dataset in this file, not to a group and not to another file.
  [[nodiscard]] bool has_dataset(const std::string& path) const;
  [[nodiscard]] Dataset dataset(const std::string& path) const;
  [[nodiscard]] std::string read_text(const std::string& path) const;
  [[nodiscard]] std::vector<std::string> read_texts(const std::string& path) const;
  /// Names in a group, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names(const std::string& group = "/") const;

  void close() { handle_.close(); }

 private:
  explicit File(Handle handle) : handle_(std::move(handle)) {}
  Dataset create(const std::string& path, Identifier type, const Shape& shape, Identifier properties);

  Handle handle_;
};

}  // namespace rubatlas::atlas
