#include "mpi/failure.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "mpi/exit_code.hpp"
#include "scene/reader.hpp"

namespace rubatlas::mpi {

int report_failure(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const scene::SceneError& error) {
    fmt::print(stderr, "rubatlas: {}\n", error.what());
    return exit_code::kUsage;
  } catch (const UsageError& error) {
    fmt::print(stderr, "rubatlas: {}\n", error.what());
    return exit_code::kUsage;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "rubatlas: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "rubatlas: {}\n", error.what());
  } catch (...) {
    fmt::print(stderr, "rubatlas: an unknown failure\n");
  }
  return exit_code::kEnvironment;
}

}  // namespace rubatlas::mpi
