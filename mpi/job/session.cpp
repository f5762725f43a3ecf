#include "mpi/job/session.hpp"

#define OMPI_SKIP_MPICXX 1  // the C interface only: MPI's own C++ one is gone from the standard
#include <mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <thread>

#include "atlas/environment_error.hpp"

namespace rubatlas::mpi {
namespace {

/// An environment variable that Open MPI's mpirun sets for each rank.
constexpr const char* kOpenMpi = "OMPI_COMM_WORLD_SIZE";

}  // namespace

bool Session::started_by_launcher() {
  // Open MPI's mpirun; srun and prun (PMIx); srun --mpi=pmi2 and MPICH's mpiexec.
  constexpr std::array kMarks{kOpenMpi, "PMIX_RANK", "PMI_RANK"};
  return std::any_of(kMarks.begin(), kMarks.end(),
                     [](const char* name) { return std::getenv(name) != nullptr; });
}

std::string_view Session::launcher() {
  return std::getenv(kOpenMpi) != nullptr || std::getenv("SLURM_PROCID") == nullptr ? "mpirun" : "srun";
}

Session::Session() : parallel_(started_by_launcher()) {
  if (!parallel_) return;
  int provided = 0;
  // The thread that calls MPI is the only one.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SINGLE, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

void Session::require_one_job() const {
  if (size_ > 1 || std::getenv(kOpenMpi) != nullptr) return;
  const char* const task = std::getenv("SLURM_PROCID");
  const char* tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  if (tasks == nullptr) tasks = std::getenv("SLURM_NTASKS");
  if (task == nullptr || tasks == nullptr || std::strtol(tasks, nullptr, 10) <= 1) return;
  throw atlas::EnvironmentError(fmt::format(
      "this is task {} of the {} of a Slurm job, and none of them knows of the others: srun has started them "
      "without MPI; start the ranks with mpirun -n {}, or with srun --mpi=pmix where Slurm has it, and a "
      "single "
      "one with mpirun -n 1",
      task, tasks, tasks));
}

Session::~Session() {
  if (parallel_) MPI_Finalize();
}

int Session::broadcast(int value) const {
  if (parallel_) MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return value;
}

std::string Session::broadcast(const std::string& text) const {
  if (!parallel_) return text;
  std::string result = text;
  result.resize(static_cast<std::size_t>(broadcast(static_cast<int>(text.size()))));
  MPI_Bcast(result.data(), static_cast<int>(result.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
  return result;
}

std::vector<std::string> Session::gather(const std::string& text) const {
  if (!parallel_) return {text};
  const int length = static_cast<int>(text.size());
  std::vector<int> lengths(rank_ == 0 ? static_cast<std::size_t>(size_) : 0);
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::vector<int> places;
  int end = 0;
  for (const int one : lengths) {
    places.push_back(end);
    end += one;
  }
  std::string all(static_cast<std::size_t>(end), '\0');
  MPI_Gatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), places.data(), MPI_CHAR, 0,
              MPI_COMM_WORLD);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    texts.push_back(all.substr(static_cast<std::size_t>(places[i]), static_cast<std::size_t>(lengths[i])));
  }
  return texts;
}

void Session::wait_for_all() const {
  if (!parallel_) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  Nap nap;
  for (int arrived = 0; arrived == 0;) {
    MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
    if (arrived == 0) nap.take();
  }
}

void Session::abort(int exit_code) const {
  if (parallel_) MPI_Abort(MPI_COMM_WORLD, exit_code);
}

void Nap::take() {
  std::this_thread::sleep_for(length_);
  length_ = std::min(length_ + length_ / 4, kLongest);
}

}  // namespace rubatlas::mpi
