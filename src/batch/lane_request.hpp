/// One attempt of a contact step that a line asks for, and what comes of it.
#pragma once

#include <complex>

#include "batch/lane_block.hpp"
#include "contact/elastica_contact.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/runge_kutta.hpp"
#include "modes/carried.hpp"
#include "rotor/blade_set.hpp"
#include "rotor/harmonic.hpp"

namespace rubatlas::batch {

using LaneStep = integrate::RungeKutta<integrate::DormandPrince853, 6>;

/// Right-hand sides that lanes know: one carried contact, without forcing or with an unbalance.
template <class System>
inline constexpr bool kFitsLanes = false;
template <>
inline constexpr bool kFitsLanes<modes::Carried<contact::ElasticaContact, rotor::NoForcing>> = true;
template <>
inline constexpr bool kFitsLanes<modes::Carried<contact::ElasticaContact, rotor::RotatingUnbalance>> = true;

struct LaneRequest {
  /// Of a system that is open and anchored at the start of a step that has begun.
  template <class System>
  LaneRequest(const System& system, LaneStep& step_of_line, double size_of_step) requires kFitsLanes<System>
      : step(&step_of_line), size(size_of_step) {
    const auto& equation = system.equation();
    rotor = equation.rotor;
    blades = equation.blades;
    law = equation.law;
    unbalance = unbalance_of(*equation.forcing);
    slip = equation.slip;
    scale = equation.scale;
    anchor = equation.anchor;
  }

  LaneStep* step;
  double size;
  const rotor::RotorConstants* rotor;
  const rotor::BladeSet* blades;
  const contact::ElasticaContact* law;
  const rotor::RotatingUnbalance* unbalance;  ///< none: no forcing
  double slip;
  double scale;
  rotor::BladeSet::Anchor anchor;

  // What the attempt gave, besides the stages and the end of the step.
  bool finite = false;  ///< what the step's own attempt would have returned
  contact::ElasticaContact::Constraint last{};
  std::complex<double> acceleration;

 private:
  static const rotor::RotatingUnbalance* unbalance_of(const rotor::NoForcing& /*none*/) { return nullptr; }
  static const rotor::RotatingUnbalance* unbalance_of(const rotor::RotatingUnbalance& forcing) {
    return &forcing;
  }
};

}  // namespace rubatlas::batch
