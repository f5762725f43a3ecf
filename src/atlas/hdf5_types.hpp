/// Types, spaces and property lists of HDF5 as the sources of this layer need them; only for the sources of
/// this folder.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "atlas/hdf5_handle.hpp"

namespace rubatlas::atlas {

static_assert(std::is_same_v<hid_t, Identifier>);

/// HDF5's types of a number: this machine's, and the file's, which is the same on every machine.
struct NumberTypes {
  Identifier in_memory;
  Identifier in_file;
};
inline NumberTypes types_of(double) {
  return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE};
}
inline NumberTypes types_of(std::uint8_t) {
  return {H5T_NATIVE_UINT8, H5T_STD_U8LE};
}
inline NumberTypes types_of(std::uint16_t) {
  return {H5T_NATIVE_UINT16, H5T_STD_U16LE};
}
inline NumberTypes types_of(std::int32_t) {
  return {H5T_NATIVE_INT32, H5T_STD_I32LE};
}
inline NumberTypes types_of(std::uint32_t) {
  return {H5T_NATIVE_UINT32, H5T_STD_U32LE};
}
inline NumberTypes types_of(std::int64_t) {
  return {H5T_NATIVE_INT64, H5T_STD_I64LE};
}

template <Number T>
Identifier memory_type() {
  return types_of(T{}).in_memory;
}
template <Number T>
Identifier file_type() {
  return types_of(T{}).in_file;
}

std::vector<hsize_t> extents(const Shape& shape);
Handle simple_space(const Shape& shape);
Handle property_list(Identifier kind);
/// `size` bytes, or H5T_VARIABLE.
Handle text_type(std::size_t size);
/// A text of variable or fixed length, read through `read(memory type, buffer)`.
std::string read_one_text(Identifier stored_type, const std::function<void(Identifier, void*)>& read);
/// A scalar attribute (a text or a number): the buffer that it is read into has room for one value.
void require_one_value(const Handle& space);

}  // namespace rubatlas::atlas

/// Instantiates for every number that a file may hold.
#define RUBATLAS_FOR_EACH_NUMBER(INSTANTIATE) \
  INSTANTIATE(double)                         \
  INSTANTIATE(std::uint8_t)                   \
  INSTANTIATE(std::uint16_t)                  \
  INSTANTIATE(std::int32_t)                   \
  INSTANTIATE(std::uint32_t)                  \
  INSTANTIATE(std::int64_t)
