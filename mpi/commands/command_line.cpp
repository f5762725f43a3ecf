#include "mpi/commands/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <type_traits>

#include "mpi/exit_code.hpp"
#include "mpi/version.hpp"
#include "settings/nearest.hpp"

namespace rubatlas::mpi {
namespace {

constexpr const char* kExamples = R"(
Examples:
  mpirun -n 4 rubatlas run jobs/damping.json -o damping.h5       an atlas on four cores
  rubatlas run jobs/quick.json -o quick.h5                       the same bytes without mpirun, on one
  mpirun -n 4 rubatlas run jobs/damping.json -o damping.h5 --resume
                                                                 what a stopped run has left open
  rubatlas status damping.h5                                     is it complete? exit code 75 where it is not
  rubatlas explain jobs/damping.json                             effects, grid, bytes and time beforehand
  rubatlas orbit jobs/rig.json --at speed_ratio=0.304 -o orbit.h5
  rubatlas orbit jobs/damping.json --at speed_ratio=0.5,damping_ratio=0.1 --from damping.h5 -o orbit.h5
  rubatlas branch jobs/default.json --from speed_ratio=0.62 --along speed_ratio --to 0.70 -o branch.h5
                                                                 the orbit at 0.62, stable or not, up to 0.70
  rubatlas analyse damping.h5 -o maps.h5 --table table.md        regions, triggers and sensitivities
  mpirun -n 4 rubatlas edges damping.h5 --to 1e-6                 edges between motions, into damping_edges.h5
  rubatlas analyse damping.h5 --edges damping_edges.h5 -o maps.h5 regions with the uncertainty of their ends
  rubatlas analyse damping.h5 --limit "2 mm" -o maps.h5          signs of rubbing before 2 mm are passed
  rubatlas accuracy jobs/accuracy.json -o accuracy.h5            error against time, method by method
  rubatlas verify damping.h5 --recompute 50                      checksums of all rows, 50 rows once more
  rubatlas run jobs/damping.json -o two.h5 --part 2/7            a seventh of the lines
  rubatlas merge one.h5 two.h5 three.h5 -o damping.h5            parts become one, the rest stays pending
  rubatlas pack damping.h5 -o packed.h5                          a smaller copy, for the archive

Exit codes: 0 done, every point was computed (some may have left the model: counted in the last line); 10 done,
but some points could not be integrated; 2 wrong call or scene; 3 disk, files or MPI refused; 75 stopped on
request, --resume goes on. Any other code is not ours: mpirun ends a job that is terminated with codes of its own.
)";

constexpr std::array<std::string_view, 11> kCommands{
    "run", "status", "explain", "orbit", "branch", "analyse", "edges", "accuracy", "verify", "merge", "pack"};
/// That an option is a number within these limits, whole where they are.
template <class Number>
CLI::Validator within(Number least, Number most) {
  const auto check = [=](const std::string& word) {
    const char* const kind = std::is_integral_v<Number> ? "whole number" : "number";
    Number number{};
    // Of what is no number no comparison is true.
    return CLI::detail::lexical_cast(word, number) && number >= least && number <= most
               ? std::string()
               : fmt::format("{} is no {} from {} to {}", word, kind, least, most);
  };
  return {check, ""};
}

/// In the order of the enumeration ProgressStyle.
constexpr std::array<std::string_view, 4> kProgressStyles{"auto", "bar", "plain", "off"};

ProgressStyle progress_style(const std::string& word) {
  const auto found = std::find(kProgressStyles.begin(), kProgressStyles.end(), word);
  if (found == kProgressStyles.end()) {
    throw UsageError(fmt::format("--progress {}: not one of {}; nearest: {}", word,
                                 fmt::join(kProgressStyles, ", "), settings::nearest(word, kProgressStyles)));
  }
  return static_cast<ProgressStyle>(found - kProgressStyles.begin());
}

analysis::DisplacementLimit displacement_limit(const std::string& text) {
  if (const auto limit = analysis::parse_limit(text)) return *limit;
  throw UsageError(fmt::format("--limit {}: not {}", text, analysis::kLimitAllowed));
}

constexpr std::array<std::string_view, 3> kOptions{"--help", "-h", "--version"};

/// A mistyped command or option gets a sentence of its own instead of "a subcommand is required".
void check_command(int argument_count, const char* const* arguments) {
  if (argument_count < 2) {
    throw UsageError(fmt::format("no command; commands are {}; rubatlas --help shows what is possible",
                                 fmt::join(kCommands, ", ")));
  }
  const std::string_view word = arguments[1];
  if (word.starts_with('-')) {
    if (std::ranges::find(kOptions, word) != kOptions.end()) return;
    throw UsageError(fmt::format("unknown option {}; before a command there are {}; commands are {}", word,
                                 fmt::join(kOptions, ", "), fmt::join(kCommands, ", ")));
  }
  if (std::find(kCommands.begin(), kCommands.end(), word) == kCommands.end())
    throw UsageError(fmt::format("unknown command {}; commands are {}; nearest: {}", word,
                                 fmt::join(kCommands, ", "), settings::nearest(word, kCommands)));
  // A word of a shell's variable that is not set would stand for the default of an option.
  for (int i = 2; i < argument_count; ++i) {
    if (std::string_view(arguments[i]).empty())
      throw UsageError(
          fmt::format("the word after {} is empty; a name or a value is wanted", arguments[i - 1]));
  }
}

/// The sentence of CLI11 without its line breaks, followed by a pointer to `--help`.
std::string sentence_of(const CLI::App& program, const CLI::ParseError& error) {
  std::string text = error.what();
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) text += ": a number is meant";
  const auto chosen = program.get_subcommands();
  const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
  return fmt::format("{}; rubatlas{} --help shows what is possible", text, command);
}

}  // namespace

