/// Effects `axial_compliance`, `yielding_ring` and `release`: what the paper's law of contact leaves out of
/// blade and ring.
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

/// The blade shortens under its axial load, by F L/EA besides its bending. A head-on contact then starts with
/// the stiffness EA/L, and a column (μ = 0) reaches its Euler load along a stiff slope instead of a jump.
struct AxialCompliance {
  double share = 1.0;  ///< of the blade's own L/EA, A = b h [-]

  static constexpr Description kDescription{
      .section = "/axial_compliance",
      .meaning = "blades that shorten under their axial load",
      .equation = "δ/L + share · (h²/12L²) F L²/EI in place of δ/L, with h and L of each blade",
      .source = "Timoshenko & Gere, Theory of Elastic Stability",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "a state alone no longer says on which branch a blade stands, compressed or bent",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&AxialCompliance::share>{.pointer = "/axial_compliance/share",
                                                     .symbol = "",
                                                     .unit = "1",
                                                     .meaning = "axial compliance, share of the blade's own",
                                                     .source = "1: EA as the section has it",
                                                     .range = settings::between(0.0, 1e6)}};
  }
  [[nodiscard]] bool acts() const { return share != 0.0; }
};

/// A ring that yields under each tip, in series with elastic blades (MODEL 4.7 is the same ring with rigid
/// blades).
struct YieldingRing {
  double compliance = 1e-4;  ///< 1/kr [m/N]

  static constexpr Description kDescription{
      .section = "/yielding_ring",
      .meaning = "a massless ring that yields under each tip, in series with elastic blades",
      .equation = "the ring keeps a tip at R + F/kr from its centre, in place of R",
      .source = "the elastic blade and the elastic ring of the two contact laws, in series",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "a state alone no longer says on which branch a blade stands, compressed or bent",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&YieldingRing::compliance>{.pointer = "/yielding_ring/compliance",
                                                       .symbol = "1/kr",
                                                       .unit = "m/N",
                                                       .meaning = "yielding of the ring under a tip",
                                                       .source = "that of law elastic_ring's default",
                                                       .range = settings::between(0.0, 1e6)}};
  }
  [[nodiscard]] bool acts() const { return compliance != 0.0; }
};

/// A contact ends where its force ends, not where the undeformed tip leaves the ring: a bent blade that
/// recedes stays in contact beyond that place, up to the fold of the contact equation.
struct Release {
  bool at_fold = true;

  static constexpr Description kDescription{
      .section = "/release",
      .meaning = "contacts that last until the force ends, beyond where the undeformed tip leaves the ring",
      .equation =
          "a contact ends where F = 0 or where no balance of F is left (a fold), not where the undeformed "
          "tip leaves the ring",
      .source =
          "path-following: the force with which a contact goes on, not the first that a search from zero "
          "meets",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "a state alone no longer says whether a blade is in contact",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&Release::at_fold>{.pointer = "/release/at_fold",
                                               .symbol = "",
                                               .unit = "",
                                               .meaning = "release where the force ends",
                                               .source = "true: the section asks for it"}};
  }
  [[nodiscard]] bool acts() const { return at_fold; }
};

}  // namespace rubatlas::effects
