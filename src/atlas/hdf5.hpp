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
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "atlas/hdf5_dataset.hpp"
#include "atlas/hdf5_handle.hpp"
#include "atlas/hdf5_object.hpp"

namespace rubatlas::atlas {

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
