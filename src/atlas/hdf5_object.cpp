#include "atlas/hdf5_object.hpp"

#include "atlas/hdf5_check.hpp"
#include "atlas/hdf5_types.hpp"

namespace rubatlas::atlas {

void Object::set_text(const std::string& name, const std::string& value) {
  const Handle type = text_type(H5T_VARIABLE);
  const Handle space = simple_space({});
  const Handle attribute{RUBATLAS_HDF5(H5Acreate2(identifier(), name.c_str(), type.get(), space.get(),
                                                  H5P_DEFAULT, H5P_DEFAULT)),
                         H5Aclose};
  const char* raw = value.c_str();
  RUBATLAS_HDF5(H5Awrite(attribute.get(), type.get(), static_cast<const void*>(&raw)));
}

template <Number T>
void Object::set_number(const std::string& name, T value) {
  const Handle space = simple_space({});
  const Handle attribute{RUBATLAS_HDF5(H5Acreate2(identifier(), name.c_str(), file_type<T>(), space.get(),
                                                  H5P_DEFAULT, H5P_DEFAULT)),
                         H5Aclose};
  RUBATLAS_HDF5(H5Awrite(attribute.get(), memory_type<T>(), &value));
}

template <Number T>
void Object::set_numbers(const std::string& name, std::span<const T> values) {
  const Handle space = simple_space({values.size()});
  const Handle attribute{RUBATLAS_HDF5(H5Acreate2(identifier(), name.c_str(), file_type<T>(), space.get(),
                                                  H5P_DEFAULT, H5P_DEFAULT)),
                         H5Aclose};
  RUBATLAS_HDF5(H5Awrite(attribute.get(), memory_type<T>(), values.data()));
}

bool Object::has_attribute(const std::string& name) const {
  return about(identifier(), ("asked for " + name).c_str(),
               [&] { return RUBATLAS_HDF5(H5Aexists(identifier(), name.c_str())) > 0; });
}

std::string Object::text(const std::string& name) const {
  return about(identifier(), ("asked for its text " + name).c_str(), [&] {
    const Handle attribute{RUBATLAS_HDF5(H5Aopen(identifier(), name.c_str(), H5P_DEFAULT)), H5Aclose};
    const Handle type{RUBATLAS_HDF5(H5Aget_type(attribute.get())), H5Tclose};
    require_one_value({RUBATLAS_HDF5(H5Aget_space(attribute.get())), H5Sclose});
    return read_one_text(type.get(), [&](Identifier memory, void* buffer) {
      RUBATLAS_HDF5(H5Aread(attribute.get(), memory, buffer));
    });
  });
}

double Object::number(const std::string& name) const {
  return about(identifier(), ("asked for its number " + name).c_str(), [&] {
    const Handle attribute{RUBATLAS_HDF5(H5Aopen(identifier(), name.c_str(), H5P_DEFAULT)), H5Aclose};
    require_one_value({RUBATLAS_HDF5(H5Aget_space(attribute.get())), H5Sclose});
    double value = 0.0;
    RUBATLAS_HDF5(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value));
    return value;
  });
}

#define RUBATLAS_INSTANTIATE(T)                               \
  template void Object::set_number<T>(const std::string&, T); \
  template void Object::set_numbers<T>(const std::string&, std::span<const T>);
RUBATLAS_FOR_EACH_NUMBER(RUBATLAS_INSTANTIATE)
#undef RUBATLAS_INSTANTIATE

}  // namespace rubatlas::atlas
