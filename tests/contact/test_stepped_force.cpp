/// The paper's search for the force, by increments.
#include <gtest/gtest.h>

#include "compared/raised_force.hpp"
#include "compliant_blades.hpp"

namespace rubatlas::contact {
namespace {

/// It ends at most one increment above the root.
void expect_steps_up_to_the_root(const ElasticaContact& law, double increment) {
  RandomContacts contacts(kDefaultRotor, 0.1, 27);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose at = contacts.next();
    const auto root = law.solve(at, 1.0);
    if (!root) continue;  // small slopes taken too far
    const double exact = force_at(law, at, 1.0, *root).normal;
    TipForce stepped{};
    if (!compared::raise_force(law, at, 1.0, 0.3, increment, stepped)) continue;
    EXPECT_GT(stepped.normal, exact - 0.06 * increment) << i;
    EXPECT_LT(stepped.normal, exact + 1.06 * increment) << i;
    ++compared;
  }
  EXPECT_GT(compared, 250);
}

TEST(Blades, ForceSteppedUpwardsEndsAtTheRoot) {
  for (const double friction : {0.0, 0.1}) {
    for (const Theory theory : {Theory::elastica, Theory::beam_column})
      expect_steps_up_to_the_root(make({friction, 0.0, theory}), 0.3);
  }
}

}  // namespace
}  // namespace rubatlas::contact
