/// The contents of an atlas as they follow from the scene: axes, datasets, their shapes, types and meanings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas/hdf5.hpp"
#include "observables/list.hpp"
#include "plan/grid.hpp"
#include "settings/scene.hpp"

namespace rubatlas::atlas {

enum class NumberType : std::uint8_t { float64, uint8, uint16, int32, uint32 };

/// One dataset with a row per point.
struct RowDataset {
  std::string name;
  NumberType type = NumberType::float64;
  std::vector<std::string> inner_axes;  ///< these follow the axes of the grid, outermost first
  Shape shape;                          ///< grid's extents, then the inner ones
  std::string units;
  std::string long_name;
  std::string flags{};  ///< of an observable whose values are flags, as `observables::Description`
};

struct Schema {
  std::vector<plan::Axis> axes;
  RowDataset status;
  RowDataset status_detail;
  RowDataset restarted;
  std::optional<RowDataset> seam;     ///< only where the scene has `pieces`
  std::optional<RowDataset> settled;  ///< only where the scene's transients end on cycles
  RowDataset failed_revolution;
  RowDataset final_state;
  std::vector<RowDataset> memories;  ///< `/final_state_<effect>`, in the order of `observables::memories`
  std::vector<RowDataset>
      observables;  ///< in the order of `observables::descriptions`; the five above are always there
  RowDataset row_checksum;

  /// All datasets with a row per point, in the order in which they are created; `status` first,
  /// `row_checksum` last.
  [[nodiscard]] std::vector<const RowDataset*> row_datasets() const&;
  std::vector<const RowDataset*> row_datasets() && = delete;  // they point into the schema
  /// The datasets that a row's checksum covers, in its order: all except the checksum.
  [[nodiscard]] std::vector<const RowDataset*> summed_datasets() const&;

  /// Bytes of all rows when every point is done, or the largest representable number where they are more.
  /// Axes and texts add little.
  [[nodiscard]] std::uint64_t byte_count() const;
  /// Bytes of one point's row in all datasets, and in one of them.
  [[nodiscard]] std::uint64_t bytes_per_point() const;
  [[nodiscard]] std::uint64_t bytes_per_point(const RowDataset& rows) const;
};

Schema schema_of(const settings::Scene& scene);

}  // namespace rubatlas::atlas
