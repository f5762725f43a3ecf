/// The problem that every peer integrates: the paper's default rotor (MODEL 6.1) from rest, at one speed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/elastica_contact.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "rotor/constants.hpp"
#include "settings/scene.hpp"

namespace rubatlas::bench {

/// The default rotor at a tolerance; its protocol splits `revolutions` as the paper's does, two thirds of
/// them transient, and runs them all.
settings::Scene default_scene(int revolutions, double tolerance);

/// Parameters of the scene at one speed ratio.
plan::PointParameters line_of(const settings::Scene& scene, double speed_ratio);

/// The same rotor as the equations of motion see it.
rotor::RotorConstants rotor_of(const settings::Scene& scene, double speed_ratio);
contact::ElasticaContact contact_of(const settings::Scene& scene,
                                    const std::shared_ptr<const blade::ElasticaCurve>& curve);

/// Rows of the observable `poincare` as sections.
std::vector<motion::SectionState> sections_of(const std::vector<double>& row);

}  // namespace rubatlas::bench
