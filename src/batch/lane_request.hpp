/// One attempt of a contact step that a line asks for, and what comes of it.
#pragma once

#include <complex>

#include "effects/unbalance.hpp"
#include "integrate/dormand_prince_853.hpp"
#include "integrate/runge_kutta.hpp"
#include "solve/contact_system.hpp"

namespace rubatlas::batch {

using LaneStep = integrate::RungeKutta<integrate::DormandPrince853, 6>;

/// An attempt evaluates that many right-hand sides.
constexpr int kEvaluationsOfAttempt = integrate::DormandPrince853::kStages;

/// Right-hand sides that lanes know: one carried contact, without forcing or with an unbalance.
template <class System>
inline constexpr bool kFitsLanes = false;
template <>
inline constexpr bool kFitsLanes<solve::CarriedContact<effects::NoForcing>> = true;
template <>
inline constexpr bool kFitsLanes<solve::CarriedContact<effects::Unbalance>> = true;

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
    contact = parameters.contact;
    scale = parameters.scale;
    anchor_time = parameters.anchor_time;
    anchor = parameters.anchor;
  }

  LaneStep* step;
  double size;
  const solve::RotorConstants* rotor;
  const solve::BladeSet* blades;
  const contact::ElasticaContact* law;
  const effects::Unbalance* unbalance;  ///< none: no forcing
  solve::OpenContact contact;
  double scale;
  double anchor_time;
  contact::BladeDirection anchor;

  // What the attempt gave, besides the stages and the end of the step.
  bool finite = false;  ///< what the step's own attempt would have returned
  contact::ElasticaContact::Constraint last{};
  std::complex<double> acceleration;

 private:
  static const effects::Unbalance* unbalance_of(const effects::NoForcing& /*none*/) { return nullptr; }
  static const effects::Unbalance* unbalance_of(const effects::Unbalance& forcing) { return &forcing; }
};

}  // namespace rubatlas::batch
