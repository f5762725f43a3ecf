/// Effect `stick`: tips that the ring's friction holds where slip comes to rest.
///
/// Coulomb's law at zero slip is an inclusion, c ∈ [−μs, μs]. MODEL 4.4 reverses the friction whenever the
/// slip velocity passes through zero, even where the reversed friction then acts along the slip. Under this
/// effect the tip rests on the ring as long as the friction coefficient that rest needs is within [−μs, μs]
/// (Filippov's sliding mode; Leine and Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems,
/// Springer 2004). The tip of a rigid blade rests under the c with which v' vanishes. The tip of an elastic
/// blade stands where the load bends the blade to, so that it rests under the c with which v itself vanishes.
#pragma once

#include <tuple>

#include "settings/effects/description.hpp"

namespace rubatlas::effects {

struct Stick {
  bool holds = true;
  double static_ratio = 1.0;  ///< μs/μ [-]

  static constexpr Description kDescription{
      .section = "/stick",
      .meaning = "tips that friction holds at rest on the ring",
      .equation = "v = 0 under the c that this takes while |c| <= μs, in place of c = s μ there",
      .source = "Filippov 1988; Leine & Nijmeijer 2004",
      .flight = "closed form: nothing acts on the shaft in flight",
      .breaks = "phase volume: a tip that sticks takes a dimension away",
  };
  static constexpr auto quantities() {
    return std::tuple{Field<&Stick::holds>{.pointer = "/stick/holds",
                                           .symbol = "",
                                           .unit = "",
                                           .meaning = "tips stick where friction can hold them",
                                           .source = "true: the section asks for it"},
                      Field<&Stick::static_ratio>{.pointer = "/stick/static_ratio",
                                                  .symbol = "μs/μ",
                                                  .unit = "1",
                                                  .meaning = "static against kinetic friction coefficient",
                                                  .source = "1: Coulomb's law",
                                                  .range = settings::between(1.0, 100.0)}};
  }
  [[nodiscard]] bool acts() const { return holds; }
};

}  // namespace rubatlas::effects
