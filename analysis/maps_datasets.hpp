/// Datasets of MAPS.h5: maps, with one entry per point of the atlas, and tables, with one entry per row.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "analysis/maps_table.hpp"
#include "atlas/hdf5.hpp"

namespace rubatlas::analysis {

/// A dataset over the axes of the atlas.
template <typename T>
atlas::Dataset create_map(atlas::File& file, const std::string& path, const atlas::Shape& shape,
                          std::span<const atlas::Dataset> axes, std::span<const T> values,
                          const std::string& units, const std::string& long_name) {
  atlas::Dataset dataset = file.create_dataset<T>(path, shape);
  dataset.template write<T>(values);
  for (std::size_t i = 0; i < axes.size(); ++i) dataset.attach_scale(i, axes[i]);
  dataset.set_text("units", units);
  dataset.set_text("long_name", long_name);
  return dataset;
}

/// A group whose datasets have one entry per row.
class Rows {
 public:
  /// Creates the group with the scale `row`, which numbers its rows from 0.
  Rows(atlas::File& file, const std::string& group, const std::string& row, std::size_t size,
       const std::string& long_name)
      : file_(file), group_(group), size_(size) {
    file_.create_group(group).set_text("long_name", long_name);
    scale_.push_back(create_number_scale(file_, fmt::format("{}/{}", group_, row), row, size_,
                                         fmt::format("number of the {}", row)));
  }

  /// `value(i)` is the entry of row i.
  template <typename T, typename Value>
  atlas::Dataset add(const std::string& name, const std::string& units, const std::string& long_name,
                     Value value) {
    std::vector<T> values;
    values.reserve(size_);
    for (std::size_t i = 0; i < size_; ++i) values.push_back(value(i));
    atlas::Dataset dataset = file_.create_dataset<T>(fmt::format("{}/{}", group_, name), {size_});
    dataset.template write<T>(values);
    dataset.attach_scale(0, scale_.front());
    dataset.set_text("units", units);
    dataset.set_text("long_name", long_name);
    return dataset;
  }

 private:
  atlas::File& file_;
  std::string group_;
  std::size_t size_;
  std::vector<atlas::Dataset> scale_;  ///< one
};

}  // namespace rubatlas::analysis
