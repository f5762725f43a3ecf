/// The built program, run in a directory of its own as a user would run it.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace rubatlas::mpi {

struct Ending {
  int code = -1;
  std::string output;
  std::string messages;
};

/// A directory of its own for one test, removed at its end.
class Workplace {
 public:
  Workplace() {
    std::string name = (std::filesystem::temp_directory_path() / "rubatlas_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = name;
  }
  ~Workplace() { std::filesystem::remove_all(path_); }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return path_ / name; }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path_ / name, std::ios::binary).rdbuf();
    return text.str();
  }
  [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }

  /// Runs a shell command here and keeps what it says.
  [[nodiscard]] Ending shell(const std::string& command) const {
    const std::string whole =
        "cd '" + path_.string() + "' && { " + command + "; } >stdout.txt 2>stderr.txt </dev/null";
    const int status = std::system(whole.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout.txt"), read("stderr.txt")};
  }
  /// The program with these arguments, as its user starts it.
  [[nodiscard]] Ending rubatlas(const std::string& arguments) const {
    return shell("env -u OMPI_COMM_WORLD_SIZE -u PMIX_RANK '" RUBATLAS_PROGRAM "' " + arguments);
  }
  /// The program, which is killed when it has used so much processor time [s].
  [[nodiscard]] Ending rubatlas_within(int seconds, const std::string& arguments) const {
    return shell("ulimit -t " + std::to_string(seconds) +
                 "; env -u OMPI_COMM_WORLD_SIZE -u PMIX_RANK '" RUBATLAS_PROGRAM "' " + arguments);
  }
  /// The program on several ranks.
  [[nodiscard]] Ending ranks(int count, const std::string& arguments) const {
    return shell("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n " +
                 std::to_string(count) + " '" RUBATLAS_PROGRAM "' " + arguments);
  }

 private:
  std::filesystem::path path_;
};

/// Two dampings, three speeds, few revolutions: an atlas in a moment.
inline const std::string kSmallScene = R"({"title": "small", "grid": {"speed_ratio": [0.3, 0.4, 0.5],
  "damping_ratio": [0.1, 0.2]}, "protocol": {"transient_revolutions": 4, "sampled_revolutions": 3}})";

}  // namespace rubatlas::mpi
