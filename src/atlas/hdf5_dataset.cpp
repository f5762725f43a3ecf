#include "atlas/hdf5_dataset.hpp"

#include <hdf5_hl.h>

#include "atlas/hdf5_check.hpp"
#include "atlas/hdf5_types.hpp"

namespace rubatlas::atlas {

Shape Dataset::shape() const {
  return about(identifier(), "measured", [&] {
    const Handle space{RUBATLAS_HDF5(H5Dget_space(identifier())), H5Sclose};
    std::vector<hsize_t> sizes(
        static_cast<std::size_t>(RUBATLAS_HDF5(H5Sget_simple_extent_ndims(space.get()))));
    RUBATLAS_HDF5(H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr));
    return Shape(sizes.begin(), sizes.end());
  });
}

template <Number T>
bool Dataset::holds() const {
  return about(identifier(), "read", [&] {
    const Handle type{RUBATLAS_HDF5(H5Dget_type(identifier())), H5Tclose};
    return RUBATLAS_HDF5(H5Tequal(type.get(), file_type<T>())) > 0;
  });
}

bool Dataset::holds_texts() const {
  return about(identifier(), "read", [&] {
    const Handle type{RUBATLAS_HDF5(H5Dget_type(identifier())), H5Tclose};
    return RUBATLAS_HDF5(H5Tget_class(type.get())) == H5T_STRING;
  });
}

std::size_t Dataset::number_size() const {
  return about(identifier(), "read", [&] {
    const Handle type{RUBATLAS_HDF5(H5Dget_type(identifier())), H5Tclose};
    return H5Tget_size(type.get());
  });
}

bool Dataset::is_elsewhere() const {
  return about(identifier(), "read", [&] {
    const Handle properties{RUBATLAS_HDF5(H5Dget_create_plist(identifier())), H5Pclose};
    return RUBATLAS_HDF5(H5Pget_layout(properties.get())) == H5D_VIRTUAL ||
           RUBATLAS_HDF5(H5Pget_external_count(properties.get())) > 0;
  });
}

std::optional<std::uint64_t> Dataset::offset() const {
  const haddr_t place = H5Dget_offset(identifier());
  H5Eclear2(H5E_DEFAULT);
  if (place == HADDR_UNDEF) return std::nullopt;
  return place;
}

std::size_t Dataset::size() const {
  return product(shape());
}

template <Number T>
void Dataset::write(std::span<const T> values) {
  about(identifier(), "written", [&] {
    if (values.size() != size()) throw Hdf5Failure("it has another number of values");
    RUBATLAS_HDF5(H5Dwrite(identifier(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  });
}

template <Number T>
std::vector<T> Dataset::read() const {
  return about(identifier(), "read", [&] {
    std::vector<T> values(size());
    RUBATLAS_HDF5(H5Dread(identifier(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
  });
}

namespace {

/// The dataset's space with one block selected.
Handle block_of(Identifier dataset, const Shape& start, const Shape& count) {
  Handle space{RUBATLAS_HDF5(H5Dget_space(dataset)), H5Sclose};
  const auto first = extents(start);
  const auto sizes = extents(count);
  const auto axes = static_cast<std::size_t>(RUBATLAS_HDF5(H5Sget_simple_extent_ndims(space.get())));
  if (first.size() != axes || sizes.size() != axes) throw Hdf5Failure("it has another number of axes");
  RUBATLAS_HDF5(
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, first.data(), nullptr, sizes.data(), nullptr));
  return space;
}

}  // namespace

template <Number T>
void Dataset::write_block(const Shape& start, const Shape& count, std::span<const T> values) {
  about(identifier(), "written", [&] {
    if (values.size() != product(count)) throw Hdf5Failure("its rows have another number of values");
    const Handle where = block_of(identifier(), start, count);
    const Handle memory = simple_space({values.size()});
    RUBATLAS_HDF5(
        H5Dwrite(identifier(), memory_type<T>(), memory.get(), where.get(), H5P_DEFAULT, values.data()));
  });
}

void Dataset::write_bytes(const Shape& start, const Shape& count, std::span<const std::byte> bytes) {
  about(identifier(), "written", [&] {
    if (bytes.size() != product(count) * number_size()) throw Hdf5Failure("its rows have another size");
    const Handle where = block_of(identifier(), start, count);
    const Handle memory = simple_space({product(count)});
    const Handle type{RUBATLAS_HDF5(H5Dget_type(identifier())), H5Tclose};
    RUBATLAS_HDF5(H5Dwrite(identifier(), type.get(), memory.get(), where.get(), H5P_DEFAULT, bytes.data()));
  });
}

template <Number T>
std::vector<T> Dataset::read_block(const Shape& start, const Shape& count) const {
  return about(identifier(), "read", [&] {
    std::vector<T> values(product(count));
    const Handle where = block_of(identifier(), start, count);
    const Handle memory = simple_space({values.size()});
    RUBATLAS_HDF5(
        H5Dread(identifier(), memory_type<T>(), memory.get(), where.get(), H5P_DEFAULT, values.data()));
    return values;
  });
}

void Dataset::make_scale(const std::string& name) {
  RUBATLAS_HDF5(H5DSset_scale(identifier(), name.c_str()));
}

void Dataset::attach_scale(std::size_t axis, const Dataset& scale) {
  RUBATLAS_HDF5(H5DSattach_scale(identifier(), scale.identifier(), static_cast<unsigned>(axis)));
}

bool Dataset::is_scale() const {
  return about(identifier(), "read", [&] { return RUBATLAS_HDF5(H5DSis_scale(identifier())) > 0; });
}

std::string Dataset::scale_name(std::size_t axis) const {
  const int scales = about(identifier(), "asked for its scales", [&] {
    return RUBATLAS_HDF5(H5DSget_num_scales(identifier(), static_cast<unsigned>(axis)));
  });
  if (scales == 0) return {};
  std::string path;
  const auto take_name = [](hid_t, unsigned, hid_t scale, void* result) -> herr_t {
    std::string buffer(256, '\0');
    const ssize_t length = H5Iget_name(scale, buffer.data(), buffer.size());
    if (length > 0)
      static_cast<std::string*>(result)->assign(buffer, 1, static_cast<std::size_t>(length) - 1);
    return 1;  // the first is enough
  };
  about(identifier(), "asked for its scales", [&] {
    RUBATLAS_HDF5(H5DSiterate_scales(identifier(), static_cast<unsigned>(axis), nullptr, take_name, &path));
  });
  return path;
}

#define RUBATLAS_INSTANTIATE(T)                                                          \
  template void Dataset::write<T>(std::span<const T>);                                   \
  template bool Dataset::holds<T>() const;                                               \
  template std::vector<T> Dataset::read<T>() const;                                      \
  template void Dataset::write_block<T>(const Shape&, const Shape&, std::span<const T>); \
  template std::vector<T> Dataset::read_block<T>(const Shape&, const Shape&) const;
RUBATLAS_FOR_EACH_NUMBER(RUBATLAS_INSTANTIATE)
#undef RUBATLAS_INSTANTIATE

}  // namespace rubatlas::atlas
