#include "atlas/row_batch.hpp"

#include <algorithm>
#include <variant>

namespace rubatlas::atlas {

RowBatch::RowBatch(const Schema& schema) : schema_(schema), offsets_{0} {
  for (const auto* rows : schema.row_datasets()) {
    offsets_.push_back(offsets_.back() + schema.bytes_per_point(*rows));
  }
}

void RowBatch::add(std::size_t point, const Origin& origin, const point::PointOutcome& outcome) {
  entries_.push_back({point, entries_.size()});
  const std::size_t begin = rows_.size();
  const auto append = [this](std::span<const std::byte> bytes) {
    rows_.insert(rows_.end(), bytes.begin(), bytes.end());
  };
  rows_.reserve(begin + offsets_.back());
  const Row row(schema_, origin, outcome);
  for (const auto& part : row.parts()) append(bytes_of(part));
  const std::uint32_t sum = RowChecksum().add(std::span(rows_).subspan(begin)).value();
  append(std::as_bytes(std::span(&sum, 1)));
}

void RowBatch::clear() {
  entries_.clear();
  rows_.clear();
}

std::vector<Stretch> RowBatch::stretches() {
  std::ranges::sort(entries_, {}, &Entry::point);
  return stretches_of(entries_);
}

const std::byte* RowBatch::row(std::size_t place) const {
  return rows_.data() + entries_[place].row * offsets_.back();
}

std::span<const std::byte> RowBatch::column(std::size_t dataset, std::size_t place, std::size_t count) {
  const std::size_t size = offsets_[dataset + 1] - offsets_[dataset];
  // A single row may be large: it is written from where it is.
  if (count == 1) return {row(place) + offsets_[dataset], size};
  column_.resize(count * size);
  for (std::size_t i = 0; i < count; ++i) {
    std::copy_n(row(place + i) + offsets_[dataset], size, column_.data() + i * size);
  }
  return column_;
}

}  // namespace rubatlas::atlas
