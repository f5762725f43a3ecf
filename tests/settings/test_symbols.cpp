// A symbol of the model where a key belongs is answered with the key that has it.
#include <gtest/gtest.h>

#include <string>

#include "scene_error_text.hpp"
#include "settings/quantity.hpp"
#include "settings/symbol.hpp"

namespace rubatlas::settings {
namespace {

/// What the refusal of a key ends with.
std::string answer_to(const std::string& key, const std::string& section = {}) {
  const std::string entry = "\"" + key + "\": 0.1";
  const auto text = section == "grid" ? refusal_of_grid(entry + ", \"speed_ratio\": 0.5")
                    : section.empty() ? refusal_with(entry)
                                      : refusal_with("\"" + section + "\": {" + entry + "}");
  return text.substr(text.rfind("; ") + 2);
}

TEST(Symbols, AreAnsweredWithTheKeyThatHasThem) {
  EXPECT_EQ(answer_to("zeta"), "the symbol ζ is that of /rotor/damping_ratio");
  EXPECT_EQ(answer_to("zeta", "rotor"), "the symbol ζ is that of /rotor/damping_ratio");
  EXPECT_EQ(answer_to("mu", "contact"), "the symbol μ is that of /contact/friction");
  EXPECT_EQ(answer_to("omega"), "the symbol Ω is that of /grid/speed_ratio");
  EXPECT_EQ(answer_to("E", "blades"), "the symbol E is that of /blades/youngs_modulus");
  EXPECT_EQ(answer_to("R", "ring"), "the symbol R is that of /ring/radius");
  EXPECT_EQ(answer_to("me", "unbalance"), "the symbol me is that of /unbalance/moment");
  EXPECT_EQ(answer_to("h", "blades"), "the symbol h is that of /blades/thickness");
  EXPECT_EQ(answer_to("L", "blades"), "the symbol L is that of /blades/length");
  EXPECT_EQ(answer_to("omega_n", "rotor"), "the symbol ωn is that of /rotor/natural_frequency");
  EXPECT_EQ(answer_to("m", "rotor"), "the symbol m is that of /rotor/mass");
  EXPECT_EQ(answer_to("kr", "ring"), "the symbol kr is that of /ring/stiffness");
}

TEST(Symbols, MayBeWrittenInGreek) {
  EXPECT_EQ(answer_to("ζ", "rotor"), "the symbol ζ is that of /rotor/damping_ratio");
  EXPECT_EQ(answer_to("Ω", "grid"), "the symbol Ω is that of /grid/speed_ratio");
  EXPECT_EQ(answer_to("ω"), "the symbol Ω is that of /grid/speed_ratio");
  EXPECT_EQ(answer_to("\\\\zeta"), "the symbol ζ is that of /rotor/damping_ratio");
  EXPECT_EQ(meaning_of_symbol("µ"), "the symbol μ is that of /contact/friction") << "the micro sign";
}

TEST(Symbols, OnTheGridAreThoseOfItsAxes) {
  EXPECT_EQ(answer_to("zeta", "grid"), "the symbol ζ is that of /grid/damping_ratio");
  EXPECT_EQ(answer_to("mu", "grid"), "the symbol μ is that of /grid/friction");
  EXPECT_EQ(answer_to("me", "grid"), "the symbol me is that of /grid/unbalance");
  EXPECT_EQ(answer_to("m", "grid"), "the symbol m is that of /rotor/mass");
  EXPECT_EQ(answer_to("/rotor/zeta", "grid"), "the symbol ζ is that of /grid/damping_ratio");
}

TEST(Symbols, OfTheSectionComeBeforeOthersAndTheSameCaseBeforeTheOther) {
  EXPECT_EQ(answer_to("r", "ring"), "the symbol R is that of /ring/radius");
  EXPECT_EQ(answer_to("r", "speed_ramp"), "the symbol r is that of /speed_ramp/rate");
  EXPECT_EQ(answer_to("alpha", "gravity"), "the symbol α is that of /gravity/direction");
  EXPECT_EQ(answer_to("alpha"), "the symbol α is that of /gravity/direction, /side_load/direction");
}

TEST(Symbols, ThatAreNoKeySayWhatTheyFollowFrom) {
  EXPECT_EQ(answer_to("k", "rotor"), "k = m ωn² follows from /rotor/mass and /rotor/natural_frequency");
  EXPECT_EQ(answer_to("e", "unbalance"), "the eccentricity e stands in /unbalance/moment, me = m e");
  EXPECT_EQ(answer_to("delta_c"),
            "the clearance δc = R − rh − L follows from /ring/radius, /blades/hub_radius and /blades/length");
}

TEST(Symbols, EveryOneOfTheTableIsKnownInItsSection) {
  for (const auto& entry : quantities()) {
    if (entry.symbol.empty()) continue;
    const auto meaning = meaning_of_symbol(entry.symbol, entry.section());
    EXPECT_NE(meaning.find("is that of"), std::string::npos) << entry.symbol;
    EXPECT_NE((meaning + ",").find(std::string(entry.section() == "/grid" ? "/grid/" : entry.pointer)),
              std::string::npos)
        << entry.pointer << ": " << meaning;
  }
}

TEST(Symbols, AWordThatIsNoneIsLeftToItsSpelling) {
  EXPECT_EQ(meaning_of_symbol("dampign_ratio"), "");
  EXPECT_EQ(meaning_of_symbol(""), "");
  EXPECT_EQ(meaning_of_symbol("_"), "");
}

}  // namespace
}  // namespace rubatlas::settings
