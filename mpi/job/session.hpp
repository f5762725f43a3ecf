/// The job's ranks: MPI from its start to its end, or one process without MPI.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace rubatlas::mpi {

class Session {
 public:
  /// True when a launcher (mpirun, srun) started this process. Alone, MPI is never initialised: that would
  /// cost half a second and would need a working network stack for nothing.
  static bool started_by_launcher();

  /// Initialises MPI when started by a launcher.
  Session();
  /// All ranks together.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Throws EnvironmentError where this is one of several tasks that srun has started without MPI: each would
  /// be a job of its own, and all would fill the same atlas.
  void require_one_job() const;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] bool is_parallel() const { return parallel_; }
  /// The command that starts ranks here: "mpirun" or "srun".
  [[nodiscard]] static std::string_view launcher();

  /// Rank 0's value and text, on every rank.
  [[nodiscard]] int broadcast(int value) const;
  [[nodiscard]] std::string broadcast(const std::string& text) const;
  /// One short text per rank, in order, on rank 0; empty elsewhere.
  [[nodiscard]] std::vector<std::string> gather(const std::string& text) const;
  /// Returns when all ranks are here; those that come early sleep instead of spinning.
  void wait_for_all() const;
  /// Ends the job on all ranks: for errors that one rank alone has met. Alone, returns.
  void abort(int exit_code) const;

 private:
  bool parallel_ = false;
  int rank_ = 0;
  int size_ = 1;
};

/// What a rank does when there is nothing to do: it sleeps, longer each time, since a polling rank burns its
/// core.
class Nap {
 public:
  void take();
  /// Something came: sleep shortly again.
  void reset() { length_ = kShortest; }

 private:
  static constexpr std::chrono::microseconds kShortest{50};
  static constexpr std::chrono::microseconds kLongest{5000};
  std::chrono::microseconds length_ = kShortest;
};

/// When it is time again for something that is to be done now and then.
class Pace {
 public:
  explicit Pace(std::chrono::microseconds period) : period_(period) {}
  /// Asking costs a look at the clock.
  bool is_due() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return false;
    next_ = now + period_;
    return true;
  }

 private:
  std::chrono::microseconds period_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

}  // namespace rubatlas::mpi
