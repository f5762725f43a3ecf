#include "mpi/job/run_record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "atlas/publish.hpp"

namespace rubatlas::mpi {
namespace {

/// First and last text of the file; between them each run has one paragraph.
const std::string kOpening = std::string(atlas::kRecordMark) + "\n";
constexpr const char* kClosing = "\n]}\n";

std::string utc(std::chrono::system_clock::time_point time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

/// "model name" of the first processor: the kind of machine whose atlases have equal bytes.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// A value as JSON on one line; bytes that are no UTF-8 (of a host's name) are replaced.
std::string json_line(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// There is no exit code while the run goes on.
std::string paragraph(const RunBeginning& beginning, const JobResult& result, std::optional<int> exit_code,
                      const atlas::Software& software) {
  const Standing& standing = result.standing;
  const motion::WorkCounts& work = result.work;
  const double rate =
      standing.seconds > 0.0 ? static_cast<double>(standing.computed) / standing.seconds : 0.0;
  std::string text = "  {\n";
  const auto put = [&](const char* key, const std::string& value) {
    text += fmt::format("{}    \"{}\": {}", text.size() > 4 ? ",\n" : "", key, value);
  };
  const std::string now = json_line(utc(std::chrono::system_clock::now()));
  put("started", json_line(utc(beginning.started)));
  put("updated", now);
  put("finished", exit_code ? now : "null");
  if (!beginning.part.is_whole()) put("part", json_line(plan::text_of(beginning.part)));
  put("resumed", beginning.resumed ? "true" : "false");
  put("exit_code", exit_code ? fmt::to_string(*exit_code) : "null");
  put("version", json_line(software.software_version));
  put("git_commit", json_line(software.git_commit));
  put("compiler", json_line(software.compiler));
  put("processor", json_line(processor()));
  put("ranks", fmt::to_string(beginning.hosts.size()));
  put("host_of_rank", json_line(beginning.hosts));
  put("points_of_rank", fmt::format("[{}]", fmt::join(result.points_of_rank, ", ")));
  const auto put_seconds = [&](const char* key, double RankTimes::*seconds) {
    std::vector<double> of_rank;
    for (const RankTimes& times : result.times_of_rank) of_rank.push_back(times.*seconds);
    put(key, fmt::format("[{:.3f}]", fmt::join(of_rank, ", ")));
  };
  put_seconds("busy_seconds_of_rank", &RankTimes::busy);
  put_seconds("writing_seconds_of_rank", &RankTimes::writing);
  put_seconds("processor_seconds_of_rank", &RankTimes::processor);
  put("points_total", fmt::to_string(standing.total));
  put("points_finished", fmt::to_string(standing.finished));
  put("points_outside_the_model", fmt::to_string(standing.outside));
  put("points_failed", fmt::to_string(standing.failed));
  put("points_computed", fmt::to_string(standing.computed));
  put("points_not_kept",
      fmt::to_string(std::reduce(result.points_of_rank.begin(), result.points_of_rank.end()) -
                     standing.computed));
  put("wall_seconds", fmt::format("{:.3f}", standing.seconds));
  put("points_per_second", fmt::format("{:.4g}", rate));
  put("right_hand_sides", fmt::to_string(work.right_hand_sides));
  put("steps", fmt::to_string(work.steps));
  put("rejected_steps", fmt::to_string(work.rejected_steps));
  put("touchdowns", fmt::to_string(work.touchdowns));
  put("liftoffs", fmt::to_string(work.liftoffs));
  put("slip_reversals", fmt::to_string(work.slip_reversals));
  put("slip_accumulations", fmt::to_string(work.slip_accumulations));
  put("gap_evaluations", fmt::to_string(work.gap_evaluations));
  return text + "\n  }";
}

/// The paragraphs of earlier runs in the file; empty when the file is missing or no record.
std::string earlier_paragraphs(const std::filesystem::path& path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string closing = kClosing;
  if (!text.starts_with(kOpening) || !text.ends_with(closing)) return {};
  return text.substr(kOpening.size(), text.size() - kOpening.size() - closing.size());
}

std::filesystem::path record_of(const std::filesystem::path& atlas) {
  return atlas.string() + ".run.json";
}

void write_record(const std::filesystem::path& path, const std::vector<std::string>& paragraphs) {
  atlas::publish_text({path, true}, fmt::format("{}{}{}", kOpening, fmt::join(paragraphs, ",\n"), kClosing));
}

}  // namespace

atlas::Output record_output(const std::filesystem::path& atlas,
                            const std::vector<std::filesystem::path>& read) {
  return atlas::permitted({record_of(atlas), atlas::FileKind::record, atlas::Existing::replace}, read);
}

void merge_records(const atlas::Output& output, const std::vector<std::filesystem::path>& parts) {
  std::vector<std::string> paragraphs;
  for (const auto& part : parts) {
    if (auto runs = earlier_paragraphs(record_of(part)); !runs.empty()) paragraphs.push_back(std::move(runs));
  }
  write_record(output.path, paragraphs);
}

RunRecord::RunRecord(atlas::Output output, RunBeginning beginning, atlas::Software software)
    : output_(std::move(output)),
      beginning_(std::move(beginning)),
      software_(std::move(software)),
      earlier_(beginning_.resumed ? earlier_paragraphs(output_.path) : std::string()) {}

void RunRecord::update(const JobResult& so_far) const {
  try {
    write(paragraph(beginning_, so_far, std::nullopt, software_));
  } catch (const std::runtime_error&) {
    return;
  }
}

void RunRecord::finish(const JobResult& result, int exit_code) const {
  write(paragraph(beginning_, result, exit_code, software_));
}

void RunRecord::write(const std::string& paragraph) const {
  write_record(output_.path, earlier_.empty() ? std::vector{paragraph} : std::vector{earlier_, paragraph});
}

}  // namespace rubatlas::mpi
