#include "atlas/atlas_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "atlas/point_index.hpp"
#include "atlas/structure.hpp"

namespace rubatlas::atlas {
namespace {

/// Axis values are copied from scenes, whereas a caller's value may have been typed with fewer digits than
/// are stored.
constexpr double kSameParameter = 1e-9;

std::optional<std::size_t> index_of(const std::vector<double>& values, double value) {
  const auto nearest =
      std::ranges::min_element(values, {}, [value](double there) { return std::abs(there - value); });
  if (std::abs(*nearest - value) > kSameParameter * std::max(std::abs(*nearest), std::abs(value)))
    return std::nullopt;
  return static_cast<std::size_t>(nearest - values.begin());
}

}  // namespace

AtlasReader::AtlasReader(const std::filesystem::path& path)
    : path_(path),
      file_(open_with_care(path)),
      axes_(require_atlas(file_, path.string())),
      part_(require_part(file_, path.string(), axes_)) {}

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

std::vector<std::uint8_t> AtlasReader::seam() const {
  return file_.dataset("/seam").read<std::uint8_t>();
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

/// The block at `start` (grid axes) with extent 1 along the first `axes_fixed` axes and full extent along the
/// others.
std::vector<double> AtlasReader::read_from(const std::string& name, Shape start,
                                           std::size_t axes_fixed) const {
  const Dataset dataset = file_.dataset(name);
  Shape count = dataset.shape();
  start.resize(count.size(), 0);
  std::fill_n(count.begin(), axes_fixed, std::size_t{1});
  return dataset.read_block<double>(start, count);
}

bool AtlasReader::has_checksums() const {
  return !lacks_checksums(file_);
}

std::string AtlasReader::place_of(std::size_t point) const {
  const Shape index = point_index(shape(), point);
  std::vector<std::string> places;
  for (std::size_t i = axes_.size(); i-- > 0;) {
    const auto& axis = axes_[i];
    if (axis.values.size() == 1 && i + 1 < axes_.size()) continue;
    places.push_back(fmt::format("{}={}", axis.name, axis.values[index[i]]));
  }
  return fmt::format("{}", fmt::join(places, ", "));
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
  if (axes_.front().name == plan::kDirectionAxis)
    wanted.insert(wanted.begin(), static_cast<double>(direction));
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
