#include "atlas/accuracy_file.hpp"

#include <array>
#include <functional>
#include <span>

#include "atlas/hdf5.hpp"
#include "atlas/inner_scale.hpp"
#include "atlas/publish.hpp"
#include "plan/grid.hpp"
#include "settings/reader.hpp"

namespace rubatlas::atlas {
namespace {

/// Axes of the file, and the datasets along them.
class Writer {
 public:
  Writer(File& file, const settings::Scene& scene, const AccuracyStudy& study)
      : file_(file),
        study_(study),
        setting_(scale({"setting", counted(study.settings.size(), 0), "1",
                        "a method with its knobs; 0 is the reference"})),
        component_(scale(
            {"component", std::vector<std::string>{"x", "y", "vx", "vy"}, "1", "component of the state"})) {
    const plan::Grid grid(scene);
    for (const auto& axis : grid.axes()) {
      grid_.push_back(scale({axis.name, axis.values, axis.units, axis.long_name}));
    }
  }

  Dataset scale(const observables::InnerAxis& axis) { return create_inner_scale(file_, axis); }

  void words_of_settings(const std::string& name, const std::string& long_name,
                         std::string AccuracySetting::*member) {
    std::vector<std::string> words;
    words.reserve(study_.settings.size());
    for (const auto& setting : study_.settings) words.push_back(setting.*member);
    Dataset dataset = file_.create_texts(name, words);
    dataset.attach_scale(0, setting_);
    dataset.set_text("long_name", long_name);
  }

  template <typename Entry>
  void per_setting(const std::string& name, const std::string& units, const std::string& long_name,
                   const std::vector<Entry>& entries, double Entry::*member) {
    std::vector<double> values;
    values.reserve(entries.size());
    for (const auto& entry : entries) values.push_back(entry.*member);
    write<double>(name, units, long_name, values, {&setting_});
  }

  template <Number T>
  Dataset per_point(const std::string& name, const std::string& units, const std::string& long_name,
                    const std::function<T(const AccuracyPoint&)>& value) {
    std::vector<T> values;
    for (const auto& point : study_.points) values.push_back(value(point));
    return write<T>(name, units, long_name, values, over_grid({}, {}));
  }

  template <Number T>
  Dataset per_run(const std::string& name, const std::string& units, const std::string& long_name,
                  const std::function<T(const AccuracyRun&)>& value) {
    std::vector<T> values;
    for (const auto& run : study_.runs) values.push_back(value(run));
    return write<T>(name, units, long_name, values, over_grid({&setting_}, {}));
  }

  void sections(const std::string& name, const std::string& long_name, const Dataset& along,
                std::vector<motion::SectionState> AccuracyRun::*member) {
    std::vector<double> values;
    for (const auto& run : study_.runs) {
      // A run that ended early has fewer sections, or none.
      const auto& states = run.*member;
      for (std::size_t i = 0; i < along.size(); ++i) {
        for (std::size_t c = 0; c < component_.size(); ++c) {
          values.push_back(i < states.size() ? states[i][c] : std::numeric_limits<double>::quiet_NaN());
        }
      }
    }
    write<double>(name, "m", long_name, values, over_grid({&setting_}, {&along, &component_}));
  }

  void starts() {
    std::vector<double> values;
    for (const auto& point : study_.points)
      values.insert(values.end(), point.start.state.begin(), point.start.state.end());
    write<double>("start", "m", "state from which all runs of a point start", values,
                  over_grid({}, {&component_}));
  }

 private:
  using Axes = std::vector<const Dataset*>;

  [[nodiscard]] Axes over_grid(const Axes& before, const Axes& behind) const {
    Axes axes = before;
    for (const auto& axis : grid_) axes.push_back(&axis);
    axes.insert(axes.end(), behind.begin(), behind.end());
    return axes;
  }

