#include "atlas/row_checksum.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace rubatlas::atlas {
namespace {

template <typename T>
std::span<const T> numbers(const T& value) {
  return {&value, 1};
}

std::span<const double> numbers(const std::span<const double>& values) {
  return values;
}

/// The memory of an effect on a line on which its strength is zero.
constexpr std::array<double, motion::Memory::kMost> kUnchanged{};

}  // namespace

std::span<const std::byte> bytes_of(const RowPart& part) {
  static_assert(std::endian::native == std::endian::little, "the file's bytes are the memory's");
  return std::visit([](const auto& values) { return std::as_bytes(numbers(values)); }, part);
}

Row::Row(const Schema& schema, const Origin& origin, const point::PointOutcome& outcome) {
  const bool done = outcome.status == ending::PointStatus::done;
  if (!done) {
    std::size_t longest = std::max(outcome.final_state.size(), motion::Memory::kMost);
    for (const auto& row : outcome.rows) longest = std::max(longest, row.size());
    absent_.assign(longest, std::numeric_limits<double>::quiet_NaN());
  }
  const auto add = [&](std::span<const double> values) {
    parts_.emplace_back(done ? values : std::span<const double>(absent_).first(values.size()));
  };
  parts_.emplace_back(static_cast<std::uint8_t>(outcome.status));
  parts_.emplace_back(static_cast<std::uint8_t>(outcome.detail));
  parts_.emplace_back(static_cast<std::uint8_t>(origin.restarted ? 1 : 0));
  if (schema.seam) parts_.emplace_back(static_cast<std::uint8_t>(origin.seam));
  if (schema.settled) {
    constexpr int kMost = std::numeric_limits<std::uint16_t>::max();
    parts_.emplace_back(static_cast<std::uint16_t>(std::min(outcome.settled, kMost)));
  }
  parts_.emplace_back(static_cast<std::int32_t>(done ? -1 : outcome.failed_revolution));
  add(outcome.final_state);
  std::span<const double> remembered = outcome.final_memory.view();
  for (const RowDataset& memory : schema.memories) {
    const std::size_t size = memory.shape.back();
    const bool there = remembered.size() >= size;
    add(there ? remembered.first(size) : std::span<const double>(kUnchanged).first(size));
    if (there) remembered = remembered.subspan(size);
  }
  for (std::size_t i = 0; i < outcome.rows.size(); ++i) {
    if (schema.observables[i].type == NumberType::uint8) {
      parts_.emplace_back(static_cast<std::uint8_t>(done ? outcome.rows[i].front() : 0.0));
    } else {
      add(outcome.rows[i]);
    }
  }
}

std::uint32_t Row::checksum(std::size_t part) const {
  return RowChecksum().add(bytes_of(parts_.at(part))).value();
}

RowChecksum& RowChecksum::add(std::span<const std::byte> bytes) {
  sum_ = static_cast<std::uint32_t>(
      ::crc32_z(sum_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  return *this;
}

}  // namespace rubatlas::atlas
