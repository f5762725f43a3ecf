/// The statements P1 to P16 of the paper about its rotors. Reports and the README take them from this table.
#pragma once

#include <span>
#include <string_view>

namespace rubatlas::analysis {

struct PaperStatement {
  std::string_view name;    ///< P1 … P16
  std::string_view rotor;   ///< the rotor that it is about
  std::string_view claim;   ///< in short, with the paper's words for the motions
  std::string_view judged;  ///< the lines of an atlas on which it is judged
};

/// All, in the order of their numbers.
std::span<const PaperStatement> paper_statements();

/// The claim of the statement of that name; throws std::out_of_range for a name that is not in the table.
std::string_view claim_of(std::string_view name);

}  // namespace rubatlas::analysis
