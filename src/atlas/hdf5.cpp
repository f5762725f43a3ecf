#include "atlas/hdf5.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>
#include <mpi.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>

#include "atlas/environment_error.hpp"
#include "atlas/hdf5_check.hpp"

namespace rubatlas::atlas {

static_assert(std::is_same_v<hid_t, Identifier>);

namespace {

template <Number T>
Identifier memory_type() {
  if constexpr (std::same_as<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::same_as<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::same_as<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::same_as<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::same_as<T, std::int64_t>) return H5T_NATIVE_INT64;
}

template <Number T>
Identifier file_type() {
  if constexpr (std::same_as<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::same_as<T, std::uint8_t>) return H5T_STD_U8LE;
  if constexpr (std::same_as<T, std::int32_t>) return H5T_STD_I32LE;
  if constexpr (std::same_as<T, std::uint32_t>) return H5T_STD_U32LE;
  if constexpr (std::same_as<T, std::int64_t>) return H5T_STD_I64LE;
}

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

Handle dataset_properties() {
  Handle list = property_list(H5P_DATASET_CREATE);
  RUBATLAS_HDF5(H5Pset_obj_track_times(list.get(), false));
  return list;
}

/// `size` bytes, or H5T_VARIABLE.
Handle text_type(std::size_t size) {
  Handle type{RUBATLAS_HDF5(H5Tcopy(H5T_C_S1)), H5Tclose};
  RUBATLAS_HDF5(H5Tset_size(type.get(), size));
  RUBATLAS_HDF5(H5Tset_cset(type.get(), H5T_CSET_UTF8));
  if (size != H5T_VARIABLE) RUBATLAS_HDF5(H5Tset_strpad(type.get(), H5T_STR_NULLPAD));
  return type;
}

/// A text of variable or fixed length, read through `read(memory type, buffer)`.
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

/// A scalar attribute (a text or a number): the buffer that it is read into has room for one value.
void require_one_value(const Handle& space) {
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw Hdf5Failure("it is not one value");
}

/// Serial access without HDF5's own lock: an exclusive lock would shut readers out while an atlas is written.
Handle access_without_lock() {
  Handle list = property_list(H5P_FILE_ACCESS);
  RUBATLAS_HDF5(H5Pset_file_locking(list.get(), false, true));
  return list;
}

/// Datasets of at least `kLarge` bytes begin at a multiple of `kAlignment`, which is a multiple of the usual
/// stripes of parallel file systems. The gaps before them take at most an eighth of the file, and no disk.
constexpr hsize_t kAlignment = hsize_t{1} << 20;
constexpr hsize_t kLarge = 8 * kAlignment;

bool mpi_is_running() {
  int initialized = 0;
  int finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  return initialized != 0 && finalized == 0;
}

}  // namespace

std::size_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

void Handle::close() {
  if (!is_open()) return;
  const std::string what = described(identifier_);
  if (close_(std::exchange(identifier_, kNone)) >= 0) return;
  try {
    throw_hdf5_failure();
  } catch (const Hdf5Failure& failure) {
    throw EnvironmentError(fmt::format("{} cannot be closed: {}", what, failure.what()));
  }
}

// Attributes
// ----------------------------------------------------------------------------------------------------

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

// Datasets
// ------------------------------------------------------------------------------------------------------

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

// Files
// ---------------------------------------------------------------------------------------------------------

namespace {

/// Makes HDF5 calls on a file that is not open yet.
template <typename Calls>
Handle opened(const std::filesystem::path& path, const char* deed, const Calls& calls) {
  prepare_hdf5();
  try {
    return {calls(), H5Fclose};
  } catch (const Hdf5Failure& failure) {
    throw EnvironmentError(fmt::format("{} cannot be {}: {}", path.string(), deed, failure.what()));
  }
}

}  // namespace

File File::create(const std::filesystem::path& path) {
  return File(opened(path, "created", [&] {
    const Handle creation = property_list(H5P_FILE_CREATE);
    RUBATLAS_HDF5(H5Pset_obj_track_times(creation.get(), false));
    const Handle access = access_without_lock();
    RUBATLAS_HDF5(H5Pset_alignment(access.get(), kLarge, kAlignment));
    return RUBATLAS_HDF5(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()));
  }));
}

File File::open_to_read(const std::filesystem::path& path) {
  std::error_code unknown;
  const auto kind = std::filesystem::status(path, unknown);
  // Opening a pipe would block until another process opens its other end.
  if (std::filesystem::exists(kind) && !std::filesystem::is_regular_file(kind)) {
    throw EnvironmentError(path.string() + " cannot be opened: it is not a file");
  }
  return File(opened(path, "opened", [&] {
    const Handle access = access_without_lock();
    return RUBATLAS_HDF5(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()));
  }));
}

File File::open_to_write(const std::filesystem::path& path) {
  return File(opened(path, "opened to write", [&] {
    const Handle access = access_without_lock();
    if (mpi_is_running()) {
      RUBATLAS_HDF5(H5Pset_fapl_mpio(access.get(), MPI_COMM_WORLD, MPI_INFO_NULL));
    } else {
      // The sieve buffer would delay rows and write them in another order.
      RUBATLAS_HDF5(H5Pset_sieve_buf_size(access.get(), 0));
    }
    return RUBATLAS_HDF5(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()));
  }));
}

