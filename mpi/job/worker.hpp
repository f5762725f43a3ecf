/// A rank other than 0: asks for assignments and computes them until it is told to leave.
#pragma once

#include "mpi/job/mailbox.hpp"
#include "mpi/job/point_runner.hpp"

namespace rubatlas::mpi {

void work(const Mailbox& mailbox, PointRunner& runner);

}  // namespace rubatlas::mpi
