#include "atlas/hdf5.hpp"

#include <mpi.h>

#include "atlas/environment_error.hpp"
#include "atlas/hdf5_check.hpp"
#include "atlas/hdf5_types.hpp"

namespace rubatlas::atlas {
namespace {

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

}  // namespace rubatlas::atlas
