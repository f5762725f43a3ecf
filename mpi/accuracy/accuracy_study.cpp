#include "mpi/accuracy/accuracy_study.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

#include "analysis/rules/class.hpp"
#include "analysis/rules/scene_tolerances.hpp"
#include "assembly/make_line_solver.hpp"
#include "mpi/accuracy/accuracy_map.hpp"
#include "mpi/accuracy/accuracy_settings.hpp"
#include "plan/grid.hpp"
#include "plan/scene_of_line.hpp"

namespace rubatlas::mpi {
namespace {

using atlas::AccuracyPoint;
using atlas::AccuracyRun;
using atlas::AccuracySetting;
using atlas::AccuracyStudy;
using Sections = std::vector<motion::SectionState>;

/// Numbers of sections kept at the start and at the end of a run; the published reference data have as many.
constexpr int kFirstSections = 10;
constexpr int kLastSections = 11;
/// The looser one of the two tightest runs.
constexpr double kLooser = 10.0;
/// Two runs agree within this many times the looser one's tolerance. Errors of periodic motions stay within a
/// hundred tolerances. The error of a chaotic motion exceeds any bound, and another bound would move the
/// horizon by a few sections only.
constexpr double kAgreement = 1000.0;

/// No further repeats of a run after this time [s], since the time of a slow run is accurate enough.
constexpr double kEnoughTime = 0.3;

/// CPU time of this thread [s].
double cpu_time() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Euclidean distance of two states [m], as in the classes of motion.
double distance(const motion::SectionState& a, const motion::SectionState& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

Sections sections_of(const point::PointOutcome& outcome) {
  Sections sections;
  if (outcome.status != ending::PointStatus::done) return sections;
  const auto& row = outcome.rows[0];
  for (std::size_t i = 0; i + 4 <= row.size(); i += 4) {
    sections.push_back({row[i], row[i + 1], row[i + 2], row[i + 3]});
  }
  return sections;
}

/// The points of a scene, run by any setting from any state.
class Points {
 public:
  explicit Points(const settings::Scene& scene) : scene_(scene), grid_(scene) {
    // What revolutions cost is compared: every setting runs them all.
    scene_.protocol.settle = settings::Settle::never;
  }

  [[nodiscard]] const plan::Grid& grid() const { return grid_; }
  [[nodiscard]] int revolutions() const {
    return scene_.protocol.transient_revolutions + scene_.protocol.sampled_revolutions;
  }

  /// The point with the scene's own protocol.
  [[nodiscard]] settings::Scene protocol_of(const AccuracySetting& setting) const {
    return scene_with(setting, scene_);
  }

  /// A scene with the values that its swept quantities have at a point.
  [[nodiscard]] settings::Scene scene_of(const settings::Scene& scene, std::size_t point) const {
    return plan::scene_of_line(scene, grid_.parameters(point));
  }

  /// The first `count` revolutions, all sampled.
  [[nodiscard]] point::PointOutcome first_revolutions(const AccuracySetting& setting, std::size_t point,
                                                      const motion::PointStart& start, int count) const {
    settings::Scene scene = protocol_of(setting);
    scene.protocol.transient_revolutions = 0;
    scene.protocol.sampled_revolutions = count;
    return run(scene, point, start);
  }

  [[nodiscard]] point::PointOutcome run(const settings::Scene& scene, std::size_t point,
                                        const motion::PointStart& start) const {
    const auto parameters = grid_.parameters(point);
    return assembly::make_line_solver(scene, parameters, tables_)->run(parameters.speed_ratio, start);
  }

  /// Computes the same point up to `repeats` times; the outcome and the times.
  [[nodiscard]] point::PointOutcome timed(const settings::Scene& scene, std::size_t point,
                                          const motion::PointStart& start, int repeats,
                                          AccuracyRun& run) const {
    const auto parameters = grid_.parameters(point);
    const auto solver = assembly::make_line_solver(scene, parameters, tables_);
    std::vector<double> times;
    point::PointOutcome outcome;
    const double first_began = cpu_time();
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const double began = cpu_time();
      outcome = solver->run(parameters.speed_ratio, start);
      times.push_back(cpu_time() - began);
      if (cpu_time() - first_began > kEnoughTime) break;
    }
    std::sort(times.begin(), times.end());
    run.cpu_time_min = times.front();
    run.cpu_time_median = 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
    return outcome;
  }

 private:
  settings::Scene scene_;
  plan::Grid grid_;
  std::shared_ptr<assembly::BladeTables> tables_ = assembly::make_blade_tables();
};

/// The reference run of a point, with which all its runs are compared.
struct Reference {
  Sections all;      ///< after every revolution of the protocol; empty when the motion ended before
  Sections sampled;  ///< the sampled ones, which are the last
};

/// Leading sections of two runs that agree within `bound` [m].
std::int32_t agreeing(const Sections& a, const Sections& b, double bound) {
  std::int32_t count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (!(distance(a[i], b[i]) <= bound)) break;
    ++count;
  }
  return count;
}

double largest_distance(const Sections& a, const Sections& b, std::size_t count) {
  if (a.size() < count || b.size() < count || count == 0) return std::numeric_limits<double>::quiet_NaN();
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, distance(a[i], b[i]));
  return largest;
}

