/// An object of an HDF5 file, with its attributes.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "atlas/hdf5_handle.hpp"

namespace rubatlas::atlas {

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

}  // namespace rubatlas::atlas
