#include "assembly/make_line_solver.hpp"

#include <stdexcept>

#include "assembly/blade_tables.hpp"
#include "assembly/effect_families.hpp"
#include "assembly/methods.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::assembly {

namespace {

/// The one family that is compiled for every method. By collocation it is one of those with effects.
std::unique_ptr<point::LineSolver> make_by_method(const FamilyRequest& request) {
  switch (request.line.accuracy.method) {
    case settings::Method::hybrid:
      return make_hybrid(request);
    case settings::Method::collocation:
      return request.line.contact.law == settings::ContactLaw::elastic_ring ? make_rigid_blades(request)
                                                                            : make_elastic_blades(request);
    case settings::Method::hybrid_54:
      return make_hybrid_54(request);
    case settings::Method::hybrid_32:
      return make_hybrid_32(request);
    case settings::Method::paper:
      return make_paper(request);
    case settings::Method::located:
      return make_located(request);
    case settings::Method::fixed:
      return make_fixed(request);
  }
  throw std::logic_error("a method of integration that is none");
}

std::unique_ptr<point::LineSolver> make(const FamilyRequest& request) {
  using enum settings::MotionFamily;
  switch (request.combination.family->kind) {
    case paper_s_rotor:
      return make_by_method(request);
    case rigid_blades:
      return make_rigid_blades(request);
    case sticking_rigid_blades:
      return make_sticking_rigid_blades(request);
    case elastic_blades:
      return make_elastic_blades(request);
    case directed_elastic_blades:
      return make_directed_elastic_blades(request);
    case sticking_elastic_blades:
      return make_sticking_elastic_blades(request);
    case blades_on_damped_ring:
      return make_blades_on_damped_ring(request);
    case blades_in_ring_body:
      return make_blades_in_ring_body(request);
    case blades_in_ring_without_mass:
      return make_blades_in_ring_without_mass(request);
  }
  throw std::logic_error("a family of motions that is none");
}

}  // namespace

std::shared_ptr<BladeTables> make_blade_tables() {
  return std::make_shared<BladeTables>();
}

std::unique_ptr<point::LineSolver> make_line_solver(const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<BladeTables>& tables) {
  const settings::Scene own = plan::scene_of_line(scene, line);
  return make({{own, *tables}, settings::combination_of(own)});
}

}  // namespace rubatlas::assembly
