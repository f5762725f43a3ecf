#include "mpi/failure.hpp"

#include <new>

#include "atlas/output.hpp"
#include "atlas/structure.hpp"
#include "mpi/exit_code.hpp"
#include "mpi/say.hpp"
#include "settings/reader.hpp"

namespace rubatlas::mpi {

int report_failure(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const settings::SceneError& error) {
    say_sentence(error.what());
    return exit_code::kUsage;
  } catch (const UsageError& error) {
    say_sentence(error.what());
    return exit_code::kUsage;
  } catch (const atlas::OutputRefusal& refusal) {
    say_sentence(refusal.what());
    return exit_code::kUsage;
  } catch (const atlas::WrongFile& wrong) {
    say_sentence(wrong.what());
    return exit_code::kUsage;
  } catch (const std::bad_alloc&) {
    say_sentence("out of memory");
  } catch (const std::exception& error) {
    say_sentence(error.what());
  } catch (...) {
    say_sentence("an unknown failure");
  }
  return exit_code::kEnvironment;
}

}  // namespace rubatlas::mpi
