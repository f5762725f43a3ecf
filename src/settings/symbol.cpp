#include "settings/symbol.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "settings/document.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::settings {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;

/// Greek letters in the symbols of the table, and their names.
constexpr std::array kGreek{Pair{"α", "alpha"}, Pair{"β", "beta"},  Pair{"γ", "gamma"}, Pair{"δ", "delta"},
                            Pair{"ζ", "zeta"},  Pair{"μ", "mu"},    Pair{"µ", "mu"},    Pair{"ψ", "psi"},
                            Pair{"ω", "omega"}, Pair{"Ω", "Omega"}, Pair{"Δ", "Delta"}};

/// Symbols of the model that are not quantities of a scene, and the quantities that determine them.
constexpr std::array kDerived{
    Pair{"k", "k = m ωn² follows from /rotor/mass and /rotor/natural_frequency"},
    Pair{"c", "c = 2 ζ m ωn follows from /rotor/damping_ratio, /rotor/mass and /rotor/natural_frequency"},
    Pair{"e", "the eccentricity e stands in /unbalance/moment, me = m e"},
    Pair{"δc",
         "the clearance δc = R − rh − L follows from /ring/radius, /blades/hub_radius and "
         "/blades/length"}};

/// A symbol with its Greek letters spelled out and without "_": "omegan" for "ωn", "ω_n" and "omega_n".
std::string spelled_out(std::string_view symbol) {
  std::string result;
  while (!symbol.empty()) {
    const auto letter =
        std::ranges::find_if(kGreek, [&](const Pair& greek) { return symbol.starts_with(greek.first); });
    if (letter != kGreek.end()) {
      result += letter->second;
      symbol.remove_prefix(letter->first.size());
      continue;
    }
    if (symbol.front() != '_' && symbol.front() != '\\') result += symbol.front();
    symbol.remove_prefix(1);
  }
  return result;
}

std::string lower_case(std::string text) {
  for (char& letter : text) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return text;
}

/// Where a user has to write a quantity: under the name of its axis if the section is `grid` and the axis has
/// a name.
std::string place_of(const Quantity& entry, std::string_view section) {
  const auto axes = grid_axes();
  const auto own = std::ranges::find(axes, entry.pointer, &GridAxis::quantity);
  if (section == "/grid" && own != axes.end()) return child(section, own->name);
  return std::string(entry.pointer);
}

}  // namespace

std::string meaning_of_symbol(std::string_view word, std::string_view section) {
  const std::string wanted = spelled_out(word);
  const auto as_written = [&](std::string_view symbol) { return spelled_out(symbol) == wanted; };
  const auto but_for_case = [&](std::string_view symbol) {
    return lower_case(spelled_out(symbol)) == lower_case(wanted);
  };
  const auto answer = [&](bool of_section, const auto& same) {
    std::vector<std::string> places;
    std::string_view symbol;
    for (const auto& entry : quantities()) {
      if (entry.symbol.empty() || !same(entry.symbol) || (of_section && entry.section() != section)) continue;
      places.push_back(place_of(entry, section));
      symbol = entry.symbol;
    }
    return places.empty() ? std::string{}
                          : fmt::format("the symbol {} is that of {}", symbol, fmt::join(places, ", "));
  };
  if (wanted.empty()) return {};
  for (const bool of_section : {true, false}) {
    if (auto text = answer(of_section, as_written); !text.empty()) return text;
    if (of_section) {
      if (auto text = answer(true, but_for_case); !text.empty()) return text;
    }
  }
  for (const auto& [symbol, text] : kDerived) {
    if (as_written(symbol)) return std::string(text);
  }
  return answer(false, but_for_case);
}

}  // namespace rubatlas::settings