Object File::root() const {
  return group("/");
}

Object File::group(const std::string& path) const {
  return about(handle_.get(), ("asked for the group " + path).c_str(), [&] {
    return Object({RUBATLAS_HDF5(H5Gopen2(handle_.get(), path.c_str(), H5P_DEFAULT)), H5Gclose});
  });
}

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

namespace {

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

bool File::has(const std::string& path) const {
  // HDF5 fails, instead of answering "no", where a group on the way does not exist.
  for (auto end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    const auto exists = [&] {
      return RUBATLAS_HDF5(H5Lexists(handle_.get(), part.c_str(), H5P_DEFAULT)) > 0;
    };
    if (part != "/" && !about(handle_.get(), ("asked for " + part).c_str(), exists)) return false;
    if (end == std::string::npos) return true;
  }
}

bool File::has_dataset(const std::string& path) const {
  return about(handle_.get(), "listed", [&] {
    if (!has(path)) return false;
    H5L_info_t link{};
    RUBATLAS_HDF5(H5Lget_info(handle_.get(), path.c_str(), &link, H5P_DEFAULT));
    if (link.type != H5L_TYPE_HARD) return false;
    const Handle object{RUBATLAS_HDF5(H5Oopen(handle_.get(), path.c_str(), H5P_DEFAULT)), H5Oclose};
    return H5Iget_type(object.get()) == H5I_DATASET;
  });
}

Dataset File::dataset(const std::string& path) const {
  return about(handle_.get(), ("asked for " + path).c_str(), [&] {
    Handle found{RUBATLAS_HDF5(H5Dopen2(handle_.get(), path.c_str(), H5P_DEFAULT)), H5Dclose};
    return Dataset(std::move(found));
  });
}

std::string File::read_text(const std::string& path) const {
  const Dataset stored = dataset(path);
  return about(stored.identifier(), "read", [&] {
    const Handle type{RUBATLAS_HDF5(H5Dget_type(stored.identifier())), H5Tclose};
    require_one_value({RUBATLAS_HDF5(H5Dget_space(stored.identifier())), H5Sclose});
    return read_one_text(type.get(), [&](Identifier memory, void* buffer) {
      RUBATLAS_HDF5(H5Dread(stored.identifier(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer));
    });
  });
}

std::vector<std::string> File::read_texts(const std::string& path) const {
  const Dataset stored = dataset(path);
  std::size_t length = 0;
  const std::string raw = about(stored.identifier(), "read", [&] {
    const Handle type{RUBATLAS_HDF5(H5Dget_type(stored.identifier())), H5Tclose};
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) {
      throw Hdf5Failure("it does not hold texts of one length");
    }
    length = H5Tget_size(type.get());
    std::string bytes(length * stored.size(), '\0');
    RUBATLAS_HDF5(
        H5Dread(stored.identifier(), text_type(length).get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()));
    return bytes;
  });
  std::vector<std::string> texts;
  for (std::size_t at = 0; at < raw.size(); at += length) {
    const std::string text = raw.substr(at, length);
    texts.push_back(text.substr(0, text.find('\0')));
  }
  return texts;
}

std::vector<std::string> File::names(const std::string& group) const {
  std::vector<std::string> found;
  const auto keep = [](hid_t, const char* name, const H5L_info_t*, void* result) -> herr_t {
    static_cast<std::vector<std::string>*>(result)->emplace_back(name);
    return 0;
  };
  about(handle_.get(), "listed", [&] {
    const Handle owner{RUBATLAS_HDF5(H5Gopen2(handle_.get(), group.c_str(), H5P_DEFAULT)), H5Gclose};
    RUBATLAS_HDF5(H5Literate(owner.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, keep, &found));
  });
  return found;
}

// The number types
// -----------------------------------------------------------------------------------------

#define RUBATLAS_FOR_NUMBER(T)                                                           \
  template void Object::set_number<T>(const std::string&, T);                            \
  template void Object::set_numbers<T>(const std::string&, std::span<const T>);          \
  template void Dataset::write<T>(std::span<const T>);                                   \
  template bool Dataset::holds<T>() const;                                               \
  template std::vector<T> Dataset::read<T>() const;                                      \
  template void Dataset::write_block<T>(const Shape&, const Shape&, std::span<const T>); \
  template std::vector<T> Dataset::read_block<T>(const Shape&, const Shape&) const;      \
  template Dataset File::create_dataset<T>(const std::string&, const Shape&);            \
  template Dataset File::create_sparse_dataset<T>(const std::string&, const Shape&);     \
  template Dataset File::create_filled_dataset<T>(const std::string&, const Shape&, T);  \
  template Dataset File::create_packed_dataset<T>(const std::string&, const Shape&, T);
RUBATLAS_FOR_NUMBER(double)
RUBATLAS_FOR_NUMBER(std::uint8_t)
RUBATLAS_FOR_NUMBER(std::int32_t)
RUBATLAS_FOR_NUMBER(std::uint32_t)
RUBATLAS_FOR_NUMBER(std::int64_t)
#undef RUBATLAS_FOR_NUMBER

}  // namespace rubatlas::atlas
