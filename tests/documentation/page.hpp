/// Pages of the documentation, and the parts of them that the program writes.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace rubatlas::documentation {

/// A page, by its path in the project.
inline std::string text_of(const std::string& page) {
  std::ifstream file(std::string(RUBATLAS_SOURCE_DIR "/") + page);
  std::stringstream stream;
  stream << file.rdbuf();
  return stream.str();
}

/// What stands on a page between `<!-- NAME: begin -->` and `<!-- NAME: end -->`.
inline std::string between_marks(const std::string& page, const std::string& name) {
  const std::string text = text_of(page);
  const std::string begin = "<!-- " + name + ": begin -->\n";
  const auto first = text.find(begin);
  const auto last = text.find("<!-- " + name + ": end -->");
  if (first == std::string::npos || last == std::string::npos || last < first) {
    ADD_FAILURE() << page << ": the marks of " << name << " are missing";
    return {};
  }
  const auto from = first + begin.size();
  return text.substr(from, last - from);
}

}  // namespace rubatlas::documentation
