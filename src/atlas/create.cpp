#include "atlas/create.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "atlas/hdf5.hpp"
#include "atlas/header_checksum.hpp"
#include "atlas/inner_scale.hpp"
#include "atlas/publish.hpp"
#include "atlas/schema.hpp"
#include "point/line_solver.hpp"
#include "settings/identifier.hpp"
#include "settings/reader.hpp"

namespace rubatlas::atlas {
namespace {

using Scales = std::map<std::string, Dataset>;

void create_grid_scales(File& file, const Schema& schema, Scales& scales) {
  for (const auto& axis : schema.axes) {
    Dataset scale = file.create_dataset<double>(axis.name, {axis.values.size()});
    scale.write<double>(axis.values);
    scale.make_scale(axis.name);
    scale.set_text("units", axis.units);
    scale.set_text("long_name", axis.long_name);
    if (axis.name == plan::kDirectionAxis) {
      scale.set_numbers<double>("flag_values", axis.values);
      scale.set_text("flag_meanings", "up down");
    }
    scales.emplace(axis.name, std::move(scale));
  }
}

/// Large datasets with fixed places are allocated early and never filled, so that a new atlas costs neither
/// disk nor time, and writing a row changes no metadata. Only `failed_revolution` is filled, because its zero
/// would be the number of a revolution.
template <Number T>
Dataset create_numbers(File& file, const RowDataset& rows, RowStorage storage) {
  constexpr T kNoRow = static_cast<T>(std::same_as<T, std::int32_t> ? -1 : 0);
  if (storage == RowStorage::packed) return file.create_packed_dataset<T>(rows.name, rows.shape, kNoRow);
  if (kNoRow != 0) return file.create_filled_dataset<T>(rows.name, rows.shape, kNoRow);
  return file.create_sparse_dataset<T>(rows.name, rows.shape);
}

Dataset create_rows(File& file, const RowDataset& rows, RowStorage storage) {
  switch (rows.type) {
    case NumberType::uint8:
      return create_numbers<std::uint8_t>(file, rows, storage);
    case NumberType::uint16:
      return create_numbers<std::uint16_t>(file, rows, storage);
    case NumberType::uint32:
      return create_numbers<std::uint32_t>(file, rows, storage);
    case NumberType::int32:
      return create_numbers<std::int32_t>(file, rows, storage);
    case NumberType::float64:
      break;
  }
  return create_numbers<double>(file, rows, storage);
}

void create_row_dataset(File& file, const Schema& schema, const RowDataset& rows, const Scales& scales,
                        RowStorage storage) {
  Dataset dataset = create_rows(file, rows, storage);
  dataset.set_text("long_name", rows.long_name);
  if (rows.type == NumberType::float64) dataset.set_text("units", rows.units);
  std::size_t position = 0;
  for (const auto& axis : schema.axes) dataset.attach_scale(position++, scales.at(axis.name));
  for (const auto& name : rows.inner_axes) dataset.attach_scale(position++, scales.at(name));

  const auto set_flags = [&](std::span<const std::uint8_t> values, const std::string& meanings) {
    dataset.set_numbers<std::uint8_t>("flag_values", values);
    dataset.set_text("flag_meanings", meanings);
  };
  constexpr std::array<std::uint8_t, 4> kValues{0, 1, 2, 3};
  if (rows.name == "status") set_flags(kValues, "pending done left_validity integrator_failed");
  if (rows.name == "restarted")
    set_flags(std::span(kValues).first(2), "continued_from_neighbour started_from_initial");
  if (rows.name == "seam") set_flags(kValues, "none agrees repaired aperiodic_on_both_sides");
  if (!rows.flags.empty()) set_flags(std::span(kValues), rows.flags);
  if (rows.name == "status_detail") {
    std::vector<std::uint8_t> values;
    std::vector<std::string_view> meanings;
    for (const auto& entry : ending::kStatusDetails) {
      values.push_back(static_cast<std::uint8_t>(entry.detail));
      meanings.emplace_back(entry.name);
    }
    set_flags(values, fmt::format("{}", fmt::join(meanings, " ")));
  }
}

}  // namespace

File create_unsealed(const std::filesystem::path& name, const AtlasHeader& header, RowStorage storage) {
  const settings::Scene& scene = header.scene;
  const Schema schema = schema_of(scene);
  File file = File::create(name);
  create_header_checksum(file.root(), storage == RowStorage::fixed ? schema.row_datasets().size() : 0);
  write_provenance(file.root(), header.software, FileKind::atlas, scene);
  file.root().set_text("identifier", settings::identifier_of(scene));
  if (!header.part.is_whole()) file.root().set_text("part", plan::text_of(header.part));
  file.create_text("/scene", header.scene_text).set_text("long_name", "the scene file, as it was given");
  file.create_text("/scene_resolved", settings::resolved_json(scene))
      .set_text("long_name", "the scene with every default and every axis value written out");
  {
    Scales scales;
    create_grid_scales(file, schema, scales);
    for (const auto& axis : observables::inner_axes(scene))
      scales.emplace(axis.name, create_inner_scale(file, axis));
    for (const auto* rows : schema.row_datasets()) create_row_dataset(file, schema, *rows, scales, storage);
    std::vector<std::string> order;
    for (const auto* rows : schema.summed_datasets()) order.push_back(rows->name);
    file.dataset(schema.row_checksum.name).set_text("order", fmt::format("{}", fmt::join(order, " ")));
  }
  return file;
}

void create_atlas(const Output& output, const AtlasHeader& header,
                  const std::function<void(const std::filesystem::path&)>& before_it_appears) {
  Publication publication(output);
  create_unsealed(publication.name(), header, RowStorage::fixed).close();
  seal_header(publication.name());
  if (before_it_appears) before_it_appears(publication.name());
  publication.publish();
}

}  // namespace rubatlas::atlas
