/// How often this program has asked for memory.
#pragma once

#include <cstddef>

namespace rubatlas::integrate {

/// Calls of the global operator new since the program started.
std::size_t allocations();

}  // namespace rubatlas::integrate
