#include "atlas/atlas_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "atlas/environment_error.hpp"
#include "atlas/point_index.hpp"
#include "atlas/software.hpp"

namespace rubatlas::atlas {
namespace {

File open_atlas(const std::filesystem::path& path) {
  try {
    return File::open_to_read(path);
  } catch (const EnvironmentError& error) {
    throw EnvironmentError(fmt::format("{} cannot be opened as an atlas: {}", path.string(), error.what()));
  }
}

/// The axes are the scales of `/status`: whatever axes another version adds, they are found.
std::vector<plan::Axis> read_axes(const File& file) {
  const Dataset status = file.dataset("/status");
  std::vector<plan::Axis> axes;
  for (std::size_t i = 0; i < status.shape().size(); ++i) {
    const std::string name = status.scale_name(i);
    const Dataset scale = file.dataset(name);
    axes.push_back({name, scale.read<double>(), scale.text("units"), scale.text("long_name")});
  }
  return axes;
}

/// Axis values are copied from scenes, but a caller's may have been typed with fewer digits than were stored.
constexpr double kSameParameter = 1e-9;

std::optional<std::size_t> index_of(const std::vector<double>& values, double value) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i] - value) <= kSameParameter * std::max(std::abs(values[i]), std::abs(value)))
      return i;
  }
  return std::nullopt;
}

}  // namespace

AtlasReader::AtlasReader(const std::filesystem::path& path) : file_(open_atlas(path)) {
  if (!file_.has("/status") || !file_.has("/scene_resolved") ||
      !file_.root().has_attribute("schema_version")) {
    throw EnvironmentError(fmt::format("{} is not an atlas of rubatlas", path.string()));
  }
  if (const std::string version = file_.root().text("schema_version"); version != kSchemaVersion) {
    throw EnvironmentError(fmt::format("{} has the layout of version {}; this program reads version {}",
                                       path.string(), version, kSchemaVersion));
  }
  axes_ = read_axes(file_);
}

Shape AtlasReader::shape() const {
  Shape extents;
  for (const auto& axis : axes_) extents.push_back(axis.values.size());
  return extents;
}

std::size_t AtlasReader::point_count() const {
  return product(shape());
}

std::vector<std::uint8_t> AtlasReader::status() const {
  return file_.dataset("/status").read<std::uint8_t>();
}

Shape AtlasReader::row_shape(const std::string& name) const {
  const Shape whole = file_.dataset(name).shape();
  return {whole.begin() + static_cast<std::ptrdiff_t>(axes_.size()), whole.end()};
}

std::vector<double> AtlasReader::rows(const std::string& name) const {
  return file_.dataset(name).read<double>();
}

std::vector<double> AtlasReader::line_rows(const std::string& name, std::size_t line) const {
  return read_from(name, point_index(shape(), line * speed_count()), axes_.size() - 1);
}

std::vector<double> AtlasReader::row(const std::string& name, std::size_t point) const {
  return read_from(name, point_index(shape(), point), axes_.size());
}

/// The block at `start` (grid axes) that is one thick along the first `axes_fixed` axes and whole behind
/// them.
std::vector<double> AtlasReader::read_from(const std::string& name, Shape start,
                                           std::size_t axes_fixed) const {
  const Dataset dataset = file_.dataset(name);
  Shape count = dataset.shape();
  start.resize(count.size(), 0);
  std::fill_n(count.begin(), axes_fixed, std::size_t{1});
  return dataset.read_block<double>(start, count);
}

std::vector<double> AtlasReader::inner_axis(const std::string& name) const {
  return file_.dataset(name).read<double>();
}

std::array<double, 4> AtlasReader::final_state(std::size_t point) const {
  const auto stored = row("/final_state", point);
  std::array<double, 4> state{};
  std::copy_n(stored.begin(), state.size(), state.begin());
  return state;
}

std::optional<std::size_t> AtlasReader::find(const plan::PointParameters& parameters,
                                             plan::Direction direction) const {
  std::vector<double> wanted = plan::values_of(parameters);
  if (axes_.front().name == "direction") wanted.insert(wanted.begin(), static_cast<double>(direction));
  if (wanted.size() != axes_.size()) return std::nullopt;
  std::size_t point = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto index = index_of(axes_[i].values, wanted[i]);
    if (!index) return std::nullopt;
    point = point * axes_[i].values.size() + *index;
  }
  return point;
}

}  // namespace rubatlas::atlas
