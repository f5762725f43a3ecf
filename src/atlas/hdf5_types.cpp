#include "atlas/hdf5_types.hpp"

#include <memory>

#include "atlas/hdf5_check.hpp"

namespace rubatlas::atlas {

std::vector<hsize_t> extents(const Shape& shape) {
  return {shape.begin(), shape.end()};
}

Handle simple_space(const Shape& shape) {
  if (shape.empty()) return {RUBATLAS_HDF5(H5Screate(H5S_SCALAR)), H5Sclose};
  const auto sizes = extents(shape);
  return {RUBATLAS_HDF5(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr)), H5Sclose};
}

Handle property_list(Identifier kind) {
  return {RUBATLAS_HDF5(H5Pcreate(kind)), H5Pclose};
}

Handle text_type(std::size_t size) {
  Handle type{RUBATLAS_HDF5(H5Tcopy(H5T_C_S1)), H5Tclose};
  RUBATLAS_HDF5(H5Tset_size(type.get(), size));
  RUBATLAS_HDF5(H5Tset_cset(type.get(), H5T_CSET_UTF8));
  if (size != H5T_VARIABLE) RUBATLAS_HDF5(H5Tset_strpad(type.get(), H5T_STR_NULLPAD));
  return type;
}

std::string read_one_text(Identifier stored_type, const std::function<void(Identifier, void*)>& read) {
  if (RUBATLAS_HDF5(H5Tget_class(stored_type)) != H5T_STRING) throw Hdf5Failure("it is not a text");
  if (RUBATLAS_HDF5(H5Tis_variable_str(stored_type)) > 0) {
    const Handle type = text_type(H5T_VARIABLE);
    char* raw = nullptr;
    read(type.get(), &raw);
    const std::unique_ptr<char, void (*)(char*)> owner(raw, [](char* text) { H5free_memory(text); });
    return raw == nullptr ? std::string() : std::string(raw);
  }
  std::string text(H5Tget_size(stored_type), '\0');
  read(text_type(text.size()).get(), text.data());
  return text.substr(0, text.find('\0'));
}

void require_one_value(const Handle& space) {
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw Hdf5Failure("it is not one value");
}

}  // namespace rubatlas::atlas
