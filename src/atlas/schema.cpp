#include "atlas/schema.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <span>

#include "observables/inner_axis_size.hpp"
#include "settings/linearisation.hpp"

namespace rubatlas::atlas {
namespace {

std::uint64_t number_size(NumberType type) {
  switch (type) {
    case NumberType::float64:
      return sizeof(double);
    case NumberType::int32:
      return sizeof(std::int32_t);
    case NumberType::uint32:
      return sizeof(std::uint32_t);
    case NumberType::uint8:
      return sizeof(std::uint8_t);
    case NumberType::uint16:
      return sizeof(std::uint16_t);
  }
  return 0;
}

constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();

std::uint64_t sum_or_most(std::uint64_t a, std::uint64_t b) {
  return a > kMost - b ? kMost : a + b;
}

std::uint64_t product_or_most(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > kMost / b ? kMost : a * b;
}

std::uint64_t bytes_of(const RowDataset& dataset) {
  return std::accumulate(dataset.shape.begin(), dataset.shape.end(), number_size(dataset.type),
                         product_or_most);
}

}  // namespace

std::vector<const RowDataset*> Schema::row_datasets() const& {
  std::vector<const RowDataset*> all = summed_datasets();
  all.push_back(&row_checksum);
  return all;
}

std::vector<const RowDataset*> Schema::summed_datasets() const& {
  std::vector<const RowDataset*> all{&status, &status_detail, &restarted};
  if (seam) all.push_back(&*seam);
  if (settled) all.push_back(&*settled);
  all.push_back(&failed_revolution);
  all.push_back(&final_state);
  for (const auto& remembered : memories) all.push_back(&remembered);
  for (const auto& kept : observables) all.push_back(&kept);
  return all;
}

std::uint64_t Schema::byte_count() const {
  std::uint64_t sum = 0;
  for (const auto* rows : row_datasets()) sum = sum_or_most(sum, bytes_of(*rows));
  return sum;
}

std::uint64_t Schema::bytes_per_point() const {
  std::uint64_t sum = 0;
  for (const auto* rows : row_datasets()) sum += bytes_per_point(*rows);
  return sum;
}

std::uint64_t Schema::bytes_per_point(const RowDataset& rows) const {
  const auto inner = std::span(rows.shape).subspan(axes.size());
  return std::accumulate(inner.begin(), inner.end(), number_size(rows.type), std::multiplies<>());
}

Schema schema_of(const settings::Scene& scene) {
  Schema schema;
  schema.axes = plan::Grid(scene).axes();

  const auto shape_over = [&](const std::vector<std::string>& inner) {
    Shape shape;
    for (const auto& axis : schema.axes) shape.push_back(axis.values.size());
    for (const auto& name : inner) shape.push_back(observables::inner_axis_size(name, scene));
    return shape;
  };

  const auto rows_of = [&](std::string name, NumberType type, std::vector<std::string> inner,
                           std::string units, std::string long_name) {
    Shape shape = shape_over(inner);
    return RowDataset{.name = std::move(name),
                      .type = type,
                      .inner_axes = std::move(inner),
                      .shape = std::move(shape),
                      .units = std::move(units),
                      .long_name = std::move(long_name)};
  };
  schema.status = rows_of("status", NumberType::uint8, {}, "", "how the point ended");
  schema.status_detail = rows_of("status_detail", NumberType::uint8, {}, "", "what ended the point's motion");
  schema.restarted = rows_of("restarted", NumberType::uint8, {}, "", "what the point started from");
  if (scene.pieces) {
    schema.seam = rows_of("seam", NumberType::uint8, {}, "",
                          "what became of the point where two pieces of its line meet");
  }
  if (settings::may_settle(scene)) {
    schema.settled =
        rows_of("settled", NumberType::uint16, {}, "",
                "revolutions, 65535 at most, that were run before the motion had settled on a cycle "
                "of which one period stands for all sampled revolutions; 0: it had not, and the "
                "whole protocol was run");
  }
  schema.failed_revolution =
      rows_of("failed_revolution", NumberType::int32, {}, "",
              "revolution, counted from 0, in which status became 2 or 3; -1 elsewhere");
  schema.final_state = rows_of("final_state", NumberType::float64, {"component"}, "m",
                               "state at the end of the point: x, y [m], dx/dtau, dy/dtau [m per unit tau]");
  for (const auto& remembered : observables::memories(scene)) {
    schema.memories.push_back(rows_of(remembered.name, NumberType::float64, remembered.inner_axes,
                                      remembered.units, remembered.long_name));
  }
  for (const auto& kept : observables::descriptions(scene)) {
    const NumberType type = kept.flags.empty() ? NumberType::float64 : NumberType::uint8;
    RowDataset& rows = schema.observables.emplace_back(
        rows_of(kept.name, type, kept.inner_axes, kept.units, kept.long_name));
    rows.flags = kept.flags;
  }
  schema.row_checksum =
      rows_of("row_checksum", NumberType::uint32, {}, "",
              "CRC-32 of the point's row in the datasets of the attribute `order`, one after "
              "the other, as their bytes stand in the file");
  return schema;
}

}  // namespace rubatlas::atlas
