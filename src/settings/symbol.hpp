/// Finds the quantity that a user means by a symbol of the model in place of a key: "zeta", "ζ", "omega_n",
/// "me".
#pragma once

#include <string>
#include <string_view>

namespace rubatlas::settings {

/// "the symbol ζ is that of /rotor/damping_ratio"; for the section `/grid` the text names the axis in place
/// of the quantity, where the axis has a name. Empty for a word that is no symbol. Greek letters may be
/// spelled out. A symbol of a quantity of the section itself is preferred, then one spelled as in the table,
/// then one that differs by case.
std::string meaning_of_symbol(std::string_view word, std::string_view section = {});

}  // namespace rubatlas::settings
