/// The lines of an atlas that belong to one rotor at one setting of its open axes.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/paper/reference_rotor.hpp"
#include "analysis/rules/line.hpp"
#include "analysis/rules/line_summary.hpp"
#include "analysis/rules/parameter.hpp"
#include "settings/scene.hpp"

namespace rubatlas::analysis {

/// One value for each open axis (reference_rotor.hpp) that an atlas has.
struct Setting {
  std::vector<std::pair<std::string, double>> values;  ///< name of the axis, value in the file's unit
  std::string text;  ///< "kr = 1000 N/m, direction = up"; empty without such axes
};

/// Every combination of the values of the open axes except those in `without`. One empty setting where the
/// atlas has no open axis, or is of another rotor.
std::vector<Setting> settings(const ReferenceRotor& rotor, const settings::Scene& scene,
                              std::span<const Parameter> parameters, std::string_view without = {});

class Evidence {
 public:
  /// The spans must outlive the evidence.
  Evidence(const settings::Scene& scene, std::span<const Parameter> parameters,
           std::span<const LineSummary> lines, bool per_passing, ReferenceRotor rotor, Setting setting);

  [[nodiscard]] const ReferenceRotor& rotor() const { return rotor_; }
  [[nodiscard]] const settings::Scene& scene() const { return scene_; }
  /// The reason why the atlas does not cover the rotor; empty when it does.
  [[nodiscard]] const std::string& other_rotor() const { return other_rotor_; }
  /// The lines whose parameters, except the named ones, are those of the rotor and of the setting. They
  /// ascend in the named parameters, of which the first is the slowest. Where the atlas has both directions
  /// and the setting names none, they are the lines of the upward sweep.
  [[nodiscard]] std::vector<const LineSummary*> lines_over(
      std::initializer_list<std::string_view> names) const;
  [[nodiscard]] std::vector<const LineSummary*> lines_along(std::string_view name) const {
    return lines_over({name});
  }
  /// The line with the rotor's own parameters; null where the grid has none.
  [[nodiscard]] const LineSummary* own_line() const;
  /// The line's value on an axis, or, where the atlas has no such axis, the rotor's.
  [[nodiscard]] double value(const LineSummary& line, std::string_view name) const;
  /// "ζ = 0.1".
  [[nodiscard]] std::string value_text(const LineSummary& line, std::string_view name) const;
  /// μ of the setting where friction is open, else μ of the rotor [-].
  [[nodiscard]] double friction() const;
  [[nodiscard]] SpeedScale scale() const { return scale_; }
  /// True when the doublings were found on the map over a blade passing.
  [[nodiscard]] bool per_passing() const { return per_passing_; }

 private:
  [[nodiscard]] std::size_t position(std::string_view name) const;
  [[nodiscard]] bool fits(const Parameter& parameter, double value) const;

  const settings::Scene& scene_;
  std::span<const Parameter> parameters_;
  std::span<const LineSummary> lines_;
  SpeedScale scale_;
  bool per_passing_;
  ReferenceRotor rotor_;
  Setting setting_;
  std::string other_rotor_;
};

}  // namespace rubatlas::analysis
