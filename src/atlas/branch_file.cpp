#include "atlas/branch_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "atlas/hdf5.hpp"
#include "atlas/inner_scale.hpp"
#include "atlas/publish.hpp"
#include "settings/reader.hpp"

namespace rubatlas::atlas {
namespace {

/// Datasets over one axis.
class BranchColumns {
 public:
  BranchColumns(File& file, std::string group, const Dataset& axis)
      : file_(&file), group_(std::move(group)), axis_(&axis) {}

  template <Number T>
  Dataset write(const std::string& name, const std::vector<T>& values, const std::string& units,
                const std::string& long_name, const std::vector<const Dataset*>& inner = {}) const {
    Shape shape{axis_->size()};
    for (const Dataset* scale : inner) shape.push_back(scale->size());
    Dataset dataset = file_->create_dataset<T>(group_ + name, shape);
    dataset.template write<T>(values);
    dataset.attach_scale(0, *axis_);
    for (std::size_t i = 0; i < inner.size(); ++i) dataset.attach_scale(i + 1, *inner[i]);
    if (!units.empty()) dataset.set_text("units", units);
    dataset.set_text("long_name", long_name);
    return dataset;
  }
  void write_flags(const std::string& name, const std::vector<std::uint8_t>& values,
                   std::span<const std::uint8_t> flags, const std::string& meanings,
                   const std::string& long_name) const {
    Dataset dataset = write<std::uint8_t>(name, values, "", long_name);
    dataset.set_numbers<std::uint8_t>("flag_values", flags);
    dataset.set_text("flag_meanings", meanings);
  }

 private:
  File* file_;
  std::string group_;
  const Dataset* axis_;
};

/// Inner axes that orbits and events share.
struct StateScales {
  Dataset component;
  Dataset multiplier;
  Dataset part;
};

void write_orbits(const BranchColumns& columns, const StateScales& scales, const BranchContents& contents,
                  const std::vector<const branch::Orbit*>& orbits, const std::vector<std::int32_t>& branch) {
  const auto each = [&](auto value) {
    std::vector<decltype(value(*orbits.front()))> values;
    values.reserve(orbits.size());
    for (const branch::Orbit* orbit : orbits) values.push_back(value(*orbit));
    return values;
  };
  constexpr std::array kNames{"parameter", "second_parameter"};
  for (std::size_t i = 0; i < contents.quantities.size(); ++i) {
    const settings::Quantity& quantity = *contents.quantities[i];
    columns.write<double>(kNames.at(i), each([i](const branch::Orbit& orbit) { return orbit.quantities[i]; }),
                          std::string(quantity.unit), std::string(quantity.meaning));
  }
  std::vector<double> sections;
  std::vector<double> multipliers;
  for (const branch::Orbit* orbit : orbits) {
    sections.insert(sections.end(), orbit->section.begin(), orbit->section.end());
    for (const std::complex<double>& multiplier : orbit->multipliers) {
      multipliers.push_back(multiplier.real());
      multipliers.push_back(multiplier.imag());
    }
  }
  columns.write<double>("section", sections, "m",
                        "periodic orbit at phase 0: x, y [m], dx/dtau, dy/dtau [m per unit tau]",
                        {&scales.component});
  columns.write<std::int32_t>("period",
                              each([](const branch::Orbit& orbit) { return std::int32_t{orbit.period}; }),
                              "1", "period of the orbit in revolutions");
  columns.write<std::int32_t>("passings",
                              each([](const branch::Orbit& orbit) { return std::int32_t{orbit.passings}; }),
                              "1", "blade passings after which it repeats itself, with other blades in turn");
  columns.write<double>("multipliers", multipliers, "1", "Floquet multipliers, the largest first",
                        {&scales.multiplier, &scales.part});
  constexpr std::array<std::uint8_t, 2> kFlags{0, 1};
  columns.write_flags("stability", each([](const branch::Orbit& orbit) {
                        return static_cast<std::uint8_t>(orbit.is_stable() ? 1 : 0);
                      }),
                      kFlags, "unstable stable", "whether all multipliers lie within the unit circle");
  columns.write_flags("admissible", each([](const branch::Orbit& orbit) {
                        return static_cast<std::uint8_t>(orbit.admissible ? 1 : 0);
                      }),
                      kFlags, "no yes", "whether no other tip touches, as the search for touch-downs proves");
  columns.write<double>("nearest_miss", each([](const branch::Orbit& orbit) {
                          return orbit.map.nearest_pass ? orbit.map.nearest_pass->miss
                                                        : std::numeric_limits<double>::quiet_NaN();
                        }),
                        "m", "smallest distance by which a tip passes the ring; NaN where none does");
  columns.write<std::int32_t>("branch", branch, "1",
                              "which branch, counted from 0: those that are switched to come after");
}

}  // namespace

void write_branch(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                  const BranchContents& contents, const Software& software) {
  Publication publication(output);
  File file = File::create(publication.name());
  write_provenance(file.root(), software, FileKind::branch, scene);
  file.root().set_number<double>("tolerance", contents.tolerance);
  file.root().set_text("along", std::string(contents.quantities.front()->pointer));
  if (contents.quantities.size() > 1)
    file.root().set_text("in", std::string(contents.quantities[1]->pointer));
  const auto axes = settings::axes_of(scene);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (std::ranges::find(contents.quantities, axes[i].quantity) == contents.quantities.end())
      file.root().set_number<double>(axes[i].name, contents.values[i]);
  }
  if (contents.curve_of) file.root().set_text("curve", std::string(branch::word_of(*contents.curve_of)));
  file.root().set_number<std::uint8_t>(
      "goes_on", std::ranges::any_of(contents.branches, &branch::Branch::goes_on) ? 1 : 0);
  file.create_text("/scene", scene_text).set_text("long_name", "the scene file, as it was given");
  file.create_text("/scene_resolved", settings::resolved_json(scene))
      .set_text("long_name", "the scene with every default and every axis value written out");

