// rubatlas: from a scene to an atlas, and from an atlas to its maps.
//
//   1. the command line becomes one typed command                      (command_line)
//   2. run      scene → plan → master ⇄ workers → solve → atlas        (run)
//      status   atlas → how far it is                                  (status_command)
//      explain  scene → plan → what it would be                        (explain)
//      orbit    scene → one point in full                              (orbit_command)
//      analyse  atlas → classes, regions, triggers, sensitivities      (analysis)
//      edges    atlas → new points → where motions change              (edges_command)
//      verify   atlas → are its rows what was computed?                (verify_command)
//      merge    atlases of parts → one atlas                           (merge_command)
//      pack     atlas → smaller copy                                   (pack_command)
//      accuracy scene → every method and tolerance → error and time    (accuracy_command)
//   3. whatever goes wrong becomes one message and an exit code        (failure)
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <variant>

#include "analysis/analyse.hpp"
#include "mpi/commands/accuracy_command.hpp"
#include "mpi/commands/branch_command.hpp"
#include "mpi/commands/command_line.hpp"
#include "mpi/commands/edges_command.hpp"
#include "mpi/commands/explain.hpp"
#include "mpi/commands/merge_command.hpp"
#include "mpi/commands/orbit_command.hpp"
#include "mpi/commands/pack_command.hpp"
#include "mpi/commands/run.hpp"
#include "mpi/commands/status_command.hpp"
#include "mpi/commands/verify_command.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/failure.hpp"
#include "mpi/job/session.hpp"
#include "mpi/say.hpp"
#include "settings/reader.hpp"
#include "settings/scene_file.hpp"

namespace rubatlas::mpi {
namespace {

int carry_out(const PrintCommand& command) {
  print(command.text);
  return exit_code::kDone;
}

int carry_out(const RunOptions& options) {
  return run(options);
}

int carry_out(const StatusCommand& command) {
  const atlas::AtlasReader atlas(command.atlas);
  const Standing standing = standing_of_atlas(atlas);
  print(status_sentence(atlas, standing) + "\n");
  return exit_code_of(standing);
}

/// Reading a long scene takes time, too.
int carry_out(const ExplainCommand& command) {
  const double begin = seconds_on_the_wall();
  const auto scene = settings::parse_scene(settings::read_text(command.scene), command.scene.string());
  const double measured_for = command.measured_for - (seconds_on_the_wall() - begin);
  print(explain(scene, std::max(measured_for, 0.25 * command.measured_for)));
  return exit_code::kDone;
}

int carry_out(const OrbitCommand& command) {
  return compute_orbit(command);
}

int carry_out(const BranchCommand& command) {
  return follow_branch(command);
}

int carry_out(const AnalyseCommand& command) {
  print(analysis::analyse(command.atlas, command.maps, command.table, command.overwrite, command.edges,
                          command.limit));
  return exit_code::kDone;
}

int carry_out(const EdgesCommand& command) {
  return find_edges(command);
}

int carry_out(const AccuracyCommand& command) {
  return compute_accuracy(command);
}

int carry_out(const VerifyCommand& command) {
  return verify(command);
}

int carry_out(const MergeCommand& command) {
  return merge(command);
}

int carry_out(const PackCommand& command) {
  return pack(command);
}

/// If the program is started with standard input, output or error closed, the next file that it opens takes
/// that number, and messages would be written into the file.
void open_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    // `open` returns the lowest free number, which is the one examined here, because all lower ones are open.
    if (::fcntl(descriptor, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) != descriptor)
      std::_Exit(exit_code::kEnvironment);
  }
}

/// A write beyond the limit of file sizes (ulimit -f) fails and is reported, instead of raising a signal.
void take_file_limits_as_errors() {
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Runs a command that needs one process. Under mpirun the first rank runs it, and all ranks end together
/// with its exit code, because a rank that ends early would make mpirun kill the first rank before its
/// message is printed.
template <typename Task>
int on_one_rank(Task task) {
  const Session session;
  int code = exit_code::kDone;
  if (session.rank() == 0) {
    try {
      code = task();
    } catch (...) {
      code = report_failure(std::current_exception());
    }
  }
  session.wait_for_all();
  return session.broadcast(code);
}

int carry_out_command_line(int argument_count, const char* const* arguments) {
  std::optional<Command> command;
  std::exception_ptr mistake;
  try {
    command = parse_command_line(argument_count, arguments);
  } catch (...) {
    mistake = std::current_exception();
  }
  if (command) {
    if (const auto* options = std::get_if<RunOptions>(&*command)) return run(*options);
    if (const auto* edges = std::get_if<EdgesCommand>(&*command)) return find_edges(*edges);
  }
  return on_one_rank([&] {
    if (mistake) std::rethrow_exception(mistake);
    return std::visit([](const auto& chosen) { return carry_out(chosen); }, *command);
  });
}

}  // namespace
}  // namespace rubatlas::mpi

int main(int argument_count, char** arguments) {
  rubatlas::mpi::open_standard_descriptors();
  rubatlas::mpi::take_file_limits_as_errors();
  try {
    return rubatlas::mpi::carry_out_command_line(argument_count, arguments);
  } catch (...) {
    return rubatlas::mpi::report_failure(std::current_exception());
  }
}
