#include "reference_case.hpp"
#include "../support/point.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace rubatlas::test {
namespace {

motion::SectionState state_of(const nlohmann::json& values) {
  return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>(),
          values.at(3).get<double>()};
}

ReferenceCase read_case(const nlohmann::json& json) {
  ReferenceCase c;
  c.name = json.at("name");
  const auto& p = json.at("params");
  c.scene.rotor = {p.at("m"), p.at("omega_n"), p.at("zeta"), p.at("y0")};
  c.scene.blades = {p.at("n"), p.at("L"), p.at("b"), p.at("h"), p.at("E"), p.at("rh")};
  c.scene.ring.radius = p.at("R");
  c.scene.contact = {settings::ContactLaw::elastica, p.at("mu")};
  if (p.at("me").get<double>() != 0.0) c.scene.unbalance = settings::Unbalance{p.at("me"), 0.0};
  c.speed_ratio = p.at("Omega");
  c.start = state_of(json.at("initial_state"));
  c.periodic = json.at("kind") == "periodic";
  c.touchdowns_in_ten = json.at("touchdowns_rev_1_to_10");
  c.max_displacement = json.at("max_displacement");
  c.last_section = json.at("last_section_index");
  for (const auto& section : json.at("sections_1_to_10")) c.first_sections.push_back(state_of(section));
  for (const auto& section : json.at("sections_last_11")) c.last_sections.push_back(state_of(section));
  for (const auto& value : json.at("sections_1_to_10_abs_diff_tol1e-16_vs_1e-18"))
    c.section_uncertainty.push_back(value);
  for (const auto& event : json.at("events_first")) {
    c.events.push_back(
        {event.at("ev"), event.at("rev"), event.at("blade"), event.at("tau"),
         event.contains("F") ? event.at("F").get<double>() : std::numeric_limits<double>::quiet_NaN()});
  }
  c.scene.observables = {"poincare", "max_displacement"};
  c.scene.protocol = {c.last_section - 100, 100, 64};
  return c;
}

}  // namespace

double ReferenceCase::amplitude() const {
  double largest = 0.0;
  for (const auto* list : {&first_sections, &last_sections}) {
    for (const auto& section : *list) {
      for (const double value : section) largest = std::max(largest, std::abs(value));
    }
  }
  return largest;
}

const std::vector<ReferenceCase>& reference_cases() {
  static const std::vector<ReferenceCase> kCases = [] {
    std::ifstream file(RUBATLAS_SOURCE_DIR "/tests/reference/orbits.json");
    std::vector<ReferenceCase> cases;
    const nlohmann::json document = nlohmann::json::parse(file);
    for (const auto& json : document.at("cases")) cases.push_back(read_case(json));
    return cases;
  }();
  return kCases;
}

const ReferenceCase& reference_case(const std::string& name) {
  for (const ReferenceCase& c : reference_cases()) {
    if (c.name == name) return c;
  }
  throw std::invalid_argument("no reference case " + name);
}

std::vector<motion::SectionState> sections_of(const ReferenceCase& c, double tolerance) {
  return sections_of(c, tolerance, c.last_section);
}

std::vector<motion::SectionState> sections_of(const ReferenceCase& c, double tolerance, int revolutions) {
  settings::Scene scene = c.scene;
  scene.accuracy.tolerance = tolerance;
  scene.observables = {"poincare"};
  scene.protocol = {0, revolutions, 64};
  const auto outcome = run(scene, c.speed_ratio, c.start);
  if (outcome.status != ending::PointStatus::done) throw std::runtime_error(c.name + " did not end as done");
  std::vector<motion::SectionState> sections;
  for (std::size_t i = 0; i + 3 < outcome.rows[0].size(); i += 4) {
    sections.push_back(
        {outcome.rows[0][i], outcome.rows[0][i + 1], outcome.rows[0][i + 2], outcome.rows[0][i + 3]});
  }
  return sections;
}

std::vector<motion::SectionState> settled_sections_of(const ReferenceCase& c, double tolerance) {
  constexpr const char* kLongTransient = "default_Om0.68";
  return sections_of(c, tolerance, c.name == kLongTransient ? 3 * c.last_section : c.last_section);
}

contact::ElasticaContact contact_of(const ReferenceCase& c) {
  const settings::Blades& blades = c.scene.blades;
  const double stiffness = blades.youngs_modulus * blades.width * std::pow(blades.thickness, 3) / 12.0;
  return {{blades.hub_radius + blades.length, c.scene.ring.radius},
          {blades.length, blades.thickness, stiffness},
          std::make_shared<blade::ElasticaCurve>(c.scene.contact.friction)};
}

rotor::RotorConstants constants_of(const ReferenceCase& c) {
  const settings::Rotor& rotor = c.scene.rotor;
  return {c.speed_ratio, rotor.damping_ratio, rotor.misalignment,
          1.0 / (rotor.mass * rotor.natural_frequency * rotor.natural_frequency), c.scene.clearance()};
}

}  // namespace rubatlas::test
