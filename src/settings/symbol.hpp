/// The quantity that a user means who writes a symbol of the model in place of a key: "zeta", "ζ", "omega_n",
/// "me".
#pragma once

#include <string>
#include <string_view>

namespace rubatlas::settings {

/// "the symbol ζ is that of /rotor/damping_ratio", with the place in `section` where that is `/grid`; empty
/// for a word that is no symbol. Greek letters may be spelled out. A symbol of a quantity of the section
/// itself is preferred, then one spelled as in the table, then one that differs by case.
std::string meaning_of_symbol(std::string_view word, std::string_view section = {});

}  // namespace rubatlas::settings