Command parse_command_line(int argument_count, const char* const* arguments) {
  check_command(argument_count, arguments);
  CLI::App program("Atlas of the nonlinear vibrations of a misaligned rotor with rubbing blades.",
                   "rubatlas");
  program.set_version_flag("--version", version_text(), "Print version, commit, compiler and libraries");
  program.require_subcommand(1);

  RunOptions run_options;
  auto* run = program.add_subcommand("run", "Compute the atlas of a scene; alone or under mpirun");
  run->add_option("SCENE", run_options.scene, "Scene file (JSON)")->required();
  run->add_option("-o,--output", run_options.atlas, "Atlas to write (HDF5)")->required();
  auto* resume =
      run->add_flag("--resume", run_options.resume, "Complete an atlas, or begin it where there is none");
  run->add_flag("--overwrite", run_options.overwrite, "Replace an existing atlas; no other file")
      ->excludes(resume);
  std::string part;
  run->add_option("--part", part, "Compute part K of N only, consecutive lines, into an atlas of its own")
      ->type_name("K/N");
  std::string progress = "auto";
  const auto add_progress = [&](CLI::App* command) {
    command->add_option("--progress", progress, "auto, bar, plain or off; auto is a bar on a terminal")
        ->type_name("STYLE");
  };
  add_progress(run);
  // For tests that kill runs: the time between the rows and their statuses. The option is in no group, so
  // that
  // --help does not show it.
  run->add_option("--batch-milliseconds", run_options.batch_milliseconds)->group("");
  run->add_flag("--dry-run", run_options.dry_run, "Check scene, disk and output, explain, and stop");

  StatusCommand status_command;
  auto* status =
      program.add_subcommand("status", "Say how far an atlas is; exit code 0, 10 or 75, as of its run");
  status->add_option("ATLAS", status_command.atlas, "Atlas (HDF5)")->required();

  ExplainCommand explain_command;
  auto* explain = program.add_subcommand("explain", "Say what a scene would compute, and what it would cost");
  explain->add_option("SCENE", explain_command.scene, "Scene file (JSON)")->required();
  explain
      ->add_option("--measure", explain_command.measured_for,
                   fmt::format("How long points are tried and effects timed; default: {}", kMeasuredSeconds))
      ->check(within(0.0, 3600.0))
      ->type_name("SECONDS");

  OrbitCommand orbit_command;
  auto* orbit =
      program.add_subcommand("orbit", "Compute one point in full: time, state, force on each blade");
  orbit->add_option("SCENE", orbit_command.scene, "Scene file (JSON)")->required();
  orbit
      ->add_option(
          "--at", orbit_command.at,
          "Where: name=value[,name=value]; speed_ratio, damping_ratio, friction, unbalance, thickness, "
          "further axes of the scene's grid, direction (up or down, with --from)")
      ->delimiter(',')
      ->type_name("NAME=VALUE");
  orbit->add_option("-o,--output", orbit_command.output, "Orbit to write (HDF5)")->required();
  orbit->add_option("--from", orbit_command.from,
                    "Atlas of the scene: start from its final state at this point");
  orbit->add_flag("--overwrite", orbit_command.overwrite, "Replace an existing orbit; no other file");

  BranchCommand branch_command;
  auto* branch = program.add_subcommand(
      "branch", "Follow periodic orbits along a quantity, stable or not, and locate bifurcations");
  branch->add_option("SCENE", branch_command.scene, "Scene file (JSON)")->required();
  branch
      ->add_option(
          "--from", branch_command.from,
          "Where it starts: name=value[,name=value], as --at of orbit; the motion from /initial there")
      ->delimiter(',')
      ->type_name("NAME=VALUE");
  branch->add_option("--along", branch_command.along, "Quantity of the grid that varies, such as speed_ratio")
      ->required();
  branch
      ->add_option("--to", branch_command.to,
                   "Where it ends; default: both ways, over the scene's grid, or as far as it goes")
      ->type_name("VALUE");
  branch->add_flag("--both", branch_command.both, "As far to the other side, too");
  branch->add_flag("--switch", branch_command.doubled,
                   "At the period doubling nearest to --from follow the branch of twice the period, in blade "
                   "passings, too");
  branch
      ->add_option("--curve", branch_command.curve,
                   "Follow the bifurcation of this kind that is nearest to --from in two quantities: fold, "
                   "period_doubling or neimark_sacker")
      ->type_name("KIND");
  branch->add_option("--in", branch_command.in, "The second quantity of a curve")->type_name("NAME");
  branch->add_option("--within", branch_command.within, "Limits of the second quantity: LOW HIGH")
      ->expected(2)
      ->type_name("VALUE");
  branch
      ->add_option("--points", branch_command.points, "Most orbits of a branch, to each side; default: 2000")
      ->check(within(2, 1000000));
  branch->add_option("-o,--output", branch_command.output, "Branch to write (HDF5)")->required();
  branch->add_flag("--overwrite", branch_command.overwrite, "Replace an existing branch; no other file");

  AnalyseCommand analyse_command;
  auto* analyse =
      program.add_subcommand("analyse", "Classes, regions, triggers and sensitivities of an atlas");
  analyse->add_option("ATLAS", analyse_command.atlas, "Atlas (HDF5)")->required();
  analyse->add_option("-o,--output", analyse_command.maps, "Maps to write (HDF5)")->required();
  analyse->add_option("--table", analyse_command.table, "Write the table to this file too (Markdown)");
  analyse->add_option(
      "--edges", analyse_command.edges,
      "Edges of the atlas, as rubatlas edges writes them: the table quotes their uncertainty");
  std::optional<std::string> limit;
  analyse
      ->add_option(
          "--limit", limit,
          "Displacement from equilibrium before which signs of rubbing in the spectrum are looked for: a "
          "number with its unit, m, mm, um, µm or clearances, such as \"2 mm\"; default: 0.5 clearances")
      ->type_name("\"NUMBER UNIT\"");
  analyse->add_flag("--overwrite", analyse_command.overwrite,
                    "Replace existing maps and table; no other files");

  EdgesCommand edges_command;
  auto* edges = program.add_subcommand(
      "edges", "Narrow down where motions change along the speed, by new points; alone or under mpirun");
  edges->add_option("ATLAS", edges_command.atlas, "Atlas (HDF5)")->required();
  edges->add_option("-o,--output", edges_command.output,
                    "Edges to write (HDF5); default: ATLAS_edges.h5 beside ATLAS.h5");
  edges
      ->add_option("--to", edges_command.resolution,
                   "Longest interval of the speed ratio within which an edge is known; default: 1e-6")
      ->type_name("INTERVAL");
  edges->add_flag("--regions", edges_command.only_regions, "Only edges at which a region begins or ends");
  add_progress(edges);
  edges->add_flag("--overwrite", edges_command.overwrite, "Replace existing edges; no other file");

  AccuracyCommand accuracy_command;
  auto* accuracy =
      program.add_subcommand("accuracy", "Run a scene with every method and tolerance: what accuracy costs");
  accuracy->add_option("SCENE", accuracy_command.scene, "Scene file (JSON)")->required();
  accuracy->add_option("-o,--output", accuracy_command.output, "Study to write (HDF5)")->required();
  AccuracyLadders& ladders = accuracy_command.ladders;
  accuracy
      ->add_option("--methods", ladders.methods,
                   fmt::format("Of {}; default: all that take the scene's effects",
                               fmt::join(accuracy_methods(), ", ")))
      ->delimiter(',')
      ->type_name("NAME,...");
  const auto add_ladder = [&](const char* name, std::vector<double>& values, const char* meaning) {
    accuracy->add_option(name, values, meaning)->delimiter(',')->type_name("VALUE,...");
  };
  add_ladder(
      "--tolerances", ladders.tolerances,
      "Default: 1e-4, 1e-5 ... 1e-12; of paper four pairs of tolerance and increment; fixed reads none");
  add_ladder("--force-increments", ladders.force_increments, "In N, of paper, each with every tolerance");
  add_ladder("--steps", ladders.steps, "In dimensionless time, of fixed; default: 2e-2 ... 1e-3");
  accuracy
      ->add_option("--repeats", accuracy_command.repeats,
                   "Timed runs of each point, fewer where they are slow; default: 3")
      ->check(within(1, 1000));
  add_progress(accuracy);
  accuracy->add_flag("--overwrite", accuracy_command.overwrite, "Replace an existing study; no other file");

  VerifyCommand verify_command;
  auto* verify = program.add_subcommand("verify", "Check that the rows of an atlas are what was computed");
  verify->add_option("ATLAS", verify_command.atlas, "Atlas (HDF5)")->required();
  verify
      ->add_option(
          "--recompute", verify_command.recompute,
          "Compute so many rows again, spread over the grid; the build that made them has the same bits")
      ->check(within(0, 1000000000))
      ->type_name("ROWS");

  MergeCommand merge_command;
  auto* merge = program.add_subcommand("merge", "Make one atlas of the parts that run --part has computed");
  merge->add_option("PARTS", merge_command.parts, "Atlases of parts of one scene (HDF5)")->required();
  merge->add_option("-o,--output", merge_command.output, "Atlas to write (HDF5)")->required();
  merge->add_flag("--overwrite", merge_command.overwrite, "Replace an existing atlas; no other file");

  PackCommand pack_command;
  auto* pack = program.add_subcommand("pack", "Copy an atlas into compressed chunks, and check the copy");
  pack->add_option("ATLAS", pack_command.atlas, "Atlas (HDF5)")->required();
  pack->add_option("-o,--output", pack_command.output, "Packed atlas to write (HDF5)")->required();
  pack->add_flag("--overwrite", pack_command.overwrite, "Replace an existing atlas; no other file");

  program.footer(kExamples);

  try {
    program.parse(argument_count, arguments);
  } catch (const CLI::CallForHelp&) {
    return PrintCommand{program.help()};
  } catch (const CLI::CallForVersion&) {
    return PrintCommand{version_text()};
  } catch (const CLI::ParseError& error) {
    throw UsageError(sentence_of(program, error));
  }
  if (run->parsed()) {
    if (!part.empty()) {
      run_options.part = plan::read_part(part);
      if (!run_options.part)
        throw UsageError(fmt::format("--part {}: not K/N with K from 1 to N, such as 2/8", part));
    }
    run_options.progress = progress_style(progress);
    if (run_options.batch_milliseconds < 0) {
      throw UsageError(
          fmt::format("--batch-milliseconds {}: a time, 0 at least", run_options.batch_milliseconds));
    }
    run_options.words.assign(arguments, arguments + argument_count);
    return run_options;
  }
  if (status->parsed()) return status_command;
  if (explain->parsed()) return explain_command;
  if (orbit->parsed()) return orbit_command;
  if (branch->parsed()) return branch_command;
  if (verify->parsed()) return verify_command;
  if (merge->parsed()) return merge_command;
  if (pack->parsed()) return pack_command;
  if (edges->parsed()) {
    edges_command.progress = progress_style(progress);
    return edges_command;
  }
  if (accuracy->parsed()) {
    accuracy_command.progress = progress_style(progress);
    return accuracy_command;
  }
  if (limit) analyse_command.limit = displacement_limit(*limit);
  return analyse_command;
}

}  // namespace rubatlas::mpi
