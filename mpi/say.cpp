#include "mpi/say.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "atlas/environment_error.hpp"
#include "settings/printable.hpp"

namespace rubatlas::mpi {

void say(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
  static_cast<void>(std::fflush(stderr));
}

void say_sentence(std::string_view sentence) {
  say(fmt::format("rubatlas: {}\n", settings::printable(sentence)));
}

void RewrittenLine::show(std::string_view text) {
  const std::size_t erased = columns_ > text.size() ? columns_ - text.size() : 0;
  say(fmt::format("\r{}{:{}}", text, "", erased));
  columns_ = text.size();
}

void RewrittenLine::leave() {
  if (columns_ > 0) say("\n");
  columns_ = 0;
}

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw atlas::EnvironmentError("standard output takes no more text");
  }
}

}  // namespace rubatlas::mpi
