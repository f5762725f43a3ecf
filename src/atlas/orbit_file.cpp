#include "atlas/orbit_file.hpp"

#include <span>

#include "atlas/hdf5.hpp"
#include "atlas/inner_scale.hpp"
#include "atlas/publish.hpp"
#include "settings/quantity.hpp"
#include "settings/reader.hpp"

namespace rubatlas::atlas {
namespace {

std::vector<double> flat(const std::vector<motion::SectionState>& states) {
  std::vector<double> values;
  for (const auto& state : states) values.insert(values.end(), state.begin(), state.end());
  return values;
}

void write_array(File& file, const std::string& name, const std::vector<double>& values, const Dataset& outer,
                 const Dataset& inner, const std::string& units, const std::string& long_name) {
  Dataset dataset = file.create_dataset<double>(name, {outer.size(), inner.size()});
  dataset.write<double>(values);
  dataset.attach_scale(0, outer);
  dataset.attach_scale(1, inner);
  dataset.set_text("units", units);
  dataset.set_text("long_name", long_name);
}

template <Number T>
void write_column(File& file, const std::string& name, const std::vector<T>& values, const Dataset& axis,
                  const std::string& units, const std::string& long_name) {
  Dataset dataset = file.create_dataset<T>(name, {axis.size()});
  dataset.template write<T>(values);
  dataset.attach_scale(0, axis);
  dataset.set_text("units", units);
  dataset.set_text("long_name", long_name);
}

/// Contact after contact, each from its touch-down to its lift-off.
void write_contacts(File& file, const point::ContactSamples& contacts, const Dataset& component) {
  const Dataset sample = create_inner_scale(
      file, {"contact_sample", counted(contacts.time.size(), 0), "1", "number of a sample within a contact"});
  std::vector<std::int32_t> blade = contacts.blade;
  for (auto& number : blade) ++number;  // as in `/blade`
  write_column(file, "contact_number", contacts.number, sample, "1",
               "which contact, counted from 0 in the order in which they begin");
  write_column(file, "contact_blade", blade, sample, "1", "number of the blade in contact");
  write_column(file, "contact_time", contacts.time, sample, "1",
               "dimensionless time tau as in /time; each contact has its start, its peaks and its end");
  write_column(file, "contact_force", contacts.force, sample, "N", "normal contact force on that blade");
  write_array(file, "contact_state", flat(contacts.state), sample, component, "m",
              "state of the shaft centre: x, y [m], dx/dtau, dy/dtau [m per unit tau]");
}

void write_point(Object root, const settings::Scene& scene, const plan::PointParameters& parameters,
                 const motion::SectionState& start, const point::Orbit& orbit) {
  const auto axes = settings::axes_of(scene);
  const auto values = plan::values_of(parameters);
  for (std::size_t i = axes.size(); i-- > 0;) root.set_number<double>(axes[i].name, values[i]);
  root.set_numbers<double>("start", start);
  root.set_number<std::int32_t>("status", static_cast<std::int32_t>(orbit.status));
  root.set_text("status_meanings", "0 pending, 1 done, 2 left_validity, 3 integrator_failed");
  root.set_number<std::int32_t>("status_detail", static_cast<std::int32_t>(orbit.detail));
  root.set_text("status_detail_meaning", std::string(ending::text_of(orbit.detail)));
  root.set_number<std::int32_t>("failed_revolution", orbit.failed_revolution);
}

}  // namespace

void write_orbit(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                 const plan::PointParameters& parameters, const motion::SectionState& start,
                 const point::Orbit& orbit, const Software& software) {
  Publication publication(output);
  File file = File::create(publication.name());
  write_provenance(file.root(), software, FileKind::orbit, scene);
  write_point(file.root(), scene, parameters, start, orbit);
  file.create_text("/scene", scene_text).set_text("long_name", "the scene file, as it was given");
  file.create_text("/scene_resolved", settings::resolved_json(scene))
      .set_text("long_name", "the scene with every default and every axis value written out");

  const auto blades = static_cast<std::size_t>(scene.blades.count);
  {
    const Dataset time = create_inner_scale(
        file, {"time", orbit.time, "1",
               "dimensionless time tau = omega_n t since the start of the sampled revolutions"});
    const Dataset component =
        create_inner_scale(file, {"component", std::vector<std::string>{"x", "y", "vx", "vy"}, "1",
                                  "displacement from equilibrium and its derivative by tau"});
    const Dataset blade = create_inner_scale(file, {"blade", counted(blades, 1), "1", "number of the blade"});
    const Dataset section = create_inner_scale(
        file, {"section", counted(orbit.sections.size(), scene.protocol.transient_revolutions + 1), "1",
               "revolution at whose end the section is taken"});
    write_array(file, "state", flat(orbit.state), time, component, "m",
                "state of the shaft centre: x, y [m], dx/dtau, dy/dtau [m per unit tau]");
    write_array(file, "force", orbit.force, time, blade, "N", "normal contact force on each blade");
    write_array(file, "sections", flat(orbit.sections), section, component, "m",
                "Poincare sections, once per revolution at phase 0");
    write_contacts(file, orbit.contacts, component);
  }
  file.close();
  publication.publish();
}

}  // namespace rubatlas::atlas
