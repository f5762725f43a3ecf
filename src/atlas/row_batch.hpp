/// Rows of computed points, kept in memory until they are written. Rows of neighbouring points are then
/// written together, one block of each dataset, because a call of HDF5 costs as much as a short row.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atlas/row_checksum.hpp"
#include "atlas/schema.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::atlas {

/// Consecutive points of an ascending list.
struct Stretch {
  std::size_t first = 0;  ///< number of the first point
  std::size_t count = 0;
  std::size_t place = 0;  ///< of the first point in the list
};

/// Each item of the list has the number of its point as member `point`.
template <typename Item>
std::vector<Stretch> stretches_of(const std::vector<Item>& ascending) {
  std::vector<Stretch> stretches;
  for (std::size_t place = 0; place < ascending.size(); ++place) {
    const std::size_t point = ascending[place].point;
    if (stretches.empty() || point != stretches.back().first + stretches.back().count) {
      stretches.push_back({point, 0, place});
    }
    ++stretches.back().count;
  }
  return stretches;
}

class RowBatch {
 public:
  /// The schema has to outlive the batch.
  explicit RowBatch(const Schema& schema);

  void add(std::size_t point, const Origin& origin, const point::PointOutcome& outcome);

  [[nodiscard]] std::size_t bytes() const { return rows_.size(); }
  void clear();

  /// Consecutive points of the batch, all in ascending order. To be called before `column`, and again after
  /// `add`.
  [[nodiscard]] std::vector<Stretch> stretches();

  /// The rows of `count` points from `place` on in one dataset of `Schema::row_datasets`, as the file stores
  /// them. Valid until the next call.
  [[nodiscard]] std::span<const std::byte> column(std::size_t dataset, std::size_t place, std::size_t count);

 private:
  struct Entry {
    std::size_t point = 0;
    std::size_t row = 0;  ///< its number in `rows_`
  };
  [[nodiscard]] const std::byte* row(std::size_t place) const;

  const Schema& schema_;
  std::vector<std::size_t> offsets_;  ///< of each dataset within a row [bytes], and the size of a row
  std::vector<Entry> entries_;
  std::vector<std::byte> rows_;    ///< row after row, in the order in which they came
  std::vector<std::byte> column_;  ///< the result of `column`
};

}  // namespace rubatlas::atlas
