#include "scene/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <type_traits>

namespace rubatlas::scene {
namespace {

// From a pair of member pointers to the two functions of an entry: At<&Scene::rotor, &Rotor::mass> reads and
// writes scene.rotor.mass, whether section or member are optional or not, and whether the member is a number
// or a choice. With one member pointer, At<&Scene::title>, the value is the scene's own.
template <typename T>
constexpr bool kIsOptional = false;
template <typename T>
constexpr bool kIsOptional<std::optional<T>> = true;

// The order of a quantity's `choices` is the order of the enumeration: the one place where words become
// types.
constexpr std::array<std::string_view, 2> kContactLaws{"elastica", "elastic_ring"};
constexpr std::array<std::string_view, 4> kSweeps{"up", "down", "both", "independent"};

constexpr std::array<std::string_view, 6> kMethods{"hybrid", "hybrid_54", "hybrid_32",
                                                   "paper",  "located",   "fixed"};

constexpr std::span<const std::string_view> words(ContactLaw /*unused*/) {
  return kContactLaws;
}
constexpr std::span<const std::string_view> words(Sweep /*unused*/) {
  return kSweeps;
}
constexpr std::span<const std::string_view> words(Method /*unused*/) {
  return kMethods;
}

template <typename T>
Value to_value(const T& member) {
  if constexpr (std::is_enum_v<T>) {
    return std::string(words(member)[static_cast<std::size_t>(member)]);
  } else {
    return member;
  }
}

template <typename T>
void from_value(T& member, const Value& value) {
  if constexpr (std::is_enum_v<T>) {
    const auto list = words(T{});
    const auto found = std::find(list.begin(), list.end(), std::get<std::string>(value));
    member = static_cast<T>(found - list.begin());
  } else if constexpr (kIsOptional<T>) {
    member = std::get<typename T::value_type>(value);
  } else {
    member = std::get<T>(value);
  }
}

template <auto Section, auto... Member>
struct At;

template <auto Section>
struct At<Section> {
  static std::optional<Value> read(const Scene& scene) { return to_value(scene.*Section); }
  static void write(Scene& scene, const Value& value) { from_value(scene.*Section, value); }
};

template <auto Section, auto Member>
struct At<Section, Member> {
  static std::optional<Value> read(const Scene& scene) {
    const auto& section = scene.*Section;
    if constexpr (kIsOptional<std::remove_cvref_t<decltype(section)>>) {
      if (!section) return std::nullopt;
      return to_value((*section).*Member);
    } else if constexpr (kIsOptional<std::remove_cvref_t<decltype(section.*Member)>>) {
      if (!(section.*Member)) return std::nullopt;
      return to_value(*(section.*Member));
    } else {
      return to_value(section.*Member);
    }
  }
  static void write(Scene& scene, const Value& value) {
    auto& section = scene.*Section;
    if constexpr (kIsOptional<std::remove_cvref_t<decltype(section)>>) {
      if (!section) section.emplace();
      from_value((*section).*Member, value);
    } else {
      from_value(section.*Member, value);
    }
  }
};

// A quantity that is part of a scene only under some words of a choice: the stiffness of the ring under the
// law that reads it, the knobs of a method under that method.
template <typename Place, auto Section, auto Member, auto... kReaders>
struct Under : Place {
  static constexpr std::array<std::string_view, sizeof...(kReaders)> kWords{
      words(kReaders)[static_cast<std::size_t>(kReaders)]...};
  static std::optional<Value> read(const Scene& scene) {
    const auto chosen = (scene.*Section).*Member;
    if (!((chosen == kReaders) || ...)) return std::nullopt;
    return Place::read(scene);
  }
};
template <auto Member, ContactLaw... kLaws>
using UnderLaw = Under<At<&Scene::ring, Member>, &Scene::contact, &Contact::law, kLaws...>;
template <auto Member, Method... kReaders>
using UnderMethod = Under<At<&Scene::accuracy, Member>, &Scene::accuracy, &Accuracy::method, kReaders...>;

template <typename Place>
constexpr Quantity in(Quantity entry, Place /*unused*/) {
  entry.read = &Place::read;
  entry.write = &Place::write;
  if constexpr (requires { Place::kWords; }) entry.readers = Place::kWords;
  return entry;
}

constexpr Range above_zero_up_to(double high) {
  return {.low = 0.0, .high = high, .low_excluded = true};
}
constexpr Range between(double low, double high) {
  return {.low = low, .high = high};
}

// Upper bounds without a physical reason are there to catch a slip of units before it costs a night of
// computing.
constexpr double kLongest = 1e3;   // [m]
constexpr double kHeaviest = 1e9;  // [kg]
constexpr double kMostRevolutions = 1e8;
constexpr double kMostSamples = 65536;
constexpr double kHighestOrder = 32768;

constexpr std::string_view kDefaultRotor = "MODEL 6.1";

const auto& table() {
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

      in({.pointer = "/rotor/mass",
          .symbol = "m",
          .unit = "kg",
          .meaning = "modal mass of the rotor",
          .source = kDefaultRotor,
          .range = above_zero_up_to(kHeaviest)},
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
          .range = between(-kLongest, kLongest)},
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
          .range = above_zero_up_to(kLongest)},
         At<&Scene::blades, &Blades::length>{}),
      in({.pointer = "/blades/width",
          .symbol = "b",
          .unit = "m",
          .meaning = "width of a blade along the shaft",
          .source = kDefaultRotor,
          .range = above_zero_up_to(kLongest)},
         At<&Scene::blades, &Blades::width>{}),
      in({.pointer = "/blades/thickness",
          .symbol = "h",
          .unit = "m",
          .meaning = "thickness of a blade in its plane of bending",
          .source = kDefaultRotor,
          .range = above_zero_up_to(kLongest)},
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
          .range = between(0.0, kLongest)},
         At<&Scene::blades, &Blades::hub_radius>{}),

      in({.pointer = "/ring/radius",
          .symbol = "R",
          .unit = "m",
          .meaning = "inner radius of the ring",
          .source = kDefaultRotor,
          .range = above_zero_up_to(kLongest)},
         At<&Scene::ring, &Ring::radius>{}),
      in({.pointer = "/ring/stiffness",
          .symbol = "kr",
          .unit = "N/m",
          .meaning = "stiffness of the massless ring under a tip, law elastic_ring only",
          .source = "MODEL 4.7: not in the paper, 100 shaft stiffnesses of the default rotor",
          .range = above_zero_up_to(1e15),
          .chooser = "/contact/law"},
         UnderLaw<&Ring::stiffness, ContactLaw::elastic_ring>{}),

      in({.pointer = "/contact/law",
          .symbol = "",
          .unit = "",
          .meaning =
              "elastica: elastic blades in a rigid ring; elastic_ring: rigid blades in an elastic ring",
          .source = "MODEL 4, MODEL 4.7",
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

      in({.pointer = "/unbalance/moment",
          .symbol = "me",
          .unit = "kg m",
          .meaning = "unbalance, mass times eccentricity",
          .source = "MODEL 1",
          .range = between(0.0, 1e6)},
         At<&Scene::unbalance, &Unbalance::moment>{}),
      in({.pointer = "/unbalance/phase",
          .symbol = "γ",
          .unit = "rad",
          .meaning = "angle of the unbalance from blade 1, positive with the rotation",
          .source = "MODEL 1",
          .range = between(-1e3, 1e3)},
         At<&Scene::unbalance, &Unbalance::phase>{}),

      Quantity{.pointer = "/grid/speed_ratio",
               .symbol = "Ω",
               .unit = "1",
               .meaning = "speed ratio, spin speed over natural frequency",
               .source = "MODEL 1",
               .range = between(1e-4, 1e3),
               .default_rule = "none: every scene says it"},

      in({.pointer = "/sweep",
          .symbol = "",
          .unit = "",
          .meaning = "where a point starts: from its lower neighbour in speed, its upper one, both, or from "
                     "`initial`",
          .source = "MODEL 6",
          .kind = Kind::choice,
          .choices = kSweeps},
         At<&Scene::sweep>{}),

      in({.pointer = "/initial/x",
          .symbol = "x",
          .unit = "m",
          .meaning = "horizontal displacement at the start",
          .source = "MODEL 6",
          .range = between(-kLongest, kLongest)},
         At<&Scene::initial, &Initial::x>{}),
      in({.pointer = "/initial/y",
          .symbol = "y",
          .unit = "m",
          .meaning = "vertical displacement at the start",
          .source = "MODEL 6",
          .range = between(-kLongest, kLongest)},
         At<&Scene::initial, &Initial::y>{}),
      in({.pointer = "/initial/vx",
          .symbol = "x'",
          .unit = "m",
          .meaning = "horizontal velocity at the start, per unit of dimensionless time",
          .source = "MODEL 6",
          .range = between(-kLongest, kLongest)},
         At<&Scene::initial, &Initial::vx>{}),
      in({.pointer = "/initial/vy",
          .symbol = "y'",
          .unit = "m",
          .meaning = "vertical velocity at the start, per unit of dimensionless time",
          .source = "MODEL 6",
          .range = between(-kLongest, kLongest)},
         At<&Scene::initial, &Initial::vy>{}),

      in({.pointer = "/protocol/transient_revolutions",
          .symbol = "",
          .unit = "1",
          .meaning = "revolutions run before anything is kept",
          .source = "MODEL 6",
          .kind = Kind::whole_number,
          .range = between(0, kMostRevolutions)},
         At<&Scene::protocol, &Protocol::transient_revolutions>{}),
      in({.pointer = "/protocol/sampled_revolutions",
          .symbol = "S",
          .unit = "1",
          .meaning = "revolutions of which sections, spectrum and extremes are kept",
          .source = "MODEL 6",
          .kind = Kind::whole_number,
          .range = between(1, 1e6)},
         At<&Scene::protocol, &Protocol::sampled_revolutions>{}),
      in({.pointer = "/protocol/samples_per_revolution",
          .symbol = "",
          .unit = "1",
          .meaning = "samples per revolution of spectrum and orbit",
          .source = "20 samples on the highest default order",
          .kind = Kind::whole_number,
          .range = between(2, kMostSamples)},
         At<&Scene::protocol, &Protocol::samples_per_revolution>{}),
      in({.pointer = "/protocol/stop_when_periodic",
          .symbol = "",
          .unit = "",
          .meaning = "leave out transient revolutions once the sections repeat",
          .source = "off, as in the paper",
          .kind = Kind::flag},
         At<&Scene::protocol, &Protocol::stop_when_periodic>{}),

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
          .source = "MODEL 5",
          .range = above_zero_up_to(0.6)},
         At<&Scene::validity, &Validity::max_shortening>{}),
      in({.pointer = "/validity/yield_strain",
          .symbol = "",
          .unit = "1",
          .meaning = "bending strain at a blade's root above which a point is flagged",
          .source = "MODEL 5",
          .range = above_zero_up_to(1.0),
          .default_rule = "absent: no flag"},
         At<&Scene::validity, &Validity::yield_strain>{}),

      in({.pointer = "/accuracy/method",
          .symbol = "",
          .unit = "",
          .meaning = "hybrid: closed-form flight, contacts of order 8 with located events, and the same of "
                     "order 5(4) and 3(2); paper: the published scheme; located: one adaptive pair with "
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

}  // namespace rubatlas::scene
