#include "settings/methods.hpp"

#include <algorithm>
#include <array>

namespace rubatlas::settings {

const MethodOfIntegration& method_of(const Scene& scene) {
  constexpr std::string_view kLocated =
      "located on dense output; a bound and a search in each step show that none is missed";
  constexpr std::string_view kOnArcs =
      "approached from below in flight, the end of an interval in contact; bounds show that none is missed";
  constexpr std::string_view kBetweenSteps =
      "not located: the sign of the gap in each stage; contacts open, close and reverse at ends of steps";
  constexpr std::string_view kSolved = "a root in each stage";
  static constexpr std::array kMethods{
      MethodOfIntegration{.method = Method::hybrid,
                          .takes_effects = true,
                          .flies_in_closed_form = true,
                          .keeps_tolerance = true,
                          .pair = "Dormand-Prince 8(5,3)",
                          .guards = kLocated,
                          .force = {}},
      MethodOfIntegration{.method = Method::collocation,
                          .takes_effects = true,
                          .flies_in_closed_form = true,
                          .keeps_tolerance = true,
                          .pair = "Radau IIA 15, along the arc of the contact",
                          .guards = kOnArcs,
                          .force = {}},
      MethodOfIntegration{.method = Method::hybrid_54,
                          .takes_effects = false,
                          .flies_in_closed_form = true,
                          .keeps_tolerance = true,
                          .pair = "Dormand-Prince 5(4)",
                          .guards = kLocated,
                          .force = {}},
      MethodOfIntegration{.method = Method::hybrid_32,
                          .takes_effects = false,
                          .flies_in_closed_form = true,
                          .keeps_tolerance = true,
                          .pair = "Bogacki-Shampine 3(2)",
                          .guards = kLocated,
                          .force = {}},
      MethodOfIntegration{.method = Method::paper,
                          .takes_effects = false,
                          .flies_in_closed_form = false,
                          .keeps_tolerance = true,
                          .pair = "Fehlberg 4(5), the solution of order 4",
                          .guards = kBetweenSteps,
                          .force = "raised by increments until the residual of the contact changes sign"},
      MethodOfIntegration{.method = Method::located,
                          .takes_effects = false,
                          .flies_in_closed_form = false,
                          .keeps_tolerance = true,
                          .pair = "Dormand-Prince 5(4)",
                          .guards = "located on dense output where signs at the ends of a step differ",
                          .force = kSolved},
      MethodOfIntegration{.method = Method::fixed,
                          .takes_effects = false,
                          .flies_in_closed_form = false,
                          .keeps_tolerance = false,
                          .pair = "classical Runge-Kutta of order 4",
                          .guards = kBetweenSteps,
                          .force = kSolved},
  };
  return *std::ranges::find(kMethods, scene.accuracy.method, &MethodOfIntegration::method);
}

}  // namespace rubatlas::settings
