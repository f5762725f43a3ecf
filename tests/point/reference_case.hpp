/// The cases of tests/reference/orbits.json as scenes and numbers.
#pragma once

#include <array>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "contact/elastica_contact.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "rotor/constants.hpp"
#include "settings/scene.hpp"

namespace rubatlas::test {

struct ReferenceEvent {
  std::string kind;  ///< touch, lift, slip
  int revolution;    ///< from 0
  int blade;         ///< from 1
  double time;       ///< τ of the revolution
  double force;      ///< F just after a touch-down, just before a lift-off [N]; NaN for slip
};

struct ReferenceCase {
  std::string name;
  settings::Scene scene;  ///< grid of one point; observables: poincare, max_displacement
  double speed_ratio = 0.0;
  motion::SectionState start{};
  bool periodic = false;
  int touchdowns_in_ten = 0;
  double max_displacement = 0.0;  ///< over the last 100 revolutions
  int last_section = 0;
  std::vector<motion::SectionState> first_sections;  ///< 1 … 10
  std::vector<motion::SectionState> last_sections;   ///< last_section − 10 … last_section
  std::vector<double> section_uncertainty;  ///< of the first sections, from the data's own tolerances
  std::vector<ReferenceEvent> events;

  /// Largest component over all stored sections.
  [[nodiscard]] double amplitude() const;
  friend std::ostream& operator<<(std::ostream& stream, const ReferenceCase& c) { return stream << c.name; }
};

const std::vector<ReferenceCase>& reference_cases();
const ReferenceCase& reference_case(const std::string& name);

/// The first sections of a case at a tolerance, from its start on; the run must end as done.
std::vector<motion::SectionState> sections_of(const ReferenceCase& c, double tolerance, int revolutions);
/// All of them.
std::vector<motion::SectionState> sections_of(const ReferenceCase& c, double tolerance);

/// The last sections of a case at a tolerance. One case ends on an orbit of period 1 after a chaotic
/// transient: how long that lasts depends on the last digits, the orbit does not, and it is given three times
/// the time.
std::vector<motion::SectionState> settled_sections_of(const ReferenceCase& c, double tolerance);

/// The law of a case, for forces at events.
contact::ElasticaContact contact_of(const ReferenceCase& c);
rotor::RotorConstants constants_of(const ReferenceCase& c);

}  // namespace rubatlas::test
