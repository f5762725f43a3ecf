/// Gap, slip direction, force and tip of both rotors against the 50-digit values of
/// tests/reference/force.json.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "rotors.hpp"

namespace rubatlas::contact {
namespace {

constexpr double kAccuracy = 1e-10;        ///< relative, of everything that a contact gives
constexpr double kGapNoise = 2e-18;        ///< [m²]: rounding of g in double precision
constexpr double kDirectionNoise = 2e-16;  ///< rounding of cos φ, sin φ

TestRotor rotor_of(const nlohmann::json& document, const nlohmann::json& row) {
  const auto& rotor = document.at("rotors").at(row.at("rotor").get<std::string>());
  const auto value = [&](const char* key) { return rotor.at(key).get<double>(); };
  return {value("R"), value("L"), value("rh"), value("E"), value("b"), value("h"), value("y0")};
}

TEST(ElasticaContact, ForcesEqualReferenceValues) {
  std::ifstream file(RUBATLAS_SOURCE_DIR "/tests/reference/force.json");
  const auto document = nlohmann::json::parse(file);
  ASSERT_EQ(document.at("rows").size(), 44U);
  for (const auto& row : document.at("rows")) {
    SCOPED_TRACE(row.dump());
    const auto value = [&](const char* key) { return row.at(key).get<double>(); };
    const TestRotor rotor = rotor_of(document, row);
    const ElasticaContact law = rotor.contact(value("mu"));
    const Geometry geometry = rotor.geometry();
    const BladeDirection er{std::cos(value("phi")), std::sin(value("phi"))};
    const Pose at = pose(geometry, er, value("x"), value("y") + rotor.misalignment, value("xp"), value("yp"));
    const double speed = value("Omega");

    EXPECT_NEAR(at.gap, value("g"), kGapNoise);
    EXPECT_NEAR(at.tangential, value("ct"), kDirectionNoise * rotor.ring_radius);
    const double undeformed = undeformed_slip_velocity(geometry, at, speed);
    EXPECT_NEAR(undeformed, value("v_undeformed"), kAccuracy * std::abs(value("v_undeformed")));
    // The reference prescribes s where it departs from the sign rule, and says so in `kind`.
    const double slip = value("s");
    if (!row.at("kind").get<std::string>().starts_with("s=")) {
      EXPECT_EQ(undeformed >= 0.0 ? 1.0 : -1.0, slip);
    }

    const auto root = law.solve(at, slip);
    ASSERT_TRUE(root.has_value());
    const auto contact = law.constraint(at, slip, *root, speed);
    const blade::CurvePoint point = law.curve().at(*root);
    // What the rounding of g is worth along the curve.
    const double bending_noise = kGapNoise / std::abs(contact.bending_slope);
    const double load_noise = bending_noise * rotor.load_unit() * point.load_slope;
    const auto allowed = [&](double exact, double noise) { return kAccuracy * std::abs(exact) + noise; };
    EXPECT_NEAR(contact.force.normal, value("F"), allowed(value("F"), load_noise));
    EXPECT_NEAR(contact.force.normal / rotor.euler_load(), value("F_over_Euler"),
                1e-7 * value("F_over_Euler") + load_noise);
    EXPECT_NEAR(contact.force.shortening * rotor.length, value("delta"),
                allowed(value("delta"), bending_noise * rotor.length * point.shortening_slope));
    EXPECT_NEAR(rotor.length * point.deflection, value("Delta"),
                allowed(value("Delta"), bending_noise * rotor.length * point.deflection_slope));
    const double x = contact.force.radial * er.cosine - contact.force.tangential * er.sine;
    const double y = contact.force.radial * er.sine + contact.force.tangential * er.cosine;
    // A component may be small against the force; the force's direction is what is known to 1e-10.
    const double force = std::hypot(value("Fx"), value("Fy"));
    EXPECT_NEAR(x, value("Fx"), allowed(force, 2 * load_noise));
    EXPECT_NEAR(y, value("Fy"), allowed(force, 2 * load_noise));
    EXPECT_NEAR(contact.force.slip_velocity, value("v_deformed"),
                kAccuracy * std::abs(value("v_deformed")) +
                    2 * speed * bending_noise * rotor.length * point.deflection_slope);
  }
}

}  // namespace
}  // namespace rubatlas::contact
