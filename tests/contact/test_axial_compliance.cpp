/// A blade that its load also compresses.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "compliant_blades.hpp"

namespace rubatlas::contact {
namespace {

TEST(AxialCompliance, MakesTheHeadOnForceProportionalToThePenetration) {
  for (const Theory theory : {Theory::elastica, Theory::beam_column}) {
    const BladeCase blade{0.1, 1.0, theory};
    const ElasticaContact law = make(blade);
    double before = 0.0;
    for (const double penetration : {1e-11, 1e-12, 1e-13, 1e-14}) {
      const double straight = blade.axial_stiffness() / kDefaultRotor.length * penetration;
      const double departure = 1.0 - force_at(law, pressed_tip(penetration)).normal / straight;
      EXPECT_GT(departure, 0.0) << "bending adds to what the blade yields";
      // Bending shortens the blade by the square of the load, so that its share falls with the load.
      if (before > 0.0) {
        EXPECT_NEAR(before / departure, 10.0, 0.4) << penetration;
      }
      before = departure;
    }
    EXPECT_LT(before, 1e-5);
  }
}

TEST(AxialCompliance, VanishesToFirstOrderWithItsShare) {
  RandomContacts contacts(kDefaultRotor, 0.2, 21);
  const ElasticaContact inextensible = make({0.1, 0.0});
  std::vector<ElasticaContact> laws;
  for (const double share : {1.0, 0.1, 0.01}) laws.push_back(make({0.1, share}));
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    Pose at = contacts.next();
    if (at.gap < 1e-4 || at.tangential < 0.0) continue;  // lighter contacts would need even smaller shares
    const auto root = inextensible.solve(at, 1.0);
    if (!root) continue;
    const double exact = inextensible.constraint(at, 1.0, *root, 0.3).force.normal;
    std::array<double, 3> difference{};
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const auto with = laws[k].solve(at, 1.0);
      ASSERT_TRUE(with.has_value());
      difference[k] = exact - laws[k].constraint(at, 1.0, *with, 0.3).force.normal;
    }
    EXPECT_GT(difference[2], 0.0);
    EXPECT_NEAR(difference[0] / difference[1], 10.0, 0.1) << i;
    EXPECT_NEAR(difference[1] / difference[2], 10.0, 0.1) << i;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(AxialCompliance, CompressesTheColumnStraightUpToItsEulerLoad) {
  const BladeCase blade{0.0, 1.0};
  const ElasticaContact law = make(blade);
  EXPECT_TRUE(law.may_stand_straight());
  const double stiffness = blade.axial_stiffness() / kDefaultRotor.length;
  const double buckling = blade.euler_load() / stiffness;  // penetration [m]
  for (const double part : {-0.5, 1e-9, 0.3, 0.999}) {
    const TipForce force = force_at(law, pressed_tip(part * buckling));
    EXPECT_NEAR(force.normal, part * blade.euler_load(), 1e-12 * std::abs(force.normal)) << part;
    EXPECT_NEAR(force.shortening * kDefaultRotor.length, part * buckling, 1e-12 * std::abs(part) * buckling);
    EXPECT_EQ(force.root_strain, 0.0) << "straight";
  }
  // At buckling the load is continuous; beyond buckling it is nearly constant.
  const double before = force_at(law, pressed_tip(buckling * (1 - 1e-9))).normal;
  const TipForce after = force_at(law, pressed_tip(buckling * (1 + 1e-9)));
  EXPECT_NEAR(after.normal / before, 1.0, 1e-8);
  EXPECT_GT(after.root_strain, 0.0) << "bent";
  const double beyond = force_at(law, pressed_tip(3 * buckling)).normal;
  EXPECT_GT(beyond, blade.euler_load());
  EXPECT_LT(beyond, blade.euler_load() * (1 + 1e-4));
  // The tip of a bent column lies on the ring too.
  const auto root = law.solve(pressed_tip(3 * buckling), 1.0);
  ASSERT_TRUE(root.has_value());
  EXPECT_NEAR(law.residual(pressed_tip(3 * buckling), 1.0, law.curve_at(*root)), 0.0, 1e-17);
}

TEST(AxialCompliance, LetsTheForceStartFromZeroALittlePastTopDeadCentre) {
  // Within 3εR/μ of top dead centre the axial shortening of a light contact exceeds what friction adds to the
  // tip's penetration.
  const BladeCase blade{0.1, 1.0};
  const ElasticaContact law = make(blade);
  const double edge = 3 * std::pow(blade.thickness / kDefaultRotor.length, 2) / 12 / blade.friction *
                      kDefaultRotor.ring_radius;
  for (const double part : {0.9, 1.1}) {
    const Pose at = pressed_tip(1e-16, -part * edge);
    EXPECT_EQ(law.starts_unloaded(at, 1.0), part < 1.0);
    const auto root = law.solve(at, 1.0);
    ASSERT_TRUE(root.has_value());
    const double force = law.constraint(at, 1.0, *root, 0.3).force.normal;
    if (part < 1.0) {
      EXPECT_LT(force, 1e-6 * blade.euler_load());
    } else {
      EXPECT_GT(force, 1e-5 * blade.euler_load());
    }
  }
}

}  // namespace
}  // namespace rubatlas::contact
