/// The ranks of a job: MPI from its start to its end, or one process without MPI.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace rubatlas::mpi {

class Session {
 public:
  /// True when a launcher (mpirun, srun) started this process. Otherwise MPI is never initialised, which
  /// would cost half a second and need a working network for nothing.
  static bool started_by_launcher();

  /// Initialises MPI when started by a launcher.
  Session();
  /// Collective over all ranks.
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
  /// One text per rank, in order, on rank 0; none on the others.
  [[nodiscard]] std::vector<std::string> gather(const std::string& text) const;
  /// A barrier whose waiting ranks sleep instead of polling.
  void wait_for_all() const;
  /// Ends the job on all ranks, after an error that one rank alone has met. Without MPI it returns.
  void abort(int exit_code) const;

 private:
  bool parallel_ = false;
  int rank_ = 0;
  int size_ = 1;
};

/// Sleeps while there is nothing to do, because a rank that polls occupies its core: each time longer by a
/// quarter, so that no answer waits longer than a fifth of the time for which it has been waited for.
class Nap {
 public:
  void take();
  /// To be called after a message: the next sleep is short again.
  void reset() { length_ = kShortest; }

 private:
  static constexpr std::chrono::microseconds kShortest{50};
  static constexpr std::chrono::microseconds kLongest{5000};
  std::chrono::microseconds length_ = kShortest;
};

/// Tells when a repeated task is due again.
class Pace {
 public:
  explicit Pace(std::chrono::microseconds period) : period_(period) {}
  /// A call costs a look at the clock.
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
