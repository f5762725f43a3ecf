/// Sentences on standard error, and results on standard output.
#pragma once

#include <cstddef>
#include <string_view>

namespace rubatlas::mpi {

/// Writes a text unchanged. A reader of standard error that has gone is neither an error nor a reason to
/// stop.
void say(std::string_view text);

/// "rubatlas: " and a sentence, on a line of its own. The sentence may contain texts from files and is
/// therefore made printable.
void say_sentence(std::string_view sentence);

/// A line of a terminal that is written over again and again.
class RewrittenLine {
 public:
  void show(std::string_view text);
  /// What is said next begins on a line of its own.
  void leave();

 private:
  std::size_t columns_ = 0;
};

/// A result, on standard output. Throws atlas::EnvironmentError where that takes no more text: who asked for
/// the result has not got it.
void print(std::string_view text);

}  // namespace rubatlas::mpi
