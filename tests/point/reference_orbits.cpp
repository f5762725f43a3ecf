/// Whole motions against an independent 80-bit implementation (tests/reference).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "../support/point.hpp"
#include "contact/elastica_contact.hpp"
#include "reference_case.hpp"

namespace rubatlas::test {
namespace {

class ReferenceOrbit : public ::testing::TestWithParam<ReferenceCase> {};

TEST_P(ReferenceOrbit, SectionsOfPeriodicMotionsAgreeAfterAllRevolutions) {
  const ReferenceCase& c = GetParam();
  // Only these have last sections to agree on; chaotic ones are held to their first sections below.
  if (!c.periodic) return;
  // The phase of a motion that repeats after several revolutions is decided in its transient, where errors of
  // 1e-12 of the clearance may grow large enough to change it.
  const auto sections = settled_sections_of(c, 1e-13);
  const std::size_t last = sections.size();
  for (std::size_t i = 0; i < c.last_sections.size(); ++i) {
    EXPECT_LE(largest_difference(sections[last - 11 + i], c.last_sections[i]), 1e-9 * c.amplitude())
        << "section " << c.last_section - 10 + static_cast<int>(i);
  }
}

TEST_P(ReferenceOrbit, FirstSectionsAgreeAsFarAsTheMotionLetsErrorsBe) {
  const ReferenceCase& c = GetParam();
  // The data state how far its own runs at tolerances 1e-16 and 1e-18 drift apart from section to section,
  // which is how the motion amplifies errors. Ours are larger by the ratio of the tolerances; one more decade
  // for the constant. Steps do not get below the rounding of a force that starts like a root of the time.
  const double tolerance = c.scene.accuracy.method == settings::Method::hybrid ? 1e-12 : 1e-13;
  const double amplification = 10.0 * tolerance / 1e-16;
  // No further: of the motions near that at Ω = 0.98, one in fourteen leaves the model within 300
  // revolutions.
  const int count = static_cast<int>(c.first_sections.size());
  // In steps one contact in some thousand errs by up to 300 tolerances, whatever the tolerance: of three
  // motions the middle one counts. By collocation all do.
  std::vector<std::vector<motion::SectionState>> motions;
  for (const double share : {1.0, 0.99, 0.98}) motions.push_back(sections_of(c, share * tolerance, count));
  for (std::size_t i = 0; i < c.first_sections.size(); ++i) {
    std::vector<double> errors;
    for (const auto& sections : motions)
      errors.push_back(largest_difference(sections[i], c.first_sections[i]));
    std::ranges::sort(errors);
    const double floor = 10.0 * tolerance * c.scene.clearance();
    const double error = c.scene.accuracy.method == settings::Method::hybrid ? errors[1] : errors.back();
    EXPECT_LE(error, floor + amplification * c.section_uncertainty[i]) << "section " << i + 1;
  }
}

TEST_P(ReferenceOrbit, LargestDisplacementOfPeriodicMotionsAgrees) {
  const ReferenceCase& c = GetParam();
  if (!c.periodic || c.name == "default_Om0.68") return;  // the latter is still chaotic in revolution 201
  settings::Scene scene = c.scene;
  scene.accuracy.tolerance = 1e-13;
  const auto outcome = test::run(scene, c.speed_ratio, c.start);
  ASSERT_EQ(outcome.status, ending::PointStatus::done);
  EXPECT_NEAR(outcome.rows[1][0], c.max_displacement, 1e-9 * c.max_displacement);
}

/// Events of the first revolution, with the force of each contact.
class EventRecord final : public modes::MotionListener {
 public:
  void event(const modes::Event& event) override { events.push_back(event); }
  std::vector<modes::Event> events;
};

const char* name_of(modes::Guard event) {
  switch (event) {
    case modes::Guard::touch_down:
      return "touch";
    case modes::Guard::lift_off:
      return "lift";
    default:
      return "slip";
  }
}

TEST_P(ReferenceOrbit, EventsComeInTheSameOrderAtTheSameTimesWithTheSameForces) {
  const ReferenceCase& c = GetParam();
  if (c.scene.accuracy.method != settings::Method::hybrid) return;  // the motion below is that of `hybrid`
  const rotor::RotorConstants rotor = constants_of(c);
  const contact::ElasticaContact law = contact_of(c);
  const modes::ContactLimits limits{1e-13 * rotor.length_scale, 0.5};
  EventRecord record;
  std::vector<modes::Event> events;
  std::vector<int> revolutions;
  int touchdowns = 0;
  const auto run = [&](const auto& forcing) {
    const auto motion =
        hybrid_motion(rotor, rotor::BladeSet(c.scene.blades.count, rotor.speed_ratio), law, forcing, limits);
    ASSERT_EQ(motion->start(c.start), ending::StatusDetail::none);
    for (int revolution = 0; revolution < 10; ++revolution) {
      record.events.clear();
      ASSERT_EQ(revolve(*motion, record), ending::PointStatus::done);
      for (const auto& event : record.events) {
        events.push_back(event);
        revolutions.push_back(revolution);
        if (event.kind == modes::Guard::touch_down) ++touchdowns;
      }
    }
  };
  if (c.scene.unbalance) {
    run(rotor::RotatingUnbalance(c.scene.unbalance->moment / c.scene.rotor.mass, 0.0, c.speed_ratio,
                                 rotor.damping_ratio));
  } else {
    run(kNoForcing);
  }
  EXPECT_EQ(touchdowns, c.touchdowns_in_ten);

  const rotor::BladeSet blades(c.scene.blades.count, c.speed_ratio);
  for (std::size_t i = 0; i < c.events.size() && c.events[i].revolution < 2; ++i) {
    const ReferenceEvent& expected = c.events[i];
    ASSERT_LT(i, events.size());
    const modes::Event& found = events[i];
    ASSERT_EQ(name_of(found.kind), expected.kind.substr(0, 5)) << "event " << i;
    EXPECT_EQ(found.blade + 1, expected.blade) << "event " << i;
    EXPECT_EQ(revolutions[i], expected.revolution) << "event " << i;
    // Two revolutions amplify the tolerance by at most three decades (a slip reversal is where it takes
    // most).
    EXPECT_NEAR(found.time, expected.time, 1e-9) << "event " << i;
    if (std::isnan(expected.force)) continue;
    const auto direction = blades.direction(found.blade, blades.first(found.time));
    const contact::Pose pose = rotor::pose_of(rotor, law.geometry(), direction, found.state);
    if (found.slip * pose.tangential > 0.0 && c.scene.contact.friction > 0.0) {
      EXPECT_LT(std::abs(expected.force), 1e-6) << "no load where the blade approaches, event " << i;
    } else {
      const auto bending = law.solve(pose, found.slip);
      ASSERT_TRUE(bending.has_value());
      const double force = law.constraint(pose, found.slip, *bending, c.speed_ratio).force.normal;
      EXPECT_NEAR(force, expected.force, 1e-7 * std::abs(expected.force)) << "event " << i;
    }
  }
}

std::string name_of_case(const ::testing::TestParamInfo<ReferenceCase>& instance) {
  std::string name = instance.param.name;
  for (char& letter : name) {
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  }
  return name;
}

std::vector<ReferenceCase> cases_by(settings::Method method) {
  std::vector<ReferenceCase> cases = reference_cases();
  for (ReferenceCase& c : cases) c.scene.accuracy.method = method;
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Orbits, ReferenceOrbit, ::testing::ValuesIn(cases_by(settings::Method::hybrid)),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(ByCollocation, ReferenceOrbit,
                         ::testing::ValuesIn(cases_by(settings::Method::collocation)), name_of_case);

}  // namespace
}  // namespace rubatlas::test
