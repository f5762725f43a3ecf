#include "mpi/commands/verify_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "atlas/atlas_reader.hpp"
#include "atlas/environment_error.hpp"
#include "atlas/final_states.hpp"
#include "atlas/header_checksum.hpp"
#include "atlas/row_checksum.hpp"
#include "atlas/schema.hpp"
#include "atlas/verify.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/say.hpp"
#include "mpi/version.hpp"
#include "plan/grid.hpp"
#include "plan/pieces.hpp"
#include "point/line_solver.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {
namespace {

/// Largest number of sentences about rows; further rows are only counted.
constexpr std::size_t kMostSentences = 10;

void say_of_rows(const std::vector<std::string>& sentences) {
  for (std::size_t i = 0; i < std::min(sentences.size(), kMostSentences); ++i) say_sentence(sentences[i]);
  if (sentences.size() > kMostSentences) {
    say_sentence(fmt::format("... and {} more rows", sentences.size() - kMostSentences));
  }
}

/// The wanted number of finished points, evenly spread over the grid.
std::vector<std::size_t> spread(const std::vector<std::uint8_t>& status, std::size_t wanted) {
  std::vector<std::size_t> finished;
  for (std::size_t point = 0; point < status.size(); ++point) {
    if (status[point] != 0) finished.push_back(point);
  }
  const std::size_t count = std::min(wanted, finished.size());
  std::vector<std::size_t> chosen;
  // The middles of equal stretches.
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(finished[(2 * i + 1) * finished.size() / (2 * count)]);
  return chosen;
}

/// Computes points of an atlas once more.
class Recomputation {
 public:
  explicit Recomputation(const atlas::AtlasReader& atlas)
      : atlas_(atlas),
        scene_(settings::parse_scene(atlas.scene_resolved(), "/scene_resolved")),
        schema_(atlas::schema_of(scene_)),
        grid_(scene_),
        pieces_(scene_),
        status_(atlas.status()),
        seam_(scene_.pieces ? atlas.seam() : std::vector<std::uint8_t>()),
        ends_(atlas.file(), schema_) {}

  /// Names of the datasets whose computed row differs from the stored one; empty where all bits agree.
  [[nodiscard]] std::string difference(std::size_t point) const {
    const plan::PointParameters parameters = grid_.parameters(point);
    const auto solver = assembly::make_line_solver(scene_, parameters, tables_);
    const auto start = start_of(point, *solver);
    const auto outcome = solver->run(parameters.speed_ratio, start.value_or(initial_of(parameters)));
    const auto seam = seam_.empty() ? plan::Seam::none : static_cast<plan::Seam>(seam_[point]);
    const atlas::Row row(schema_, {.restarted = !start, .seam = seam}, outcome);
    const auto datasets = schema_.summed_datasets();
    std::vector<std::string> different;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
      const auto stored = atlas::stored_checksum(atlas_, datasets[i]->name, point);
      if (stored != row.checksum(i)) different.push_back("/" + datasets[i]->name);
    }
    return fmt::format("{}", fmt::join(different, ", "));
  }

 private:
  [[nodiscard]] motion::PointStart initial_of(const plan::PointParameters& parameters) const {
    return assembly::initial_state(scene_, parameters);
  }

  /// Where a point started; empty: from its initial state.
  std::optional<motion::PointStart> start_of(std::size_t point, point::LineSolver& solver) const {
    if (!grid_.points_depend_on_each_other()) return std::nullopt;
    const std::size_t line = point / grid_.speed_count();
    const std::size_t place = point % grid_.speed_count();
    const std::size_t visit =
        grid_.direction(line) == plan::Direction::up ? place : grid_.speed_count() - 1 - place;
    if (visit == 0) return std::nullopt;
    if (is_first_of_its_run(point)) return end_of_run_before(line, visit, solver);
    const std::size_t before = grid_.point(line, visit - 1);
    if (status_[before] != static_cast<std::uint8_t>(ending::PointStatus::done)) return std::nullopt;
    return ends_.of(before);
  }

