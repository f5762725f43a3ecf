/// Borders of a line: neighbouring speeds with different motions; and edges, which are borders that new
/// points have narrowed down.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "analysis/rules/edge_search.hpp"
#include "analysis/rules/line.hpp"
#include "analysis/rules/regions.hpp"

namespace rubatlas::analysis {

namespace motion_class {
/// Beside the classes of a motion: it left the model's validity.
constexpr std::uint8_t kLeftValidity = 253;
}  // namespace motion_class

/// What changes at a border as the speed grows. The numbers are those of the flags in EDGES.h5.
enum class BorderKind : std::uint8_t {
  period = 1,    ///< one period becomes another
  onset = 2,     ///< periodic motion becomes aperiodic
  end = 3,       ///< aperiodic motion becomes periodic
  validity = 4,  ///< the motion leaves the model's validity, or stays within it again
};

/// Two points of a line with different motions; those between them are unresolved, and evidence for neither.
struct Border {
  std::size_t below = 0;
  std::size_t above = 0;
  std::uint8_t region_ends = 0;    ///< number of the region that ends here, 0 for none
  std::uint8_t region_begins = 0;  ///< number of the region that begins here, 0 for none
};

/// Classes as borders are found from them: with a class of its own for points that left the model's validity.
/// `status` as in the atlas, one per class.
[[nodiscard]] std::vector<std::uint8_t> border_motions(std::vector<std::uint8_t> classes,
                                                       std::span<const std::uint8_t> status);

/// All borders of a line, ascending in Ω. `motion`: one class per point, `kLeftValidity` where the motion
/// left the model's validity; a point whose class is `kNone` is not known, and no border goes across it.
[[nodiscard]] std::vector<Border> find_borders(std::span<const std::uint8_t> motion);

[[nodiscard]] BorderKind kind_of_border(std::uint8_t below, std::uint8_t above);

/// An edge of a line.
struct Edge {
  std::size_t line = 0;    ///< of the atlas
  std::size_t border = 0;  ///< number of the border where it was found, which may have several edges
  BorderKind kind = BorderKind::period;
  std::uint8_t motion_below = 0;   ///< class up to `lower`
  std::uint8_t motion_above = 0;   ///< class from `upper` on
  std::uint8_t region_ends = 0;    ///< number of the region that ends here, 0 for none
  std::uint8_t region_begins = 0;  ///< number of the region that begins here, 0 for none
  double lower = kNotANumber;      ///< Ω [-]
  double upper = kNotANumber;      ///< Ω [-]
  EdgeOutcome outcome = EdgeOutcome::sharp;
  std::size_t points = 0;  ///< that were computed for the border
};

/// The edges of an atlas.
struct EdgeTable {
  double resolution = 0.0;    ///< longest interval [-] of a sharp edge
  bool only_regions = false;  ///< borders within regions were left out
  std::vector<Edge> edges{};  ///< ascending in line and Ω
};

/// Notes which regions end and begin at a border. Region 1 ends at a trigger, which is no change of motion,
/// and a region that is open at a gap has no end there.
void note_regions(Border& border, const Line& line, const std::array<Region, 4>& regions);

/// The edges of a border as a search has found them, ascending in Ω. Of several, a region that ends there
/// ends at the first, where its motion ends, and one that begins there begins at the last.
[[nodiscard]] std::vector<Edge> edges_of(std::size_t line, std::size_t number, const Border& border,
                                         const EdgeSearch& search);

/// Writes an edge of a line into the regions that end or begin at it (`Region::from_between`, `to_between`).
void narrow_ends(std::array<Region, 4>& regions, const Edge& edge);

/// "period 1", "aperiodic motion", "motion outside the model".
[[nodiscard]] std::string motion_text(std::uint8_t motion);

}  // namespace rubatlas::analysis
