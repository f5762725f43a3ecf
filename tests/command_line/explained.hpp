/// What `explain` says, as a user reads it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "program.hpp"

namespace rubatlas::mpi {

/// Of a scene, with so many seconds to measure.
inline std::string explained(const std::string& scene, const std::string& seconds = "0.1") {
  const Workplace place;
  static_cast<void>(place.write("s.json", scene));
  const auto ending = place.rubatlas("explain s.json --measure " + seconds);
  EXPECT_EQ(ending.code, 0) << ending.messages;
  EXPECT_EQ(ending.messages, "");
  return ending.output;
}

/// The line of a text that begins with a name.
inline std::string line_of(const std::string& text, const std::string& name) {
  const auto at = text.find("\n  " + name + " ");
  return at == std::string::npos ? "no such line" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace rubatlas::mpi
