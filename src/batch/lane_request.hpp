/// One attempt of a contact step that a line asks for, and what comes of it.
#pragma once

#include <complex>

#include "contact/elastica_contact.hpp"
#include "effects/harmonic.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/runge_kutta.hpp"
#include "solve/blade_set.hpp"
#include "solve/contact_system.hpp"

namespace rubatlas::batch {

using LaneStep = integrate::RungeKutta<integrate::DormandPrince853, 6>;

/// An attempt evaluates that many right-hand sides.
constexpr int kEvaluationsOfAttempt = integrate::DormandPrince853::kStages;

/// Right-hand sides that lanes know: one carried contact, without forcing or with an unbalance.
template <class System>
inline constexpr bool kFitsLanes = false;
template <>
inline constexpr bool kFitsLanes<solve::CarriedContact<contact::ElasticaContact, effects::NoForcing>> = true;
template <>
inline constexpr bool
    kFitsLanes<solve::CarriedContact<contact::ElasticaContact, effects::RotatingUnbalance>> = true;

struct LaneRequest {
  /// Of a system that is open and anchored at the start of a step that has begun.
  template <class System>
  LaneRequest(const System& system, LaneStep& step_of_line, double size_of_step) requires kFitsLanes<System>
      : step(&step_of_line), size(size_of_step) {
    const auto parameters = system.parameters();
    rotor = parameters.rotor;
    blades = parameters.blades;
    law = parameters.law;
    unbalance = unbalance_of(*parameters.forcing);
    slip = parameters.slip;
    scale = parameters.scale;
    anchor = parameters.anchor;
  }

  LaneStep* step;
  double size;
  const solve::RotorConstants* rotor;
  const solve::BladeSet* blades;
  const contact::ElasticaContact* law;
  const effects::RotatingUnbalance* unbalance;  ///< none: no forcing
  double slip;
  double scale;
  solve::BladeSet::Anchor anchor;

  // What the attempt gave, besides the stages and the end of the step.
  bool finite = false;  ///< what the step's own attempt would have returned
  contact::ElasticaContact::Constraint last{};
  std::complex<double> acceleration;

 private:
  static const effects::RotatingUnbalance* unbalance_of(const effects::NoForcing& /*none*/) {
    return nullptr;
  }
  static const effects::RotatingUnbalance* unbalance_of(const effects::RotatingUnbalance& forcing) {
    return &forcing;
  }
};

}  // namespace rubatlas::batch
