#include "assembly/initial_state.hpp"

#include "plan/scene_of_line.hpp"

namespace rubatlas::assembly {

motion::SectionState initial_state(const settings::Scene& scene, const plan::PointParameters& point) {
  const settings::Initial initial = plan::scene_of_line(scene, point).initial;
  return {initial.x, initial.y, initial.vx, initial.vy};
}

}  // namespace rubatlas::assembly