/// For each point its start, its reference run and its horizon.
class Study {
 public:
  Study(const settings::Scene& scene, const std::vector<AccuracySetting>& settings, int repeats)
      : scene_(scene), points_(scene) {
    study_.settings = settings;
    study_.repeats = repeats;
    study_.horizon_tolerance = kAgreement * kLooser * settings.front().tolerance;
    study_.points.resize(points_.grid().point_count());
    study_.runs.resize(settings.size() * study_.points.size());
    references_.resize(study_.points.size());
  }

  /// Follows the scene's sweep with the reference, point by point.
  void find_references() {
    const plan::Grid& grid = points_.grid();
    for (std::size_t line = 0; line < grid.line_count(); ++line) {
      const motion::PointStart from_initial =
          assembly::initial_state(scene_, grid.parameters(grid.point(line, 0)));
      motion::PointStart start = from_initial;
      for (std::size_t visit = 0; visit < grid.speed_count(); ++visit) {
        const std::size_t point = grid.point(line, visit);
        study_.points[point].start = start;
        const point::PointOutcome end = find_reference(point);
        const bool go_on = grid.points_depend_on_each_other() && end.status == ending::PointStatus::done;
        start = go_on ? motion::PointStart(end.final_state, end.final_memory) : from_initial;
      }
    }
  }

  void run(std::size_t setting, std::size_t point) {
    AccuracyRun& run = study_.runs[setting * study_.points.size() + point];
    const AccuracySetting& chosen = study_.settings[setting];
    const AccuracyPoint& at = study_.points[point];
    const settings::Scene scene = points_.protocol_of(chosen);
    const settings::Scene own = points_.scene_of(scene, point);
    const auto outcome = points_.timed(scene, point, at.start, study_.repeats, run);
    run.status = outcome.status;
    run.failed_revolution = outcome.failed_revolution;
    run.work = outcome.work;
    run.motion = analysis::classify(outcome.rows[0], analysis::closing_tolerance(own));
    run.max_displacement = outcome.rows[1][0];

    const bool to_the_end = at.horizon == points_.revolutions();
    const int first = std::min(points_.revolutions(), std::max(kFirstSections, to_the_end ? 0 : at.horizon));
    const Sections firsts = sections_of(points_.first_revolutions(chosen, point, at.start, first));
    const Sections sampled = sections_of(outcome);
    const Reference& reference = references_[point];
    const double error = to_the_end ? largest_distance(sampled, reference.sampled, sampled.size())
                                    : largest_distance(firsts, reference.all, at.horizon);
    run.trajectory_error = error / analysis::length_scale(own);
    run.first_sections.assign(firsts.begin(),
                              firsts.begin() + std::min<std::ptrdiff_t>(std::ssize(firsts), kFirstSections));
    run.last_sections.assign(sampled.end() - std::min<std::ptrdiff_t>(std::ssize(sampled), kLastSections),
                             sampled.end());
  }

  [[nodiscard]] const AccuracyRun& result(std::size_t setting, std::size_t point) const {
    return study_.run(setting, point);
  }

  [[nodiscard]] AccuracyStudy take() && {
    judge_maps(scene_, study_);
    return std::move(study_);
  }

 private:
  point::PointOutcome find_reference(std::size_t point) {
    AccuracySetting tight = study_.settings.front();
    AccuracySetting looser = tight;
    looser.tolerance *= kLooser;
    AccuracyPoint& at = study_.points[point];
    Reference& reference = references_[point];
    point::PointOutcome end = points_.first_revolutions(tight, point, at.start, points_.revolutions());
    reference.all = sections_of(end);
    const auto sampled =
        std::min<std::ptrdiff_t>(std::ssize(reference.all), scene_.protocol.sampled_revolutions);
    reference.sampled.assign(reference.all.end() - sampled, reference.all.end());
    const Sections other =
        sections_of(points_.first_revolutions(looser, point, at.start, points_.revolutions()));
    at.horizon = agreeing(reference.all, other,
                          study_.horizon_tolerance * analysis::length_scale(points_.scene_of(scene_, point)));
    return end;
  }

  settings::Scene scene_;
  Points points_;
  AccuracyStudy study_;
  std::vector<Reference> references_;
};

}  // namespace

AccuracyStudy study_accuracy(const settings::Scene& scene, const std::vector<AccuracySetting>& settings,
                             int repeats, const std::function<void(const AccuracyRun&)>& after_run) {
  Study study(scene, settings, repeats);
  study.find_references();
  const std::size_t points = plan::Grid(scene).point_count();
  for (std::size_t setting = 0; setting < settings.size(); ++setting) {
    for (std::size_t point = 0; point < points; ++point) {
      study.run(setting, point);
      after_run(study.result(setting, point));
    }
  }
  return std::move(study).take();
}

}  // namespace rubatlas::mpi
