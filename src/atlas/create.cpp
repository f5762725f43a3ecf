#include "atlas/create.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
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
    if (axis.name == "direction") {
      scale.set_numbers<double>("flag_values", axis.values);
      scale.set_text("flag_meanings", "up down");
    }
    scales.emplace(axis.name, std::move(scale));
  }
}

/// Large datasets are allocated early and never filled, so that a new atlas costs neither disk nor time, and
/// writing a row changes no metadata. Only `failed_revolution` is filled, because its zero would be the
/// number of a revolution.
Dataset create_rows(File& file, const RowDataset& rows) {
  switch (rows.type) {
    case NumberType::uint8:
      return file.create_sparse_dataset<std::uint8_t>(rows.name, rows.shape);
    case NumberType::uint32:
      return file.create_sparse_dataset<std::uint32_t>(rows.name, rows.shape);
    case NumberType::int32:
      return file.create_filled_dataset<std::int32_t>(rows.name, rows.shape, -1);
    case NumberType::float64:
      break;
  }
  return file.create_sparse_dataset<double>(rows.name, rows.shape);
}

void create_row_dataset(File& file, const Schema& schema, const RowDataset& rows, const Scales& scales) {
  Dataset dataset = create_rows(file, rows);
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
  if (rows.name == "status_detail") {
    std::vector<std::uint8_t> values;
    std::vector<std::string_view> meanings;
    for (const auto& entry : point::kStatusDetails) {
      values.push_back(static_cast<std::uint8_t>(entry.detail));
      meanings.emplace_back(entry.name);
    }
    set_flags(values, fmt::format("{}", fmt::join(meanings, " ")));
  }
}

}  // namespace

void create_atlas(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                  const Software& software,
                  const std::function<void(const std::filesystem::path&)>& before_it_appears) {
  const Schema schema = schema_of(scene);
  Publication publication(output);
  File file = File::create(publication.name());
  create_header_checksum(file.root(), schema.row_datasets().size());
  write_provenance(file.root(), software, FileKind::atlas, scene.title);
  file.create_text("/scene", scene_text).set_text("long_name", "the scene file, as it was given");
  file.create_text("/scene_resolved", settings::resolved_json(scene))
      .set_text("long_name", "the scene with every default and every axis value written out");
  {
    Scales scales;
    create_grid_scales(file, schema, scales);
    for (const auto& axis : observables::inner_axes(scene))
      scales.emplace(axis.name, create_inner_scale(file, axis));
    for (const auto* rows : schema.row_datasets()) create_row_dataset(file, schema, *rows, scales);
    std::vector<std::string> order;
    for (const auto* rows : schema.summed_datasets()) order.push_back(rows->name);
    file.dataset(schema.row_checksum.name).set_text("order", fmt::format("{}", fmt::join(order, " ")));
  }
  file.close();
  seal_header(publication.name());
  if (before_it_appears) before_it_appears(publication.name());
  publication.publish();
}

}  // namespace rubatlas::atlas
