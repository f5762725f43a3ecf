/// The checksum of a row: CRC-32 (as of zlib, gzip, Python's `zlib.crc32`) over all that the row stores,
/// bytes as in the file, dataset by dataset in the order of `Schema::summed_datasets`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "atlas/schema.hpp"
#include "plan/pieces.hpp"
#include "point/line_solver.hpp"

namespace rubatlas::atlas {

/// The values of a point in one dataset.
using RowPart = std::variant<std::span<const double>, std::uint8_t, std::uint16_t, std::int32_t>;

/// The bytes of a part as the file stores them.
std::span<const std::byte> bytes_of(const RowPart& part);

/// How a point came about, beside its outcome.
struct Origin {
  bool restarted = false;              ///< it started from the scene's `initial`
  plan::Seam seam = plan::Seam::none;  ///< kept where the scene has `pieces`
};

/// A point's row, one part per dataset of `Schema::summed_datasets`, in their order: the status first.
class Row {
 public:
  /// `outcome` has to outlive the row. A point that did not end as done has NaN throughout.
  Row(const Schema& schema, const Origin& origin, const point::PointOutcome& outcome);

  [[nodiscard]] const std::vector<RowPart>& parts() const { return parts_; }
  /// CRC-32 of one part alone.
  [[nodiscard]] std::uint32_t checksum(std::size_t part) const;

 private:
  std::vector<double> absent_;  ///< NaN, as long as the longest part
  std::vector<RowPart> parts_;
};

/// Accumulates the CRC-32 over the parts of one row.
class RowChecksum {
 public:
  template <typename T>
  RowChecksum& add(std::span<const T> values) {
    return add(std::as_bytes(values));
  }
  RowChecksum& add(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint32_t value() const { return sum_; }

 private:
  std::uint32_t sum_ = 0;
};

}  // namespace rubatlas::atlas
