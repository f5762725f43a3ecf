/// The command line as typed values. The names of commands and flags are known here only.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/displacement_limit.hpp"
#include "mpi/accuracy/accuracy_settings.hpp"
#include "mpi/commands/explain.hpp"
#include "mpi/commands/run.hpp"

namespace rubatlas::mpi {

/// `--help` and `--version`: a text for standard output.
struct PrintCommand {
  std::string text;
};

struct ExplainCommand {
  std::filesystem::path scene;
  double measured_for = kMeasuredSeconds;  ///< [s]: time for computing points and for timing effects
};

struct OrbitCommand {
  std::filesystem::path scene;
  std::vector<std::string> at;  ///< "name=value", one per parameter
  std::filesystem::path output;
  std::optional<std::filesystem::path> from;  ///< an atlas whose final state is the start
  bool overwrite = false;
};

struct BranchCommand {
  std::filesystem::path scene;
  std::vector<std::string> from;     ///< "name=value", one per parameter
  std::string along;                 ///< name of a quantity of the grid
  std::optional<double> to;          ///< where the branch ends, in its unit
  bool both = false;                 ///< and as far to the other side
  bool doubled = false;              ///< the branch that begins at the nearest period doubling, too
  std::optional<std::string> curve;  ///< kind of bifurcation that is followed in two quantities
  std::optional<std::string> in;     ///< the second of them
  std::vector<double> within;        ///< its limits
  int points = 2000;                 ///< most orbits of a branch
  std::filesystem::path output;
  bool overwrite = false;
};

struct AnalyseCommand {
  std::filesystem::path atlas;
  std::filesystem::path maps;
  std::optional<std::filesystem::path> table;
  std::optional<std::filesystem::path> edges;  ///< that `edges` has written
  bool overwrite = false;
  analysis::DisplacementLimit limit;
};

struct EdgesCommand {
  std::filesystem::path atlas;
  std::optional<std::filesystem::path> output;  ///< none: ATLAS_edges.h5 beside ATLAS.h5
  double resolution = 1e-6;                     ///< longest interval [-] of a sharp edge
  bool only_regions = false;                    ///< only edges at which a region begins or ends
  bool overwrite = false;
  ProgressStyle progress = ProgressStyle::automatic;
};

struct StatusCommand {
  std::filesystem::path atlas;
};

struct AccuracyCommand {
  std::filesystem::path scene;
  std::filesystem::path output;
  AccuracyLadders ladders;
  int repeats = 3;  ///< timed runs of each setting at each point
  bool overwrite = false;
  ProgressStyle progress = ProgressStyle::automatic;
};

struct VerifyCommand {
  std::filesystem::path atlas;
  std::size_t recompute = 0;  ///< number of rows that are computed again
};

struct MergeCommand {
  std::vector<std::filesystem::path> parts;  ///< atlases of parts
  std::filesystem::path output;
  bool overwrite = false;
};

struct PackCommand {
  std::filesystem::path atlas;
  std::filesystem::path output;
  bool overwrite = false;
};

using Command =
    std::variant<PrintCommand, RunOptions, ExplainCommand, OrbitCommand, BranchCommand, StatusCommand,
                 AnalyseCommand, EdgesCommand, AccuracyCommand, VerifyCommand, MergeCommand, PackCommand>;

/// Throws UsageError with one sentence.
Command parse_command_line(int argument_count, const char* const* arguments);

}  // namespace rubatlas::mpi
