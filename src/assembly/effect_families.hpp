/// The families of motions besides the paper's rotor (`settings::families()`): one function each, by the
/// method `hybrid`. `effect_kernels_<family>.cpp` compiles the motions of a family, and nothing else does.
#pragma once

#include <memory>

#include "assembly/methods.hpp"
#include "settings/combinations.hpp"

namespace rubatlas::assembly {

/// What a line solver is made of where effects besides the unbalance act.
struct FamilyRequest : LineRequest {
  settings::Combination combination;  ///< how the line is computed
};

std::unique_ptr<point::LineSolver> make_rigid_blades(const FamilyRequest& request);
std::unique_ptr<point::LineSolver> make_sticking_rigid_blades(const FamilyRequest& request);
std::unique_ptr<point::LineSolver> make_elastic_blades(const FamilyRequest& request);
std::unique_ptr<point::LineSolver> make_directed_elastic_blades(const FamilyRequest& request);
std::unique_ptr<point::LineSolver> make_sticking_elastic_blades(const FamilyRequest& request);
std::unique_ptr<point::LineSolver> make_blades_on_damped_ring(const FamilyRequest& request);
std::unique_ptr<point::LineSolver> make_blades_in_ring_body(const FamilyRequest& request);
std::unique_ptr<point::LineSolver> make_blades_in_ring_without_mass(const FamilyRequest& request);

}  // namespace rubatlas::assembly