  template <Number T>
  Dataset write(const std::string& name, const std::string& units, const std::string& long_name,
                const std::vector<T>& values, const Axes& axes) {
    Shape shape;
    for (const auto* axis : axes) shape.push_back(axis->size());
    Dataset dataset = file_.create_dataset<T>(name, shape);
    dataset.template write<T>(std::span<const T>(values));
    for (std::size_t i = 0; i < axes.size(); ++i) dataset.attach_scale(i, *axes[i]);
    dataset.set_text("units", units);
    dataset.set_text("long_name", long_name);
    return dataset;
  }

  File& file_;
  const AccuracyStudy& study_;
  Dataset setting_;
  Dataset component_;
  std::vector<Dataset> grid_;
};

void write_settings(Writer& writer, const AccuracyStudy& study) {
  const auto knob = [&](const std::string& name, const std::string& units, const std::string& long_name,
                        double AccuracySetting::*member) {
    writer.per_setting(name, units, long_name + "; NaN where the method does not read it", study.settings,
                       member);
  };
  writer.words_of_settings("method", "method, as accuracy.method of a scene", &AccuracySetting::method);
  knob("tolerance", "1", "local error of a step relative to the clearance", &AccuracySetting::tolerance);
  knob("force_increment", "N", "increment of the stepped contact force", &AccuracySetting::force_increment);
  knob("max_step", "1", "longest step in dimensionless time", &AccuracySetting::max_step);
  knob("step", "1", "fixed step in dimensionless time", &AccuracySetting::step);
}

void write_map_changes(Writer& writer, const AccuracyStudy& study) {
  const auto share = [&](const std::string& name, const std::string& what, double MapChanges::*member) {
    writer.per_setting(name, "1", "share of points " + what + " than in the reference run", study.changes,
                       member);
  };
  share("class_changed", "with another class, or status,", &MapChanges::motion);
  share("region_changed", "in another region", &MapChanges::region);
  share("displacement_changed", "with another maximum displacement", &MapChanges::max_displacement);
  share("map_error", "with another class, region or maximum displacement", &MapChanges::any);
  share("map_error_beyond_chaos",
        "with another class or region, or, where they are predictable to the end, maximum displacement,",
        &MapChanges::beyond_chaos);
}

void write_times(Writer& writer) {
  using Run = const AccuracyRun&;
  const std::string differs = "measured: differs from run to run and from machine to machine";
  writer
      .per_run<double>("cpu_time_min", "s", "CPU time of a point, least of the repeats",
                       [](Run run) { return run.cpu_time_min; })
      .set_text("comment", differs);
  writer
      .per_run<double>("cpu_time_median", "s", "CPU time of a point, median of the repeats",
                       [](Run run) { return run.cpu_time_median; })
      .set_text("comment", differs);
}

void write_work(Writer& writer) {
  const auto count = [&](const std::string& name, const std::string& long_name,
                         std::uint64_t motion::WorkCounts::*member) {
    writer.per_run<std::int64_t>(
        name, "1", long_name + " in all revolutions of a point",
        [member](const AccuracyRun& run) { return static_cast<std::int64_t>(run.work.*member); });
  };
  count("right_hand_sides", "evaluations of the equations of motion", &motion::WorkCounts::right_hand_sides);
  count("elastica_evaluations", "evaluations of the blade's curve",
        &motion::WorkCounts::elastica_evaluations);
  count("gap_evaluations", "evaluations of the gap in flight", &motion::WorkCounts::gap_evaluations);
  count("steps", "accepted steps", &motion::WorkCounts::steps);
  count("rejected_steps", "rejected steps", &motion::WorkCounts::rejected_steps);
  count("touchdowns", "touch-downs", &motion::WorkCounts::touchdowns);
}

void write_motions(Writer& writer) {
  using Run = const AccuracyRun&;
  Dataset status = writer.per_run<std::uint8_t>(
      "status", "1", "how the run ended", [](Run run) { return static_cast<std::uint8_t>(run.status); });
  constexpr std::array<std::uint8_t, 4> kStatuses{0, 1, 2, 3};
  status.set_numbers<std::uint8_t>("flag_values", kStatuses);
  status.set_text("flag_meanings", "pending done left_validity integrator_failed");
  writer.per_run<std::int32_t>("failed_revolution", "1",
                               "revolution, counted from 0, in which status became 2 or 3; -1 elsewhere",
                               [](Run run) { return run.failed_revolution; });
  writer.per_run<std::uint8_t>("class", "1",
                               "class of the motion: its period in revolutions; 0 none, 254 unresolved, 255 "
                               "aperiodic",
                               [](Run run) { return run.motion; });
  writer.per_run<std::uint8_t>("region", "1", "region in which the point lies; 0: none",
                               [](Run run) { return run.region; });
  writer.per_run<double>("max_displacement", "m",
                         "largest displacement of the shaft centre over the sampled revolutions",
                         [](Run run) { return run.max_displacement; });
}

void write_trajectories(Writer& writer, const settings::Scene& scene, const AccuracyStudy& study) {
  const auto longest = [&](std::vector<motion::SectionState> AccuracyRun::*member) {
    std::size_t count = 0;
    for (const auto& run : study.runs) count = std::max(count, (run.*member).size());
    return count;
  };
  Dataset error = writer.per_run<double>(
      "trajectory_error", "1",
      "largest distance of the compared sections from those of the reference run, over the clearance",
      [](const AccuracyRun& run) { return run.trajectory_error; });
  error.set_text("comment",
                 "compared are the sampled sections where the point is predictable to the end, else the "
                 "leading sections within /horizon; distance: Euclidean norm over x, y, vx, vy");
  Dataset horizon = writer.per_point<std::int32_t>(
      "horizon", "1",
      "leading sections over which the reference run and one ten times less tight agree; as many as the "
      "protocol has revolutions: predictable to the end",
      [](const AccuracyPoint& point) { return point.horizon; });
  horizon.set_number("tolerance", study.horizon_tolerance);
  writer.starts();
  const Dataset first = writer.scale({"first_section", counted(longest(&AccuracyRun::first_sections), 1), "1",
                                      "revolutions since the point started"});
  writer.sections("first_sections", "state at phase 0 after the first revolutions", first,
                  &AccuracyRun::first_sections);
  const std::size_t kept = longest(&AccuracyRun::last_sections);
  const int revolutions = scene.protocol.transient_revolutions + scene.protocol.sampled_revolutions;
  const Dataset last = writer.scale({"last_section", counted(kept, revolutions - static_cast<int>(kept) + 1),
                                     "1", "revolutions since the point started"});
  writer.sections("last_sections", "state at phase 0 after the last revolutions", last,
                  &AccuracyRun::last_sections);
}

}  // namespace

void write_accuracy(const Output& output, const settings::Scene& scene, const std::string& scene_text,
                    const AccuracyStudy& study, const Software& software) {
  Publication publication(output);
  File file = File::create(publication.name());
  write_provenance(file.root(), software, FileKind::accuracy, scene);
  Object root = file.root();
  root.set_number<std::int32_t>("reference_setting", 0);
  root.set_number<std::int32_t>("repeats", study.repeats);
  root.set_number<double>("displacement_tolerance", study.displacement_tolerance);
  root.set_text("comment",
                "everything is a function of scene, options and build, but for cpu_time_min and "
                "cpu_time_median, which are measured");
  root.close();
  file.create_text("/scene", scene_text).set_text("long_name", "the scene file, as it was given");
  file.create_text("/scene_resolved", settings::resolved_json(scene))
      .set_text("long_name", "the scene with every default and every axis value written out");
  {
    Writer writer(file, scene, study);
    write_settings(writer, study);
    write_map_changes(writer, study);
    write_times(writer);
    write_work(writer);
    write_motions(writer);
    write_trajectories(writer, scene, study);
  }
  file.close();
  publication.publish();
}

}  // namespace rubatlas::atlas
