#include "mpi/job/mailbox.hpp"

#define OMPI_SKIP_MPICXX 1  // the C interface only: MPI's own C++ one is gone from the standard
#include <mpi.h>

namespace rubatlas::mpi {

// A message of some hundred bytes is taken by the transport at once (eager protocol), so a blocking send does
// not wait for its receiver. MPI's default error handler ends the job.

void Mailbox::send_bytes(int rank, Tag tag, const void* payload, std::size_t size) {
  MPI_Send(payload, static_cast<int>(size), MPI_BYTE, rank, static_cast<int>(tag), MPI_COMM_WORLD);
}

std::optional<Envelope> Mailbox::peek() const {
  if (!parallel_) return std::nullopt;
  // A probe that finds nothing fetches what has come meanwhile, for the next one to find.
  constexpr int kProbes = 2;
  int arrived = 0;
  MPI_Status status;
  for (int probe = 0; probe < kProbes && arrived == 0; ++probe)
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
  if (arrived == 0) return std::nullopt;
  return Envelope{status.MPI_SOURCE, static_cast<Tag>(status.MPI_TAG)};
}

void Mailbox::receive_bytes(const Envelope& envelope, void* payload, std::size_t size) {
  MPI_Recv(payload, static_cast<int>(size), MPI_BYTE, envelope.source, static_cast<int>(envelope.tag),
           MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

}  // namespace rubatlas::mpi
