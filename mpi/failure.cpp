#include "mpi/failure.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <string_view>

#include "atlas/output.hpp"
#include "mpi/exit_code.hpp"
#include "scene/printable.hpp"
#include "scene/reader.hpp"

namespace rubatlas::mpi {

namespace {

/// Texts from files may be in it.
void say(std::string_view message) {
  fmt::print(stderr, "rubatlas: {}\n", scene::printable(message));
}

}  // namespace

int report_failure(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const scene::SceneError& error) {
    say(error.what());
    return exit_code::kUsage;
  } catch (const UsageError& error) {
    say(error.what());
    return exit_code::kUsage;
  } catch (const atlas::OutputRefusal& refusal) {
    say(refusal.what());
    return exit_code::kUsage;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "rubatlas: out of memory\n");
  } catch (const std::exception& error) {
    say(error.what());
  } catch (...) {
    fmt::print(stderr, "rubatlas: an unknown failure\n");
  }
  return exit_code::kEnvironment;
}

}  // namespace rubatlas::mpi
