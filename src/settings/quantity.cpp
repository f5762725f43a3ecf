#include "settings/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "settings/place.hpp"

namespace rubatlas::settings {
namespace {

template <auto Member, ContactLaw... kLaws>
using UnderLaw = Under<At<&Scene::ring, Member>, &Scene::contact, &Contact::law, kLaws...>;
template <auto Member, Method... kReaders>
using UnderMethod = Under<At<&Scene::accuracy, Member>, &Scene::accuracy, &Accuracy::method, kReaders...>;

constexpr double kMostRevolutions = 1e8;
constexpr double kMostSamplesPerRevolution = 65536;
constexpr double kHighestOrder = 32768;
/// [m] Below any atom; powers of shorter lengths would vanish.
constexpr double kShortestLength = 1e-12;

constexpr std::string_view kDefaultRotor = "the paper's default rotor";

/// The table without the quantities of the effects, which are described in `effects/`.
const auto& own_table() {
  static const std::array entries{
      in({.pointer = "/title",
          .symbol = "",
          .unit = "",
          .meaning = "what this atlas is about",
          .source = "",
          .kind = Kind::text},
         At<&Scene::title>{}),
      in({.pointer = "/reference",
          .symbol = "",
          .unit = "",
          .meaning = "paper and section that the scene follows",
          .source = "",
          .kind = Kind::text},
         At<&Scene::reference>{}),
      in({.pointer = "/creator",
          .symbol = "",
          .unit = "",
          .meaning = "who makes this atlas, a person or an institution",
          .source = "",
          .kind = Kind::text,
          .default_rule = "absent"},
         At<&Scene::creator>{}),
      in({.pointer = "/license",
          .symbol = "",
          .unit = "",
          .meaning = "licence of this atlas, for example CC-BY-4.0",
          .source = "",
          .kind = Kind::text,
          .default_rule = "absent"},
         At<&Scene::license>{}),

      in({.pointer = "/rotor/mass",
          .symbol = "m",
          .unit = "kg",
          .meaning = "modal mass of the rotor",
          .source = kDefaultRotor,
          .range = above_zero_up_to(kHeaviestMass)},
         At<&Scene::rotor, &Rotor::mass>{}),
      in({.pointer = "/rotor/natural_frequency",
          .symbol = "ωn",
          .unit = "rad/s",
          .meaning = "undamped natural frequency of the shaft",
          .source = kDefaultRotor,
          .range = above_zero_up_to(1e6)},
         At<&Scene::rotor, &Rotor::natural_frequency>{}),
      in({.pointer = "/rotor/damping_ratio",
          .symbol = "ζ",
          .unit = "1",
          .meaning = "damping ratio of the shaft, share of critical",
          .source = kDefaultRotor,
          .range = between(0.0, 1e3)},
         At<&Scene::rotor, &Rotor::damping_ratio>{}),
      in({.pointer = "/rotor/misalignment",
          .symbol = "y0",
          .unit = "m",
          .meaning = "distance of the ring's centre below the shaft's equilibrium",
          .source = kDefaultRotor,
          .range = between(-kLongestLength, kLongestLength)},
         At<&Scene::rotor, &Rotor::misalignment>{}),

      in({.pointer = "/blades/count",
          .symbol = "n",
          .unit = "1",
          .meaning = "number of equally spaced blades",
          .source = kDefaultRotor,
          .kind = Kind::whole_number,
          .range = between(1, 50)},
         At<&Scene::blades, &Blades::count>{}),
      in({.pointer = "/blades/length",
          .symbol = "L",
          .unit = "m",
          .meaning = "length of a blade from hub to tip",
          .source = kDefaultRotor,
          .range = between(kShortestLength, kLongestLength)},
         At<&Scene::blades, &Blades::length>{}),
      in({.pointer = "/blades/width",
          .symbol = "b",
          .unit = "m",
          .meaning = "width of a blade along the shaft",
          .source = kDefaultRotor,
          .range = between(kShortestLength, kLongestLength)},
         At<&Scene::blades, &Blades::width>{}),
      in({.pointer = "/blades/thickness",
          .symbol = "h",
          .unit = "m",
          .meaning = "thickness of a blade in its plane of bending",
          .source = kDefaultRotor,
          .range = between(kShortestLength, kLongestLength)},
         At<&Scene::blades, &Blades::thickness>{}),
      in({.pointer = "/blades/youngs_modulus",
          .symbol = "E",
          .unit = "Pa",
          .meaning = "Young's modulus of a blade",
          .source = kDefaultRotor,
          .range = above_zero_up_to(1e15)},
         At<&Scene::blades, &Blades::youngs_modulus>{}),
      in({.pointer = "/blades/hub_radius",
          .symbol = "rh",
          .unit = "m",
          .meaning = "radius of the hub on which the blades are clamped",
          .source = kDefaultRotor,
          .range = between(0.0, kLongestLength)},
         At<&Scene::blades, &Blades::hub_radius>{}),

      in({.pointer = "/ring/radius",
          .symbol = "R",
          .unit = "m",
          .meaning = "inner radius of the ring",
          .source = kDefaultRotor,
          .range = between(kShortestLength, kLongestLength)},
         At<&Scene::ring, &Ring::radius>{}),
      in({.pointer = "/ring/stiffness",
          .symbol = "kr",
          .unit = "N/m",
          .meaning = "stiffness of the massless ring under a tip, law elastic_ring only",
          .source = "not in the paper: 100 shaft stiffnesses of the default rotor",
          .range = above_zero_up_to(1e15),
          .chooser = "/contact/law"},
         UnderLaw<&Ring::stiffness, ContactLaw::elastic_ring>{}),

      in({.pointer = "/contact/law",
          .symbol = "",
          .unit = "",
          .meaning =
              "elastica: elastic blades in a rigid ring; elastic_ring: rigid blades in an elastic ring; "
              "beam_column: as elastica with small slopes",
          .source = "the paper, and the authors' earlier model",
          .kind = Kind::choice,
          .choices = kContactLaws},
         At<&Scene::contact, &Contact::law>{}),
      in({.pointer = "/contact/friction",
          .symbol = "μ",
          .unit = "1",
          .meaning = "Coulomb coefficient between blade tip and ring",
          .source = kDefaultRotor,
          .range = between(0.0, 2.0)},
         At<&Scene::contact, &Contact::friction>{}),

      Quantity{.pointer = "/grid/speed_ratio",
               .symbol = "Ω",
               .unit = "1",
               .meaning = "speed ratio, spin speed over natural frequency",
               .source = "the paper, equation of motion",
               .range = between(1e-4, 1e3),
               .default_rule = "none: every scene says it"},

      in({.pointer = "/sweep",
          .symbol = "",
          .unit = "",
          .meaning = "where a point starts: from its lower neighbour in speed, its upper one, both, or from "
                     "`initial`",
          .source = "the paper's protocol",
          .kind = Kind::choice,
          .choices = kSweeps},
         At<&Scene::sweep>{}),

      in({.pointer = "/pieces/points",
          .symbol = "",
          .unit = "1",
          .meaning = "points of a piece of a line",
          .source = "`jobs/studies/pieces.md`",
          .kind = Kind::whole_number,
          .range = between(1, 1e6),
          .default_rule = "48; where the section is absent only lines above 256 points are cut, of scenes "
                          "of fewer than 128 lines; none where it is null"},
         At<&Scene::pieces, &Pieces::points>{}),
      in({.pointer = "/pieces/lead_in",
          .symbol = "",
          .unit = "1",
          .meaning = "points before a piece that are swept from initial to lead into it, and not kept",
          .source = "`jobs/studies/pieces.md`",
          .kind = Kind::whole_number,
          .range = between(0, 1e6),
          .default_rule = "0"},
         At<&Scene::pieces, &Pieces::lead_in>{}),

      in({.pointer = "/initial/x",
          .symbol = "x",
          .unit = "m",
          .meaning = "horizontal displacement at the start",
          .source = "the paper's protocol",
          .range = between(-kLongestLength, kLongestLength)},
         At<&Scene::initial, &Initial::x>{}),
      in({.pointer = "/initial/y",
          .symbol = "y",
          .unit = "m",
          .meaning = "vertical displacement at the start",
          .source = "the paper's protocol",
          .range = between(-kLongestLength, kLongestLength)},
         At<&Scene::initial, &Initial::y>{}),
      in({.pointer = "/initial/vx",
          .symbol = "x'",
          .unit = "m",
          .meaning = "horizontal velocity at the start, per unit of dimensionless time",
          .source = "the paper's protocol",
          .range = between(-kLongestLength, kLongestLength)},
         At<&Scene::initial, &Initial::vx>{}),
      in({.pointer = "/initial/vy",
          .symbol = "y'",
          .unit = "m",
          .meaning = "vertical velocity at the start, per unit of dimensionless time",
          .source = "the paper's protocol",
          .range = between(-kLongestLength, kLongestLength)},
         At<&Scene::initial, &Initial::vy>{}),

      in({.pointer = "/protocol/transient_revolutions",
          .symbol = "",
          .unit = "1",
          .meaning = "revolutions run before anything is kept",
          .source = "the paper's protocol",
          .kind = Kind::whole_number,
          .range = between(0, kMostRevolutions)},
         At<&Scene::protocol, &Protocol::transient_revolutions>{}),
      in({.pointer = "/protocol/sampled_revolutions",
          .symbol = "S",
          .unit = "1",
          .meaning = "revolutions of which sections, spectrum and extremes are kept",
          .source = "the paper's protocol",
          .kind = Kind::whole_number,
          .range = between(1, 1e6)},
         At<&Scene::protocol, &Protocol::sampled_revolutions>{}),
      in({.pointer = "/protocol/samples_per_revolution",
          .symbol = "",
          .unit = "1",
          .meaning = "samples per revolution of spectrum and orbit",
          .source = "20 samples on the highest default order",
          .kind = Kind::whole_number,
          .range = between(2, kMostSamplesPerRevolution)},
         At<&Scene::protocol, &Protocol::samples_per_revolution>{}),
      in({.pointer = "/protocol/settle",
          .symbol = "",
          .unit = "",
          .meaning = "newton: a motion that approaches a cycle ends its transient on it, where Newton's "
                     "method finds it, and one period is computed and repeated; never: all revolutions run",
          .source = "periodic motions are a large part of an atlas",
          .kind = Kind::choice,
          .choices = kSettles},
         At<&Scene::protocol, &Protocol::settle>{}),

      in({.pointer = "/spectrum/max_order",
          .symbol = "",
          .unit = "1",
          .meaning = "highest order of the spin speed that the spectrum keeps",
          .source = "half the samples at most",
          .kind = Kind::whole_number,
          .range = between(1, kHighestOrder),
          .default_rule = "max(12, 4 n), at most half of samples_per_revolution"},
         At<&Scene::spectrum, &Spectrum::max_order>{}),

      in({.pointer = "/validity/max_shortening",
          .symbol = "δ/L",
          .unit = "1",
          .meaning = "largest axial shortening of a blade, share of its length",
          .source = "where the equations of the model stop to hold",
          .range = above_zero_up_to(0.6)},
         At<&Scene::validity, &Validity::max_shortening>{}),
      in({.pointer = "/validity/yield_strain",
          .symbol = "",
          .unit = "1",
          .meaning = "bending strain at a blade's root above which a point is flagged",
          .source = "where the equations of the model stop to hold",
          .range = above_zero_up_to(1.0),
          .default_rule = "absent: no flag"},
         At<&Scene::validity, &Validity::yield_strain>{}),

      in({.pointer = "/accuracy/method",
          .symbol = "",
          .unit = "",
          .meaning = "hybrid: closed-form flight, contacts of order 8 with located events, and the same of "
                     "order 5(4) and 3(2); collocation: hybrid, with contacts by collocation; "
                     "paper: the published scheme; located: one adaptive pair with "
                     "located events; fixed: Runge-Kutta of order 4 with a fixed step",
          .source = "the paper's scheme and what it is compared with",
          .kind = Kind::choice,
          .choices = kMethods},
         At<&Scene::accuracy, &Accuracy::method>{}),
      in({.pointer = "/accuracy/tolerance",
          .symbol = "",
          .unit = "1",
          .meaning = "largest local error of a step, relative to the clearance",
          .source = "",
          .range = between(1e-14, 1e-2)},
         At<&Scene::accuracy, &Accuracy::tolerance>{}),
      in({.pointer = "/accuracy/force_increment",
          .symbol = "dF",
          .unit = "N",
          .meaning = "step of the upward search for a blade's force, method paper only",
          .source = "the paper does not say: a thousandth of the Euler load of the default rotor, 42 N",
          .range = between(1e-6, 1e6),
          .chooser = "/accuracy/method"},
         UnderMethod<&Accuracy::force_increment, Method::paper>{}),
      in({.pointer = "/accuracy/max_step",
          .symbol = "",
          .unit = "1",
          .meaning = "longest step in dimensionless time, methods paper and located only",
          .source = "short against a contact, so that none is stepped over",
          .range = between(1e-6, 1e3),
          .chooser = "/accuracy/method"},
         UnderMethod<&Accuracy::max_step, Method::paper, Method::located>{}),
      in({.pointer = "/accuracy/step",
          .symbol = "",
          .unit = "1",
          .meaning =
              "step in dimensionless time, shortened to a whole number a revolution, method fixed only",
          .source = "some hundred steps a contact",
          .range = between(1e-6, 1.0),
          .chooser = "/accuracy/method"},
         UnderMethod<&Accuracy::step, Method::fixed>{}),
  };
  return entries;
}

template <typename T>
constexpr Kind kind_of() {
  if constexpr (std::is_same_v<T, double>) return Kind::number;
  if constexpr (std::is_same_v<T, int>) return Kind::whole_number;
  if constexpr (std::is_same_v<T, bool>) return Kind::flag;
  if constexpr (std::is_same_v<T, std::vector<double>>) return Kind::numbers;
}

template <auto Effect, auto Member>
Quantity quantity_of(const effects::Field<Member>& field) {
  using Settings = std::remove_cvref_t<decltype(*(std::declval<Scene>().*Effect))>;
  return in({.pointer = field.pointer,
             .symbol = field.symbol,
             .unit = field.unit,
             .meaning = field.meaning,
             .source = field.source,
             .kind = kind_of<std::remove_cvref_t<decltype(std::declval<Settings>().*Member)>>(),
             .range = field.range},
            At<Effect, Member>{});
}

/// These entries, with those of the effects after the sections of the machine.
const std::vector<Quantity>& table() {
  static const std::vector<Quantity> entries = [] {
    const auto& own = own_table();
    const auto machine_end =
        std::ranges::find(own, std::string_view("/grid/speed_ratio"), &Quantity::pointer);
    std::vector<Quantity> all(own.begin(), machine_end);
    effects::for_each_effect([&]<auto Effect>() {
      using Settings = std::remove_cvref_t<decltype(*(std::declval<Scene>().*Effect))>;
      std::apply([&](const auto&... field) { (all.push_back(quantity_of<Effect>(field)), ...); },
                 Settings::quantities());
    });
    all.insert(all.end(), machine_end, own.end());
    return all;
  }();
  return entries;
}

}  // namespace

std::span<const Quantity> quantities() {
  return table();
}

const Quantity& quantity(std::string_view pointer) {
  const auto found = std::find_if(table().begin(), table().end(),
                                  [&](const Quantity& entry) { return entry.pointer == pointer; });
  if (found == table().end()) throw std::out_of_range(fmt::format("no quantity at {}", pointer));
  return *found;
}

}  // namespace rubatlas::settings
