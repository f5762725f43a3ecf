/// The table of all quantities of a scene: pointer, symbol, unit, meaning, range and source of each.
///
/// The reader, its error texts, the canonical form, the grid's axes, `explain` and the documentation all come
/// from this table, so that a quantity is described once. A new quantity is a member of a struct in
/// `scene.hpp` and one entry in `quantity.cpp`. Defaults are not repeated here: they are the default values
/// of those structs.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "settings/range.hpp"
#include "settings/scene.hpp"

namespace rubatlas::settings {

enum class Kind : std::uint8_t { number, whole_number, flag, text, choice, numbers };

/// A value as the scene file has it; a choice is its word.
using Value = std::variant<double, int, bool, std::string, std::vector<double>>;

struct Quantity {
  std::string_view pointer{};  ///< JSON pointer of its place in the scene file
  std::string_view symbol{};   ///< as in MODEL, unique within a section; empty where it has none
  std::string_view unit{};     ///< "1" where dimensionless, empty for texts and choices
  std::string_view meaning{};  ///< one phrase, ASCII, used in error texts and as `long_name`
  std::string_view source{};   ///< source of range or default
  Kind kind = Kind::number;
  Range range{};
  std::span<const std::string_view> choices{};  ///< words of a choice, in the order of its enumeration
  std::string_view default_rule{};              ///< the default in words, where it is a rule or an absence
  std::string_view chooser{};  ///< pointer of the choice that decides whether anything reads the quantity
  std::span<const std::string_view> readers{};  ///< the words of that choice under which it is read

  /// Value in a scene, none where absent or not read. Null for a quantity that only the grid has.
  std::optional<Value> (*read)(const Scene&) = nullptr;
  /// Writes a checked value into a scene; makes its section present.
  void (*write)(Scene&, const Value&) = nullptr;

  /// Last part of the pointer.
  [[nodiscard]] std::string_view key() const { return pointer.substr(pointer.rfind('/') + 1); }
  /// All but the last part of the pointer, empty for a key of the scene's top level.
  [[nodiscard]] std::string_view section() const { return pointer.substr(0, pointer.rfind('/')); }
};

/// All quantities, section by section.
std::span<const Quantity> quantities();

/// The entry at a pointer; throws std::out_of_range for a pointer that is not in the table.
const Quantity& quantity(std::string_view pointer);

/// A section of the scene file: a JSON object of quantities.
struct Section {
  std::string_view pointer;
  std::string_view meaning;
  /// Makes the section present in a scene; null for sections that every scene has.
  void (*open)(Scene&) = nullptr;
  bool may_be_null = false;  ///< which says that it is absent where it would be there by default
};

std::span<const Section> sections();

/// An axis with a name of its own: part of every atlas, of extent 1 where the scene does not sweep it.
struct GridAxis {
  std::string_view name;      ///< key in `grid` and name of the atlas' dimension
  std::string_view quantity;  ///< pointer of the quantity that the axis sweeps
  std::vector<double> Grid::*values;
};

/// In the order of the atlas' axes, the slowest first.
std::span<const GridAxis> grid_axes();

/// Name of the dimension of a quantity that is swept by its pointer: "ring_stiffness" for "/ring/stiffness".
std::string axis_name(std::string_view pointer);

/// Every quantity that `grid` may name by its pointer: the numbers that describe the machine, the effects on
/// it and the initial state, without those whose axis has a name of its own. An axis of the initial state
/// needs the sweep `independent`.
std::vector<const Quantity*> sweepable_quantities();

/// An axis of one scene's atlas.
struct Axis {
  std::string name;                    ///< of the dimension
  const Quantity* quantity = nullptr;  ///< never null
  std::vector<double> values;          ///< ascending
};

/// All axes of a scene's atlas but `direction`, the slowest first: those swept by their pointer, sorted by
/// name, then `grid_axes()`.
std::vector<Axis> axes_of(const Scene& scene);

/// The quantity of an axis of that name, of any scene; null for a name that no scene's axis has.
const Quantity* quantity_of_axis(std::string_view name);

/// The values of a number in an atlas: those of its axis, else the one value of the scene; none where absent.
std::vector<double> values_in(const Scene& scene, std::string_view pointer);
/// Where a scene gives a number: its axis of the grid, else its own pointer.
std::string place_of(const Scene& scene, std::string_view pointer);

}  // namespace rubatlas::settings
