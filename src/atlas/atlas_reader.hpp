/// An atlas that is read: by the analysis, by `orbit --from`, and by a run that resumes.
///
/// Points are numbered in C order over the axes, as in `plan::Grid`; a row is what one dataset holds for one
/// point. An atlas may be read while it is written: read `status` first, and then only the rows of points
/// that are done.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "atlas/hdf5.hpp"
#include "atlas/structure.hpp"
#include "plan/grid.hpp"
#include "plan/part.hpp"

namespace rubatlas::atlas {

class AtlasReader {
 public:
  /// Throws EnvironmentError when the file cannot be opened or is not the atlas that its scene requires
  /// (`structure.hpp`).
  explicit AtlasReader(const std::filesystem::path& path);

  /// `[direction,] [axes swept by pointer,] thickness, unbalance, friction, damping_ratio, speed_ratio`, as
  /// the file has them.
  [[nodiscard]] const std::vector<plan::Axis>& axes() const { return axes_; }
  /// One extent per axis.
  [[nodiscard]] Shape shape() const;
  [[nodiscard]] std::size_t point_count() const;
  /// Points that differ in speed ratio only: the last extent.
  [[nodiscard]] std::size_t speed_count() const { return axes_.back().values.size(); }

  /// One of 0 pending, 1 done, 2 left the model's validity, 3 integrator failed, per point.
  [[nodiscard]] std::vector<std::uint8_t> status() const;
  /// What became of each point where two pieces of its line meet (`plan::Seam`); only where the scene has
  /// `pieces`.
  [[nodiscard]] std::vector<std::uint8_t> seam() const;
  /// True when the atlas keeps a dataset of that name.
  [[nodiscard]] bool has(const std::string& name) const { return file_.has(name); }
  /// A whole dataset, flat, in C order.
  [[nodiscard]] std::vector<double> rows(const std::string& name) const;
  /// The rows of points [line * speed_count, (line + 1) * speed_count), flat.
  [[nodiscard]] std::vector<double> line_rows(const std::string& name, std::size_t line) const;
  /// One point's row, flat.
  [[nodiscard]] std::vector<double> row(const std::string& name, std::size_t point) const;
  /// The values of an inner axis (`section`, `order`, `passing`).
  [[nodiscard]] std::vector<double> inner_axis(const std::string& name) const;

  /// State at the end of a point: x, y [m], dx/dτ, dy/dτ [m]; NaN where it did not end as done.
  [[nodiscard]] std::array<double, 4> final_state(std::size_t point) const;
  /// The point with these parameters, each within a relative 1e-9; in an atlas swept in both directions, on
  /// the line of that `direction`. Empty where the atlas has no such point.
  [[nodiscard]] std::optional<std::size_t> find(const plan::PointParameters& parameters,
                                                plan::Direction direction = plan::Direction::up) const;

  /// The scene file's own text.
  [[nodiscard]] std::string scene() const { return file_.read_text("/scene"); }
  /// The scene with every default written out; `settings::parse_scene` reads it.
  [[nodiscard]] std::string scene_resolved() const { return resolved_scene(file_); }

  /// The part of its scene's grid that this atlas is for; the points of other parts stay pending.
  [[nodiscard]] const plan::Part& part() const { return part_; }
  [[nodiscard]] plan::PointRange points_of_part() const {
    return plan::points_of(part_, point_count() / speed_count(), speed_count());
  }
  /// True for a packed copy, whose rows cannot be written any more.
  [[nodiscard]] bool is_packed() const { return !file_.dataset("/status").offset(); }
  /// False for atlases of schema version 1, which has no checksums.
  [[nodiscard]] bool has_checksums() const;
  /// A point in words: "speed_ratio=0.3, damping_ratio=0.1"; axes with one value are left out.
  [[nodiscard]] std::string place_of(std::size_t point) const;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The file itself, for attributes.
  [[nodiscard]] const File& file() const { return file_; }

 private:
  [[nodiscard]] std::vector<double> read_from(const std::string& name, Shape start,
                                              std::size_t axes_fixed) const;

  std::filesystem::path path_;
  File file_;
  std::vector<plan::Axis> axes_;
  plan::Part part_;
};

}  // namespace rubatlas::atlas
