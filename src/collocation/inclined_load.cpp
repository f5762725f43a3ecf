#include "collocation/inclined_load.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "blade/inclined_elastica.hpp"

namespace rubatlas::collocation {

const InclinedLoad::ChartEnd InclinedLoad::kChartEnd{std::cos(std::numbers::pi - blade::kLargestAmplitude),
                                                     std::sin(std::numbers::pi - blade::kLargestAmplitude)};

double InclinedLoad::argument(double u) const {
  constexpr int kMost = 20;
  constexpr double kLastStep = 1e-15;
  double p = std::asinh(u / scale);
  for (int i = 0; i < kMost; ++i) {
    const double step = (u - bending(p)) / bending_slope(p);
    p += step;
    if (std::abs(step) <= kLastStep * std::abs(p)) break;
  }
  return p;
}

InclinedLoad numbers_of(contact::LoadDirection direction, const contact::CoulombFriction& friction) {
  InclinedLoad load{};
  load.along_normal = direction == contact::LoadDirection::normal;
  load.law = InclinedLoad::Friction::coulomb;
  load.friction = friction.friction;
  return load;
}

InclinedLoad numbers_of(contact::LoadDirection direction, const contact::VelocityFriction& friction) {
  InclinedLoad load{};
  load.along_normal = direction == contact::LoadDirection::normal;
  if (const auto* regularised = std::get_if<contact::RegularisedFriction>(&friction.law())) {
    load.law = InclinedLoad::Friction::regularised;
    load.friction = regularised->friction;
    load.regularising_velocity = regularised->regularising_velocity;
  } else {
    const auto& stribeck = std::get<contact::StribeckFriction>(friction.law());
    load.law = InclinedLoad::Friction::stribeck;
    load.friction = stribeck.kinetic_friction;
    load.static_friction = stribeck.static_friction;
    load.stribeck_velocity = stribeck.stribeck_velocity;
    load.regularising_velocity = stribeck.regularising_velocity;
  }
  return load;
}

}  // namespace rubatlas::collocation
