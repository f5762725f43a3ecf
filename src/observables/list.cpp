#include "observables/list.hpp"

#include <algorithm>
#include <array>

#include "observables/approach_speed.hpp"
#include "observables/contact_figures.hpp"
#include "observables/contact_figures_of_blades.hpp"
#include "observables/exponents.hpp"
#include "observables/grazing.hpp"
#include "observables/inner_axis_size.hpp"
#include "observables/max_displacement.hpp"
#include "observables/poincare.hpp"
#include "observables/poincare_blade_passing.hpp"
#include "observables/powers.hpp"
#include "observables/recorder.hpp"
#include "observables/spectrum.hpp"

namespace rubatlas::observables {
namespace {

struct Entry {
  const char* name;
  std::vector<std::string> inner_axes;
  const char* units;
  const char* long_name;
  /// Null: kept beside the entry before, by the same object.
  std::unique_ptr<Observable> (*make)(const settings::Scene&);
  const char* flags = "";
};

/// What each word of `settings::observable_names` means, in the order of datasets and rows; `yielded`, which
/// no scene names, comes last.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> kEntries = {
      {"poincare",
       {"section", "component"},
       "m",
       "state at phase 0 after each sampled revolution",
       Poincare::make},
      {"poincare_blade_passing",
       {"passing", "component"},
       "m",
       "state at each blade passing of the sampled revolutions",
       PoincareBladePassing::make},
      {"max_displacement",
       {},
       "m",
       "largest displacement of the shaft centre over continuous time",
       MaxDisplacement::make},
      {"spectrum", {"order"}, "m", "amplitude of x, 0-peak", SpectrumOfDisplacement::make},
      {"touchdowns_per_revolution", {}, "1", "touch-downs per revolution", TouchdownsPerRevolution::make},
      {"max_contact_force", {}, "N", "largest normal force on one blade", MaxContactForce::make},
      {"contact_fraction", {}, "1", "share of time with any blade in contact", ContactFraction::make},
      {"max_root_strain", {}, "1", "largest bending strain at a blade root", MaxRootStrain::make},
      {"clearance_growth",
       {},
       "m",
       "growth of the clearance over the point by wear, of the blade that has worn most",
       ClearanceGrowth::make},
      {"nearest_miss",
       {},
       "m",
       "smallest distance by which a tip that is not in contact passes the ring; NaN where none does",
       NearestMiss::make},
      {"lightest_touch",
       {},
       "m",
       "smallest depth of a contact, the largest overlap of the undeformed tip within it; NaN without "
       "contact",
       LightestTouch::make},
      {"grazing_side",
       {},
       "",
       "side on which the nearest miss or the lightest touch, whichever is nearer to zero, would graze",
       NearestGrazing::make,
       kGrazingSides},
      {"lyapunov",
       {"exponent"},
       "1",
       "Lyapunov exponents per unit tau, descending; NaN where the motion has no linearisation",
       Lyapunov::make},
      {"lyapunov_error",
       {"exponent"},
       "1",
       "standard error of each exponent over batches of the sampled revolutions",
       nullptr},
      {"lyapunov_residual",
       {},
       "1",
       "sum of the exponents less its exact value, that of the damping and what slip reversals add",
       nullptr},
      {"full_spectrum",
       {"whirl_order"},
       "m",
       "radii of the circles that make up the whirl x + iy",
       FullSpectrumOfDisplacement::make},
      {"friction_power", {}, "W", "mean power of friction at the tips", FrictionPower::make},
      {"viscous_power", {}, "W", "mean power of the shaft's viscous damping", ViscousPower::make},
      {"deformation_power",
       {},
       "W",
       "mean power of the normal forces of contacts, which bend blades and push the ring",
       DeformationPower::make},
      {"drive_torque", {}, "N m", "mean torque that keeps the speed constant", DriveTorque::make},
      {"touchdowns_of_blades",
       {"blade"},
       "1",
       "touch-downs of each blade per revolution",
       TouchdownsOfBlades::make},
      {"contact_fraction_of_blades",
       {"blade"},
       "1",
       "share of time that each blade is in contact",
       ContactFractionOfBlades::make},
      {"impulse_of_blades",
       {"blade"},
       "N s",
       "impulse of the normal force on each blade per revolution",
       ImpulseOfBlades::make},
      {"max_contact_force_of_blades",
       {"blade"},
       "N",
       "largest normal force on each blade",
       MaxContactForceOfBlades::make},
      {"approach_speed",
       {},
       "m/s",
       "largest speed of a tip towards the ring where it touches down",
       ApproachSpeed::make},
      {"max_root_stress", {}, "Pa", "largest bending stress at a blade root", MaxRootStress::make},
      {"yielded", {}, "1", "1 where a blade root was strained beyond validity.yield_strain", Yielded::make}};
  return kEntries;
}

