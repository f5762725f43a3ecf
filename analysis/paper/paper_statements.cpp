#include "analysis/paper/paper_statements.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace rubatlas::analysis {
namespace {

constexpr std::string_view kDefault = "default";
constexpr std::string_view kRig = "test rig";
constexpr std::string_view kOwnLine = "the line of the rotor's own parameters";

constexpr std::array kStatements{
    PaperStatement{
        .name = "P1",
        .rotor = kDefault,
        .claim = "region 1, periodic with small displacement, up to Ω = 1/3, where the displacement rises",
        .judged = kOwnLine},
    PaperStatement{.name = "P2",
                   .rotor = kDefault,
                   .claim = "then region 2, chaotic with periodic windows",
                   .judged = kOwnLine},
    PaperStatement{.name = "P3", .rotor = kDefault, .claim = "then region 3, periodic", .judged = kOwnLine},
    PaperStatement{.name = "P4",
                   .rotor = kDefault,
                   .claim = "region 4, chaotic, entered by a period doubling at Ω = 2/3",
                   .judged = "the same line, the doubling on the map over a blade passing"},
    PaperStatement{
        .name = "P5",
        .rotor = kDefault,
        .claim = "the global picture holds for ζ ≤ 0.15; low damping widens region 2, shortens region 3 and "
                 "opens small chaotic areas in region 1",
        .judged = "lines along the damping ratio"},
    PaperStatement{.name = "P6",
                   .rotor = kDefault,
                   .claim = "high damping attenuates regions 2 and 4 until they disappear",
                   .judged = "lines along the damping ratio"},
    PaperStatement{
        .name = "P7",
        .rotor = kDefault,
        .claim = "friction changes things only locally; chaos appears in region 1 for 0.01 ≤ μ ≤ 0.2",
        .judged = "lines along friction"},
    PaperStatement{
        .name = "P8",
        .rotor = kDefault,
        .claim =
            "small unbalance keeps the four regions; growing it (up to 1e-4 kg m) removes the trigger at "
            "2/3, makes region 3 chaotic and merges 2, 3 and 4; the trigger at 1/3 always stays",
        .judged = "lines along the unbalance"},
    PaperStatement{.name = "P9",
                   .rotor = kRig,
                   .claim =
                       "test rig with blades under 0.4 mm: the chaotic regions disappear, the rises of the "
                       "displacement at 1/3 and 2/3 stay",
                   .judged = "lines along the thickness"},
    PaperStatement{.name = "P10",
                   .rotor = kRig,
                   .claim = "test rig: periodic at Ω = 0.304 and 0.605, chaotic at 0.4 and 0.74",
                   .judged = kOwnLine},
    PaperStatement{
        .name = "P11",
        .rotor = kDefault,
        .claim = "waterfall: a high peak on the 3× line on entering region 2; region 2 broadband, centred "
                 "between the 1× and 2× lines",
        .judged = "not judged; `tools/rubatlas-plot waterfall ATLAS.h5 -o waterfall.png` draws it"},
    PaperStatement{
        .name = "P12",
        .rotor = "default with n blades",
        .claim =
            "another number of blades: the same picture with the speed scaled by it, triggers at 1/n and "
            "2/n",
        .judged = kOwnLine},
    PaperStatement{.name = "P13",
                   .rotor = "default in an elastic ring",
                   .claim =
                       "rigid blades on a massless elastic ring give the same global picture, whatever its "
                       "stiffness",
                   .judged = "lines along the ring's stiffness"},
    PaperStatement{
        .name = "P14",
        .rotor = kRig,
        .claim = "test rig as measured: region 1 at 0.137-0.333, chaotic at 0.181; region 2 at 0.35-0.55; "
                 "chaos at 0.55-0.58 inside region 3; region 4 at 0.65-0.80; displacement growing with Ω",
        .judged = kOwnLine},
    PaperStatement{.name = "P15",
                   .rotor = kRig,
                   .claim = "clearance and misalignment matter for the global picture only for thin blades",
                   .judged = "lines along thickness, ring radius and misalignment"},
    PaperStatement{
        .name = "P16",
        .rotor = "blade of the rig",
        .claim = "Fig. 2, the rig's blade: Euler load 42.0 N, δ quadratic and Δ linear in F at small F",
        .judged = "the closed form of the blade, no motion"},
};

}  // namespace

std::span<const PaperStatement> paper_statements() {
  return kStatements;
}

std::string_view claim_of(std::string_view name) {
  const auto found = std::ranges::find(kStatements, name, &PaperStatement::name);
  if (found == kStatements.end()) throw std::out_of_range("no statement " + std::string(name));
  return found->claim;
}

}  // namespace rubatlas::analysis
