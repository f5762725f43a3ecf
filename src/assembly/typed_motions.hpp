/// From a scene's choices to types: the motions of one law on one machine by one method of integration.
///
/// Included by the files `method_<name>.cpp` and `effect_kernels_<family>.cpp` only, each of which compiles
/// its own motions.
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "assembly/blade_tables.hpp"
#include "assembly/machine.hpp"
#include "assembly/methods.hpp"
#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "motion/point_motion.hpp"
#include "point/solver_of_motions.hpp"
#include "rotor/constants.hpp"
#include "variation/blades_of_scene.hpp"

namespace rubatlas::assembly {

/// The line solver of one law on one machine by one method, which makes its motions:
/// `Method::make<kMayChange>(rotor, blades, law, forcing, line)`.
template <class Method, class Law, class Machine>
std::unique_ptr<point::LineSolver> make_point_solver(const settings::Scene& line, Law law, Machine machine) {
  motion::MakeMotion make = [line, law = std::move(law), machine = std::move(machine)](
                                double speed_ratio, [[maybe_unused]] std::span<const double> lost) {
    const auto with = [&](const Law& blades) {
      return Method::template make<Machine::kMayChange>(point::constants_of(line, speed_ratio),
                                                        machine.blades(speed_ratio), blades,
                                                        machine.forcing(speed_ratio), line);
    };
    if constexpr (Machine::kMayChange) {
      if (!lost.empty()) return with(law.shortened(lost));
    }
    return with(law);
  };
  return point::solver_of_motions(line, std::move(make));
}

using variation::blade_of;
using variation::elastic_ring_law;
using variation::geometry_of;

/// The curve of a blade: elastica or beam-column, and its axial compliance.
inline std::shared_ptr<const blade::ElasticaCurve> curve_of(const LineRequest& request,
                                                            const settings::Blades& blade) {
  const settings::Scene& line = request.line;
  const auto theory = line.contact.law == settings::ContactLaw::beam_column ? blade::Theory::beam_column
                                                                            : blade::Theory::elastica;
  double compliance = 0.0;
  if (effects::acts<&effects::Effects::axial_compliance>(line)) {
    const double slenderness = blade.thickness / blade.length;
    compliance = line.axial_compliance->share * slenderness * slenderness / 12.0;
  }
  return request.tables.curve(line.contact.friction, theory, compliance);
}

/// On the paper's machine, with an unbalance or without.
template <class Method, class Law>
std::unique_ptr<point::LineSolver> on_paper_s_machine(const settings::Scene& line, Law law) {
  // Absent means absent: a rotor without unbalance has no forcing in its equations.
  if (!effects::acts<&effects::Effects::unbalance>(line)) {
    return make_point_solver<Method>(line, std::move(law), PlainMachine{line.blades.count});
  }
  const UnbalancedMachine machine{line.blades.count, line.unbalance->moment / line.rotor.mass,
                                  line.unbalance->phase, line.rotor.damping_ratio};
  return make_point_solver<Method>(line, std::move(law), machine);
}

/// Calls `use` with the law of the paper's rotor that a line has.
template <class Use>
std::unique_ptr<point::LineSolver> with_paper_s_law(const LineRequest& request, Use use) {
  const settings::Scene& line = request.line;
  if (line.contact.law == settings::ContactLaw::elastic_ring)
    return use(elastic_ring_law(line.ring, line.blades, line.contact.friction));
  return use(contact::ElasticaContact(geometry_of(line.ring, line.blades), blade_of(line.blades),
                                      curve_of(request, line.blades)));
}

/// The line solver of a method for the paper's rotor, by the scene's law.
template <class Method>
std::unique_ptr<point::LineSolver> make_paper_s_rotor(const LineRequest& request) {
  return with_paper_s_law(request,
                          [&](auto law) { return on_paper_s_machine<Method>(request.line, std::move(law)); });
}

}  // namespace rubatlas::assembly
