/// The force of a tip by the published scheme (MODEL 4.2): F ← F + dF from 0 until h changes its sign.
#pragma once

#include <cmath>

#include "contact/elastic_ring_contact.hpp"
#include "contact/elastica_contact.hpp"
#include "contact/tip.hpp"

namespace rubatlas::compared {

/// Of an elastic blade in a rigid ring. `increment`: dF [N]. Where g > 0; false where the table ends before.
/// The curve is followed in its own parameter, mostly one evaluation an increment.
inline bool raise_force(const contact::ElasticaContact& law, const contact::Pose& at, double slip,
                        double angular_speed, double increment, contact::TipForce& force) {
  constexpr double kShareOfIncrement = 0.05;  // how closely the curve's point stands for the load
  constexpr double kFirstBending = 1e-3;      // of β: there F ~ u² still
  // From the unloaded blade F grows like u²; at μ = 0 the column stays straight up to its Euler load.
  const blade::ElasticaCurve& curve = law.curve();
  const double first = kFirstBending * (curve.friction() > 0.0 ? curve.load_angle() : 1.0);
  const double buckling = law.curve_at(0.0).load;
  const double step = increment / law.load_unit();
  const double curvature = (law.curve_at(first).load - buckling) / (first * first);
  double bending = 0.0;
  blade::CurvePoint point{};
  for (double count = std::floor(buckling / step) + 1.0;; ++count) {
    const double load = count * step;
    if (curve.theory() == blade::Theory::beam_column && load >= blade::kEulerLoad) {
      // No increment beyond the Euler load has an equilibrium: h changes its sign before.
      const auto root = law.solve(at, slip);
      if (!root) return false;
      bending = *root;
      break;
    }
    if (bending == 0.0) {
      bending = std::sqrt((load - buckling) / curvature);
      point = law.curve_at(bending);
    }
    while (std::abs(load - point.load) > kShareOfIncrement * step) {
      bending += (load - point.load) / point.load_slope;
      if (!(bending < curve.end())) return false;
      point = law.curve_at(bending);
    }
    if (law.residual(at, slip, point) <= 0.0) break;
  }
  force = law.constraint(at, slip, bending, angular_speed).force;
  return true;
}

/// Of a rigid blade, whose force is known: the first increment that reaches it.
inline bool raise_force(const contact::ElasticRingContact& law, const contact::Pose& at, double slip,
                        double angular_speed, double increment, contact::TipForce& force) {
  force = law.force(at, slip, angular_speed);
  const double stepped = std::ceil(force.normal / increment) * increment;
  const double excess = force.normal > 0.0 ? stepped / force.normal : 1.0;
  force.radial *= excess;
  force.tangential *= excess;
  force.normal = stepped;
  return true;
}

}  // namespace rubatlas::compared
