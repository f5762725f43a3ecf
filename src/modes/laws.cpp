// The laws of contact: their arcs, and the resets of one contact.

#include "modes/laws.hpp"

#include <cmath>
#include <memory>
#include <optional>

#include "collocation/axial_law.hpp"
#include "collocation/damped_law.hpp"
#include "collocation/inclined_law.hpp"
#include "collocation/rigid_law.hpp"
#include "modes/rest_of_elastic_blades.hpp"
#include "modes/rest_of_rigid_blades.hpp"

namespace rubatlas::modes {

using collocation::ArcLaw;

namespace {

/// A blade that slips is bent by u alone: κ and φ of its tip at rest are past.
bool takes(const std::optional<double>& root, OpenContact& contact) {
  if (!root) return false;
  contact.bending = *root;
  contact.bend = {};
  return true;
}

}  // namespace

// Rigid blades.

std::unique_ptr<ArcLaw> LawOfRigidBlades::arcs(const rotor::Machine& machine,
                                               double /*max_shortening*/) const {
  return std::make_unique<collocation::RigidLaw>(blades(), machine);
}

std::unique_ptr<RestJudge> LawOfRigidBlades::rest_judge(const ContactSetup& setup) const {
  return sticks() ? std::make_unique<RestOfRigidBlades>(setup) : nullptr;
}

// Elastic blades on a ring with dampers.

std::unique_ptr<ArcLaw> LawOfDampedRing::arcs(const rotor::Machine& machine, double max_shortening) const {
  return std::make_unique<collocation::DampedLaw>(blades(), machine.blades.count(), max_shortening);
}

bool LawOfDampedRing::open(const TipPlace& at, OpenContact& contact) const {
  const auto& blade = of(contact.blade);
  const double load = blade.straight().force(at.pose, contact.slip, at.speed).normal;
  contact.straight = load < blade.bending_load(at.pose, contact.slip, at.speed);
  return true;
}

bool LawOfDampedRing::straightens(const TipPlace& at, OpenContact& contact) const {
  const contact::TipForce force = of(contact.blade).straight().force(at.pose, contact.slip, at.speed);
  if (contact.straight || !(force.normal > 0.0)) return false;
  contact.straight = true;
  contact.bending = 0.0;
  return true;
}

// Elastic blades under an inclined load.

std::unique_ptr<ArcLaw> LawOfInclinedLoads::arcs(const rotor::Machine& machine, double max_shortening) const {
  return std::make_unique<collocation::InclinedLaw>(blades(), machine.blades.count(), max_shortening,
                                                    rests_at_once_);
}

std::unique_ptr<RestJudge> LawOfInclinedLoads::rest_judge(const ContactSetup& setup) const {
  return sticks() ? std::make_unique<RestOfElasticBlades>(setup) : nullptr;
}

/// None where friction depends on the slip velocity, or tips stick anyway.
std::optional<contact::DirectedElastica> LawOfInclinedLoads::law_of_rest(int blade) const {
  const contact::Friction& friction = of(blade).friction();
  if (!friction.has_slip_state() || friction.sticks) return std::nullopt;
  return of(blade).with_friction(contact::Friction::sticking(friction.friction, friction.friction));
}

Standing LawOfInclinedLoads::snap(const TipPlace& at, OpenContact& contact) const {
  constexpr double kSame = 1e-3;  // of κ: a root so close to the fold is the one that ends there
  const auto& blade = of(contact.blade);
  const double modulus = contact.bend.modulus;
  const double side = std::copysign(1.0, modulus);
  auto root = blade.solve(at.pose, contact.slip, at.speed, side);
  if (root && std::abs(root->modulus - modulus) < kSame * std::abs(modulus)) root = std::nullopt;
  if (!root) root = blade.solve(at.pose, contact.slip, at.speed, -side);
  if (!root) return Standing::lost;
  contact.bend = *root;
  return Standing::stands;
}

// Elastic blades under an axial load.

std::unique_ptr<ArcLaw> LawOfAxialLoads::arcs(const rotor::Machine& machine, double max_shortening) const {
  collocation::AxialLaw::Blades arcs_of;
  for (int k = 0; k < machine.blades.count(); ++k) {
    arcs_of.push_back(&of(k));
  }
  return std::make_unique<collocation::AxialLaw>(std::move(arcs_of), max_shortening);
}

/// None for small slopes, and where axial compliance or a ring that yields gives way besides: there the place
/// of the tip is not a function of κ and φ. Nor for blades that are released at the fold.
std::optional<contact::DirectedElastica> LawOfAxialLoads::law_of_rest(int blade) const {
  const contact::ElasticaContact& law = of(blade);
  if (law.curve().theory() != blade::Theory::elastica || law.has_branches() || law.releases_at_fold())
    return std::nullopt;
  const double friction = law.curve().friction();
  return contact::DirectedElastica(contact::LoadDirection::axial, law.geometry(), law.blade(),
                                   contact::Friction::sticking(friction, friction));
}

bool LawOfAxialLoads::open(const TipPlace& at, OpenContact& contact) const {
  const auto& blade = of(contact.blade);
  if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
      blade.starts_unloaded(at.pose, contact.slip))
    return true;
  return takes(blade.solve(at.pose, contact.slip), contact);
}

Standing LawOfAxialLoads::keep(const TipPlace& at, OpenContact& contact) const {
  const auto& blade = of(contact.blade);
  const bool outside = at.pose.gap <= 0.0;
  if (at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose) &&
      blade.ends_unloaded(at.pose, contact.slip, contact.bending)) {
    contact.bending = 0.0;
    contact.bend = {};
    return outside ? Standing::free : Standing::stands;
  }
  if (outside && !blade.releases_at_fold()) return Standing::free;
  if (!(contact.bending > 0.0)) {
    if (takes(blade.solve(at.pose, contact.slip), contact)) return Standing::stands;
  } else {
    // On its branch, or on the next one where the change has taken it past the end.
    auto root = blade.solve_near(at.pose, contact.slip, contact.bending);
    if (!root && blade.has_branches()) root = blade.snap(at.pose, contact.slip, contact.bending, at.speed);
    if (takes(root, contact)) return Standing::stands;
  }
  return outside ? Standing::free : Standing::lost;
}

Standing LawOfAxialLoads::snap(const TipPlace& at, OpenContact& contact) const {
  const auto& blade = of(contact.blade);
  contact.straight = false;
  if (takes(blade.snap(at.pose, contact.slip, contact.bending, at.speed), contact)) return Standing::stands;
  const bool free = at.pose.gap <= 0.0 && !blade.closes_in(at.pose, contact.slip, contact.bending, at.speed);
  return free ? Standing::free : Standing::lost;
}

bool LawOfAxialLoads::bend_anew(const TipPlace& at, OpenContact& contact) const {
  contact.bending = 0.0;
  contact.bend = {};
  return open(at, contact);
}

bool LawOfAxialLoads::straightens(const TipPlace& at, OpenContact& contact) const {
  const auto& blade = of(contact.blade);
  if (!blade.may_stand_straight() || at.pose.gap <= contact::gap_rounding(blade.geometry(), at.pose))
    return false;
  contact.bending = 0.0;
  contact.straight = true;
  return true;
}

}  // namespace rubatlas::modes