InnerAxis make_axis(const std::string& name, const settings::Scene& scene) {
  const auto numbers = [](int count, int first) {
    std::vector<std::int32_t> values(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = first + static_cast<std::int32_t>(i);
    return values;
  };
  const settings::Protocol& protocol = scene.protocol;
  if (name == "component")
    return {name, std::vector<std::string>{"x", "y", "vx", "vy"}, "", "component of the state"};
  if (name == "section") {
    return {name, numbers(protocol.sampled_revolutions, protocol.transient_revolutions + 1), "1",
            "revolutions since the point started"};
  }
  if (name == "passing") {
    const int count = scene.blades.count;
    return {name, numbers(protocol.sampled_revolutions * count, protocol.transient_revolutions * count + 1),
            "1", "blade passings since the point started"};
  }
  if (name == "blade") return {name, numbers(scene.blades.count, 1), "1", "blade, counted from 1"};
  if (name == "exponent") {
    return {name, numbers(static_cast<int>(inner_axis_size(name, scene)), 1), "1",
            "exponent, counted from 1 from the largest"};
  }
  const bool signs = name == "whirl_order";
  const double first = signs ? -scene.spectrum.max_order * protocol.sampled_revolutions : 0.0;
  std::vector<double> orders(inner_axis_size(name, scene));
  for (std::size_t i = 0; i < orders.size(); ++i)
    orders[i] = (first + static_cast<double>(i)) / protocol.sampled_revolutions;
  return {name, orders, "1",
          signs ? "order: multiple of the speed of rotation; positive with the rotation, negative against it"
                : "order: multiple of the speed of rotation"};
}

/// The flag comes with its limit, and what is kept beside another observable with that; everything else is
/// named by the scene.
bool asked_for(const Entry& entry, const settings::Scene& scene) {
  if (entry.make == Yielded::make) return scene.validity.yield_strain.has_value();
  const Entry* named = &entry;
  while (named->make == nullptr) --named;
  return std::find(scene.observables.begin(), scene.observables.end(), named->name) !=
         scene.observables.end();
}

}  // namespace

std::size_t inner_axis_size(std::string_view name, const settings::Scene& scene) {
  const auto sections = static_cast<std::size_t>(scene.protocol.sampled_revolutions);
  const auto blades = static_cast<std::size_t>(scene.blades.count);
  if (name == "component") return std::tuple_size_v<trajectory::State>;
  if (name == "section") return sections;
  if (name == "passing") return sections * blades;
  if (name == "blade") return blades;
  if (name == "exponent") return effects::acts<&effects::Effects::ring_body>(scene) ? 8 : 4;
  const std::size_t orders = static_cast<std::size_t>(scene.spectrum.max_order) * sections + 1;
  return name == "whirl_order" ? 2 * orders - 1 : orders;
}

std::vector<Description> descriptions(const settings::Scene& scene) {
  std::vector<Description> result;
  for (const Entry& entry : entries()) {
    if (!asked_for(entry, scene)) continue;
    std::size_t row_size = 1;
    for (const std::string& axis : entry.inner_axes) row_size *= inner_axis_size(axis, scene);
    result.push_back({entry.name, entry.inner_axes, entry.units, entry.long_name, row_size, entry.flags});
  }
  return result;
}

std::vector<Description> memories(const settings::Scene& scene) {
  std::vector<Description> result;
  for (const effects::Listed& effect : effects::listed()) {
    if (!effect.memory) continue;
    const std::string section(effect.description.section);
    const bool swept = std::ranges::any_of(scene.grid.swept, [&](const settings::PointerAxis& axis) {
      return axis.pointer.starts_with(section + '/');
    });
    if (!swept && !effect.acts(scene)) continue;
    std::string name = "final_state" + section;
    std::ranges::replace(name, '/', '_');
    const std::string axis(effect.memory->inner_axis);
    result.push_back({name,
                      {axis},
                      std::string(effect.memory->units),
                      std::string(effect.memory->long_name),
                      inner_axis_size(axis, scene)});
  }
  return result;
}

std::vector<InnerAxis> inner_axes(const settings::Scene& scene) {
  std::vector<std::string> names = {"component"};
  const auto add = [&](const std::vector<Description>& kept) {
    for (const Description& description : kept) {
      for (const std::string& name : description.inner_axes) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      }
    }
  };
  add(descriptions(scene));
  add(memories(scene));
  std::vector<InnerAxis> result;
  result.reserve(names.size());
  for (const std::string& name : names) result.push_back(make_axis(name, scene));
  return result;
}

Recorder::Recorder(const settings::Scene& scene) : descriptions_(descriptions(scene)) {
  for (const Entry& entry : entries()) {
    if (!asked_for(entry, scene)) continue;
    if (entry.make != nullptr) observables_.push_back(entry.make(scene));
    const int beside = entry.make != nullptr ? -1 : writers_.back().beside + 1;
    writers_.push_back({observables_.size() - 1, beside});
  }
}

Rows Recorder::rows(bool done) {
  Rows rows;
  for (std::size_t i = 0; i < writers_.size(); ++i) {
    std::vector<double> row(descriptions_[i].row_size, std::numeric_limits<double>::quiet_NaN());
    const auto [number, beside] = writers_[i];
    Observable& observable = *observables_[number];
    if (done) beside < 0 ? observable.write(row) : observable.write_beside(beside, row);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace rubatlas::observables
