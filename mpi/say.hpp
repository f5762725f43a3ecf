/// Sentences on standard error.
#pragma once

#include <string_view>

namespace rubatlas::mpi {

/// Writes a text as it is. That nobody reads standard error any more is no reason to stop, and no error.
void say(std::string_view text);

/// "rubatlas: " and a sentence, on a line of its own. Texts from files may be in it: it is made printable.
void say_sentence(std::string_view sentence);

}  // namespace rubatlas::mpi
