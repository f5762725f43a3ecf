/// The contact law of flexible blades whose load has a direction: against the law of the model, and against
/// equilibrium worked out anew.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "directed_rotors.hpp"

namespace rubatlas::contact {
namespace {

TEST(DirectedElastica, AxialLoadWithCoulombFrictionIsTheLawOfTheModel) {
  int compared = 0;
  double worst = 0;
  for (const TestRotor& rotor : {kDefaultRotor, kRig}) {
    for (const double friction : {0.0, 1e-4, 0.01, 0.1, 0.5, 2.0}) {
      const ElasticaContact model = rotor.contact(friction);
      const auto law = directed<AxialLoad>(rotor, CoulombFriction{friction});
      RandomContacts contacts(rotor, 0.25, 51);
      for (int i = 0; i < 2000; ++i) {
        Pose at = contacts.next();
        // Down to the lightest contacts; and a little beyond lift-off, from a contact.
        if (i % 4 == 1) at.gap *= std::pow(10.0, -9 * contacts.uniform());
        const double slip = i % 2 == 0 ? 1.0 : -1.0;
        double bending = 0.1;
        TipForce expected{};
        bool has_force = model.respond(at, slip, 0.5, bending, expected);
        Met met = meet(law, at, slip, 0.5);
        if (std::max(expected.shortening, met.force.shortening) > (friction > 1.0 ? 0.6 : 0.73)) continue;
        ASSERT_EQ(met.found, has_force)
            << friction << ", " << i << " " << bending << " " << expected.shortening;
        if (!has_force) continue;
        if (i % 4 == 2) {
          at.gap *= 1e-5;
          model.respond(at, slip, 0.5, bending, expected);
          at.gap = -at.gap;
          has_force = model.respond(at, slip, 0.5, bending, expected);
          met = meet(law, at, slip, 0.5, met.bending, met.amplitude);
          ASSERT_EQ(met.found, has_force)
              << friction << ", " << i << " " << bending << " " << expected.shortening;
        }
        const double e = difference(met.force, expected) / (std::abs(expected.normal) + 1e-300);
        if (e > 1e-12)
          printf("%g: mu %g i %d gap %g ct %g s %g F %g\n", e, friction, i, at.gap, at.tangential, slip,
                 expected.normal);
        worst = std::max(worst, e);
        ++compared;
      }
    }
  }
  printf("%d worst %g\n", compared, worst);
}
}  // namespace
}  // namespace rubatlas::contact