  /// Whether the point goes on from a point of its piece's own run that the atlas does not have.
  [[nodiscard]] bool is_first_of_its_run(std::size_t point) const {
    if (seam_.empty()) return false;
    const auto seam = static_cast<plan::Seam>(seam_[point]);
    return seam == plan::Seam::agrees || seam == plan::Seam::aperiodic;
  }

  /// Computes the run of a visit's piece from its beginning to the visit before.
  std::optional<motion::PointStart> end_of_run_before(std::size_t line, std::size_t visit,
                                                      point::LineSolver& solver) const {
    std::optional<motion::PointStart> end;
    const auto initial = initial_of(grid_.parameters(grid_.point(line, visit)));
    for (std::size_t i = pieces_.run_begin(pieces_.of_visit(visit)); i < visit; ++i) {
      const double speed_ratio = grid_.parameters(grid_.point(line, i)).speed_ratio;
      const auto outcome = solver.run(speed_ratio, end.value_or(initial));
      end.reset();
      if (outcome.status == ending::PointStatus::done) end.emplace(outcome.final_state, outcome.final_memory);
    }
    return end;
  }

  const atlas::AtlasReader& atlas_;
  settings::Scene scene_;
  atlas::Schema schema_;
  plan::Grid grid_;
  plan::Pieces pieces_;
  std::vector<std::uint8_t> status_;
  std::vector<std::uint8_t> seam_;  ///< empty where lines are not swept in pieces
  atlas::FinalStates ends_;
  std::shared_ptr<assembly::BladeTables> tables_ = assembly::make_blade_tables();
};

std::vector<std::string> recompute(const atlas::AtlasReader& atlas, const std::vector<std::size_t>& points) {
  const Recomputation again(atlas);
  std::vector<std::string> sentences;
  for (const std::size_t point : points) {
    if (const std::string different = again.difference(point); !different.empty()) {
      sentences.push_back(fmt::format("{}: computed again, the row at {} differs in {}",
                                      atlas.path().string(), atlas.place_of(point), different));
    }
  }
  return sentences;
}

void say_of_builds(const atlas::AtlasReader& atlas) {
  const std::string commit = atlas.file().root().text("git_commit");
  if (commit == software().git_commit) return;
  say_sentence(fmt::format(
      "{} was begun by commit {}, this is {}: rows that differ in their last digits are no damage",
      atlas.path().string(), commit, software().git_commit));
}

}  // namespace

int verify(const VerifyCommand& command) {
  const atlas::AtlasReader atlas(command.atlas);
  const std::string name = command.atlas.string();
  if (!atlas.has_checksums()) {
    throw atlas::EnvironmentError(fmt::format(
        "{} was begun by a version whose rows have no checksums: there is nothing to compare", name));
  }
  bool sound = true;
  if (const std::string damage = atlas::header_damage(command.atlas); !damage.empty()) {
    say_sentence(damage);
    sound = false;
  }
  std::vector<std::string> damaged;
  for (const std::size_t point : atlas::damaged_rows(atlas)) {
    damaged.push_back(fmt::format("{}: {}", name, atlas::damage_of(atlas, point)));
  }
  say_of_rows(damaged);
  sound = sound && damaged.empty();

  const auto status = atlas.status();
  const auto finished = status.size() - static_cast<std::size_t>(std::ranges::count(status, 0));
  std::string text = fmt::format("{}: {} of {} points have rows, and {} of these have their checksum", name,
                                 finished, status.size(), finished - damaged.size());
  if (command.recompute > 0) {
    const auto points = spread(status, command.recompute);
    const auto different = recompute(atlas, points);
    if (!different.empty()) say_of_builds(atlas);
    say_of_rows(different);
    sound = sound && different.empty();
    text += fmt::format("; {} of {} computed again have the same bits", points.size() - different.size(),
                        points.size());
  }
  print(text + "\n");
  return sound ? exit_code::kDone : exit_code::kEnvironment;
}

}  // namespace rubatlas::mpi
