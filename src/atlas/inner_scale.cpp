#include "atlas/inner_scale.hpp"

#include <numeric>
#include <span>

namespace rubatlas::atlas {

std::vector<std::int32_t> counted(std::size_t count, std::int32_t first) {
  std::vector<std::int32_t> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

namespace {

template <Number T>
Dataset create_values(File& file, const std::string& name, const std::vector<T>& values) {
  Dataset scale = file.create_dataset<T>(name, {values.size()});
  scale.template write<T>(std::span<const T>(values));
  return scale;
}

Dataset create_values(File& file, const std::string& name, const std::vector<std::string>& words) {
  return file.create_texts(name, words);
}

}  // namespace

Dataset create_inner_scale(File& file, const observables::InnerAxis& axis) {
  Dataset scale =
      std::visit([&](const auto& values) { return create_values(file, axis.name, values); }, axis.values);
  scale.make_scale(axis.name);
  scale.set_text("units", axis.units);
  scale.set_text("long_name", axis.long_name);
  return scale;
}

}  // namespace rubatlas::atlas