  std::vector<const branch::Orbit*> orbits;
  std::vector<std::int32_t> of_orbits;
  std::vector<const branch::Orbit*> at_events;
  std::vector<std::int32_t> of_events;
  std::vector<const branch::Event*> events;
  for (std::size_t i = 0; i < contents.branches.size(); ++i) {
    const auto number = static_cast<std::int32_t>(i);
    for (const branch::Orbit& orbit : contents.branches[i].orbits) {
      orbits.push_back(&orbit);
      of_orbits.push_back(number);
    }
    for (const branch::Event& event : contents.branches[i].events) {
      at_events.push_back(&event.orbit);
      of_events.push_back(number);
      events.push_back(&event);
    }
  }
  {
    const StateScales scales{
        create_inner_scale(file, {"component", std::vector<std::string>{"x", "y", "vx", "vy"}, "1",
                                  "displacement from equilibrium and its derivative by tau"}),
        create_inner_scale(file, {"multiplier", counted(4, 1), "1", "multiplier, the largest first"}),
        create_inner_scale(
            file, {"part", std::vector<std::string>{"real", "imaginary"}, "1", "part of a complex number"})};
    const Dataset point = create_inner_scale(
        file, {"point", counted(orbits.size(), 0), "1", "number of the orbit, along the branch"});
    write_orbits(BranchColumns(file, "", point), scales, contents, orbits, of_orbits);
    if (!events.empty()) {
      file.create_group("/events");
      const Dataset event =
          create_inner_scale(file, {"event", counted(events.size(), 0), "1", "number of the bifurcation"});
      const BranchColumns columns(file, "/events/", event);
      write_orbits(columns, scales, contents, at_events, of_events);
      std::vector<std::uint8_t> kinds;
      std::vector<std::uint8_t> sides;
      std::vector<double> uncertainties;
      for (const branch::Event* each : events) {
        kinds.push_back(static_cast<std::uint8_t>(each->kind));
        sides.push_back(static_cast<std::uint8_t>(each->side));
        uncertainties.push_back(each->uncertainty);
      }
      constexpr std::array<std::uint8_t, 5> kKinds{1, 2, 3, 4, 5};
      columns.write_flags("kind", kinds, kKinds, std::string(branch::kEventKinds), "what happens there");
      constexpr std::array<std::uint8_t, 4> kSides{0, 1, 2, 3};
      columns.write_flags("grazing_side", sides, kSides, observables::kGrazingSides,
                          "on which side a tip grazes");
      columns.write<double>("uncertainty", uncertainties, std::string(contents.quantities.front()->unit),
                            "between which neighbours the bifurcation lies: their distance in the parameter");
    }
  }
  file.close();
  publication.publish();
}

}  // namespace rubatlas::atlas
