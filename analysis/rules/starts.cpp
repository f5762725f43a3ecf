#include "analysis/rules/starts.hpp"

#include "settings/quantity.hpp"

namespace rubatlas::analysis {

bool is_initial_axis(std::string_view name) {
  const auto* swept = settings::quantity_of_axis(name);
  return swept != nullptr && swept->section() == "/initial";
}

bool is_start_axis(std::string_view name) {
  return name == plan::kDirectionAxis || is_initial_axis(name);
}

Starts::Starts(std::span<const plan::Axis> axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::size_t extent = axes[i].values.size();
    extents_.push_back(extent);
    is_start_.push_back(is_start_axis(axes[i].name));
    (is_start_.back() ? per_set_ : sets_) *= extent;
    if (!is_start_.back()) parameter_axes_.push_back(i);
  }
}

std::size_t Starts::set_of(std::size_t point) const {
  std::size_t set = 0;
  std::size_t stride = 1;
  for (std::size_t i = extents_.size(); i-- > 0;) {  // the last axis runs fastest
    const std::size_t place = point % extents_[i];
    point /= extents_[i];
    if (is_start_[i]) continue;
    set += place * stride;
    stride *= extents_[i];
  }
  return set;
}

}  // namespace rubatlas::analysis
