// What is new in a file of HDF5: groups and datasets, none of which stores a time stamp.
#include <algorithm>

#include "atlas/hdf5.hpp"
#include "atlas/hdf5_check.hpp"
#include "atlas/hdf5_types.hpp"

namespace rubatlas::atlas {
namespace {

Handle dataset_properties() {
  Handle list = property_list(H5P_DATASET_CREATE);
  RUBATLAS_HDF5(H5Pset_obj_track_times(list.get(), false));
  return list;
}

/// Whoever reads a row decompresses its chunk, and HDF5 keeps chunks of up to 1 MiB at hand.
constexpr std::size_t kBytesOfChunk = std::size_t{512} << 10;
/// Of zlib. Level 9 takes three times as long and saves less than one part in a hundred.
constexpr unsigned kDeflateLevel = 4;

/// A chunk of consecutive numbers in C order: all of the inner axes, part of one axis, one index of the outer
/// axes.
std::vector<hsize_t> chunk_of(const Shape& shape, std::size_t number_size) {
  std::vector<hsize_t> chunk(shape.size(), 1);
  std::size_t room = kBytesOfChunk / number_size;
  for (std::size_t axis = shape.size(); axis-- > 0 && room > 1; room /= shape[axis]) {
    chunk[axis] = std::min(shape[axis], room);
  }
  return chunk;
}

}  // namespace

Object File::create_group(const std::string& path) {
  const Handle links = property_list(H5P_LINK_CREATE);
  RUBATLAS_HDF5(H5Pset_create_intermediate_group(links.get(), 1));
  const Handle properties = property_list(H5P_GROUP_CREATE);
  RUBATLAS_HDF5(H5Pset_obj_track_times(properties.get(), false));
  return Object(
      {RUBATLAS_HDF5(H5Gcreate2(handle_.get(), path.c_str(), links.get(), properties.get(), H5P_DEFAULT)),
       H5Gclose});
}

Dataset File::create(const std::string& path, Identifier type, const Shape& shape, Identifier properties) {
  const Handle links = property_list(H5P_LINK_CREATE);
  RUBATLAS_HDF5(H5Pset_create_intermediate_group(links.get(), 1));
  const Handle space = simple_space(shape);
  Handle created{RUBATLAS_HDF5(H5Dcreate2(handle_.get(), path.c_str(), type, space.get(), links.get(),
                                          properties, H5P_DEFAULT)),
                 H5Dclose};
  return Dataset(std::move(created));
}

template <Number T>
Dataset File::create_dataset(const std::string& path, const Shape& shape) {
  return create(path, file_type<T>(), shape, dataset_properties().get());
}

template <Number T>
Dataset File::create_sparse_dataset(const std::string& path, const Shape& shape) {
  const Handle properties = dataset_properties();
  RUBATLAS_HDF5(H5Pset_layout(properties.get(), H5D_CONTIGUOUS));
  RUBATLAS_HDF5(H5Pset_alloc_time(properties.get(), H5D_ALLOC_TIME_EARLY));
  RUBATLAS_HDF5(H5Pset_fill_time(properties.get(), H5D_FILL_TIME_NEVER));
  return create(path, file_type<T>(), shape, properties.get());
}

template <Number T>
Dataset File::create_filled_dataset(const std::string& path, const Shape& shape, T fill) {
  const Handle properties = dataset_properties();
  RUBATLAS_HDF5(H5Pset_layout(properties.get(), H5D_CONTIGUOUS));
  RUBATLAS_HDF5(H5Pset_alloc_time(properties.get(), H5D_ALLOC_TIME_EARLY));
  RUBATLAS_HDF5(H5Pset_fill_value(properties.get(), memory_type<T>(), &fill));
  RUBATLAS_HDF5(H5Pset_fill_time(properties.get(), H5D_FILL_TIME_ALLOC));
  return create(path, file_type<T>(), shape, properties.get());
}

template <Number T>
Dataset File::create_packed_dataset(const std::string& path, const Shape& shape, T fill) {
  const Handle properties = dataset_properties();
  const auto chunk = chunk_of(shape, sizeof(T));
  RUBATLAS_HDF5(H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data()));
  RUBATLAS_HDF5(H5Pset_fill_value(properties.get(), memory_type<T>(), &fill));
  RUBATLAS_HDF5(H5Pset_shuffle(properties.get()));
  RUBATLAS_HDF5(H5Pset_deflate(properties.get(), kDeflateLevel));
  return create(path, file_type<T>(), shape, properties.get());
}

Dataset File::create_text(const std::string& path, const std::string& text) {
  const Handle type = text_type(H5T_VARIABLE);
  Dataset dataset = create(path, type.get(), {}, dataset_properties().get());
  const char* raw = text.c_str();
  RUBATLAS_HDF5(H5Dwrite(dataset.identifier(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                         static_cast<const void*>(&raw)));
  return dataset;
}

Dataset File::create_texts(const std::string& path, const std::vector<std::string>& texts) {
  std::size_t length = 1;  // HDF5 knows no strings of length 0
  for (const auto& text : texts) length = std::max(length, text.size());
  std::string padded;
  for (const auto& text : texts) (padded += text).resize(padded.size() + length - text.size(), '\0');
  const Handle type = text_type(length);
  Dataset dataset = create(path, type.get(), {texts.size()}, dataset_properties().get());
  RUBATLAS_HDF5(H5Dwrite(dataset.identifier(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()));
  dataset.set_text("_Encoding", "utf-8");  // netCDF's word for bytes that are text: xarray gives them as str
  return dataset;
}

#define RUBATLAS_INSTANTIATE(T)                                                         \
  template Dataset File::create_dataset<T>(const std::string&, const Shape&);           \
  template Dataset File::create_sparse_dataset<T>(const std::string&, const Shape&);    \
  template Dataset File::create_filled_dataset<T>(const std::string&, const Shape&, T); \
  template Dataset File::create_packed_dataset<T>(const std::string&, const Shape&, T);
RUBATLAS_FOR_EACH_NUMBER(RUBATLAS_INSTANTIATE)
#undef RUBATLAS_INSTANTIATE

}  // namespace rubatlas::atlas
