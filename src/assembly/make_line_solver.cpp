#include "assembly/make_line_solver.hpp"

#include <type_traits>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::assembly {

namespace {

/// An effect besides the unbalance is present and not of strength zero.
bool more_acts_than_the_paper_s(const settings::Scene& line) {
  bool found = false;
  effects::for_each_effect([&]<auto Effect>() {
    using Settings = std::remove_cvref_t<decltype(*(line.*Effect))>;
    if constexpr (!std::is_same_v<Settings, effects::Unbalance>) found = found || effects::acts<Effect>(line);
  });
  return found;
}

}  // namespace

std::shared_ptr<BladeTables> make_blade_tables() {
  return std::make_shared<BladeTables>();
}

std::unique_ptr<point::LineSolver> make_line_solver(const settings::Scene& scene,
                                                    const plan::PointParameters& line,
                                                    const std::shared_ptr<BladeTables>& tables) {
  const settings::Scene own = plan::scene_of_line(scene, line);
  const LineRequest request{own, *tables};
  if (more_acts_than_the_paper_s(own)) return make_hybrid_with_effects(request);
  switch (scene.accuracy.method) {
    case settings::Method::paper:
      return make_paper(request);
    case settings::Method::located:
      return make_located(request);
    case settings::Method::fixed:
      return make_fixed(request);
    case settings::Method::hybrid_54:
      return make_hybrid_54(request);
    case settings::Method::hybrid_32:
      return make_hybrid_32(request);
    default:
      return make_hybrid(request);
  }
}

}  // namespace rubatlas::assembly
