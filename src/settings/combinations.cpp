#include "settings/combinations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <variant>

#include "settings/methods.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::settings {
bool ring_has_no_mass(const Scene& scene) {
  return scene.ring_body && std::ranges::min(values_in(scene, "/ring_body/mass")) == 0.0;
}

namespace {

using effects::Effects;

EffectSet effects_that(bool (*effects::Listed::*is)(const Effects&), const Scene& scene) {
  EffectSet result;
  const auto all = effects::listed();
  for (std::size_t place = 0; place < all.size(); ++place) {
    if ((all[place].*is)(scene)) result.insert(place);
  }
  return result;
}

// --- refusals ---

bool is_rigid(const Scene& scene) {
  return scene.contact.law == ContactLaw::elastic_ring;
}
bool is_beam_column(const Scene& scene) {
  return scene.contact.law == ContactLaw::beam_column;
}
bool method_takes_no_effects(const Scene& scene) {
  return !method_of(scene).takes_effects;
}
bool ring_without_mass_under_elastic_blades(const Scene& scene) {
  return ring_has_no_mass(scene) && !is_rigid(scene);
}
bool ring_without_mass_is_damped(const Scene& scene) {
  return ring_has_no_mass(scene) && std::ranges::max(values_in(scene, "/ring_body/damping")) > 0.0;
}

bool nothing_yields_under_a_tip(const Scene& scene) {
  return !is_rigid(scene) &&
         !(scene.yielding_ring && std::ranges::min(values_in(scene, "/yielding_ring/compliance")) > 0.0);
}

/// A scene that has one of `effects` is refused if it has one of `beside` too, or where `where` holds.
struct Refusal {
  EffectSet effects;
  EffectSet beside;
  bool (*where)(const Scene&);
  std::string_view quantity;  ///< of the effect, named by the text, such as "/mass"; empty: the section
  std::string_view sentence;  ///< after the pointer
};

constexpr EffectSet kEveryEffect = [] {
  EffectSet all;
  effects::for_each_effect([&]<auto Effect>() { all.insert<Effect>(); });
  return all;
}();

constexpr std::string_view kRigid =
    R"(has no effect under the contact law "elastic_ring", whose blades are rigid)";

/// The rows are tried in this order. Where several effects, or several sections beside them, match a row, the
/// text names the first in the order of the effects' list.
constexpr std::array kRefusals{
    // The methods that `hybrid` is compared with are for the paper's rotor alone.
    Refusal{.effects = kEveryEffect - effect_set<&Effects::unbalance>(),
            .beside = {},
            .where = method_takes_no_effects,
            .quantity = {},
            .sentence = R"(the method "{method}" computes the paper's rotor and its unbalance; )"
                        R"(effects need "collocation" or "hybrid")"},
    // Rigid blades have no bending, and their ring yields already.
    Refusal{.effects = effect_set<&Effects::axial_compliance>(),
            .beside = {},
            .where = is_rigid,
            .quantity = {},
            .sentence = kRigid},
    Refusal{.effects = effect_set<&Effects::yielding_ring>(),
            .beside = {},
            .where = is_rigid,
            .quantity = {},
            .sentence = R"(the contact law "elastic_ring" has a ring that yields already: /ring/stiffness)"},
    Refusal{.effects = effect_set<&Effects::release, &Effects::load_direction>(),
            .beside = {},
            .where = is_rigid,
            .quantity = {},
            .sentence = kRigid},
    Refusal{.effects = effect_set<&Effects::stribeck>(),
            .beside = effect_set<&Effects::regularised_friction>(),
            .where = nullptr,
            .quantity = {},
            .sentence = "stands beside {beside}; friction has one law"},
    Refusal{.effects = effect_set<&Effects::stick>(),
            .beside = effect_set<&Effects::regularised_friction, &Effects::stribeck>(),
            .where = nullptr,
            .quantity = {},
            .sentence = "stands beside {beside}; friction has one law"},
    Refusal{
        .effects = effect_set<&Effects::stick>(),
        .beside = effect_set<&Effects::wear, &Effects::speed_ramp>(),
        .where = nullptr,
        .quantity = {},
        .sentence = "stands beside {beside}, whose changes between revolutions would make tips at rest slip"},
    Refusal{.effects = effect_set<&Effects::stick>(),
            .beside = effect_set<&Effects::load_direction>(),
            .where = nullptr,
            .quantity = {},
            .sentence = "holds tips under the axial load only, not beside {beside}"},
    // There is no table of the blade's curve under an inclined load or a friction coefficient that varies.
    Refusal{
        .effects = effect_set<&Effects::load_direction, &Effects::regularised_friction, &Effects::stribeck,
                              &Effects::stick>(),
        .beside = effect_set<&Effects::axial_compliance, &Effects::yielding_ring, &Effects::release>(),
        .where = is_beam_column,
        .quantity = {},
        .sentence =
            R"(combines with inextensible elastica in a rigid ring only: no axial_compliance, yielding_ring, )"
            R"(release or law "beam_column")"},
    Refusal{.effects = effect_set<&Effects::contact_damping>(),
            .beside = effect_set<&Effects::axial_compliance, &Effects::release, &Effects::load_direction,
                                 &Effects::regularised_friction, &Effects::stribeck, &Effects::stick,
                                 &Effects::ring_body>(),
            .where = nullptr,
            .quantity = {},
            .sentence =
                "stands beside {beside}; a damper under each tip is made for the plain laws of contact only"},
    Refusal{
        .effects = effect_set<&Effects::contact_damping>(),
        .beside = {},
        .where = nothing_yields_under_a_tip,
        .quantity = {},
        .sentence =
            "the ring does not yield under elastic blades; /yielding_ring with a compliance above 0 does"},
    // Motions with a ring body are tested with the plain contact laws, and with a machine that does not
    // change between revolutions: the memories of two effects would have to be told apart.
    Refusal{.effects = effect_set<&Effects::ring_body>(),
            .beside = effect_set<&Effects::yielding_ring, &Effects::release, &Effects::load_direction,
                                 &Effects::regularised_friction, &Effects::stribeck, &Effects::wear,
                                 &Effects::speed_ramp, &Effects::stick>(),
            .where = nullptr,
            .quantity = {},
            .sentence = "stands beside {beside}; the ring moves as one body without it only"},
    Refusal{.effects = effect_set<&Effects::ring_body>(),
            .beside = {},
            .where = ring_without_mass_under_elastic_blades,
            .quantity = "/mass",
            .sentence = R"(0 goes with the contact law "elastic_ring" only; under elastic blades )"
                        "/yielding_ring is a ring without mass"},
    Refusal{.effects = effect_set<&Effects::ring_body>(),
            .beside = {},
            .where = ring_without_mass_is_damped,
            .quantity = "/damping",
            .sentence = "{damping} beside a mass of 0; a ring without mass has no damping here"},
};

// --- families ---

bool friction_has_one_law(const Scene& line) {
  return !(effects::acts<&Effects::regularised_friction>(line) && effects::acts<&Effects::stribeck>(line));
}
bool ring_yields(const Scene& line) {
  return effects::acts<&Effects::yielding_ring>(line);
}
bool ring_has_mass(const Scene& line) {
  return line.ring_body && line.ring_body->mass > 0.0;
}
bool ring_has_neither_mass_nor_damping(const Scene& line) {
  return line.ring_body && line.ring_body->mass == 0.0 && line.ring_body->damping == 0.0;
}

/// Effects that every family but the paper's rotor computes: loads, supports, speed within a revolution, and
/// blades that differ.
constexpr EffectSet kMachine =
    effect_set<&Effects::unbalance, &Effects::gravity, &Effects::side_load, &Effects::support,
               &Effects::speed_ripple, &Effects::unequal_blades>();
/// Effects that change the machine from revolution to revolution.
constexpr EffectSet kChanges = effect_set<&Effects::wear, &Effects::speed_ramp>();
constexpr EffectSet kFrictionWithVelocity = effect_set<&Effects::regularised_friction, &Effects::stribeck>();
constexpr EffectSet kElasticBladeOrRing = effect_set<&Effects::axial_compliance, &Effects::yielding_ring>();

constexpr ContactText kOneBend{"the bending of each blade is found along with the motion",
                               "the bending of each blade is a root in each stage"};
constexpr ContactText kTwoBends{
    "the bends of all blades in contact, two numbers each, are found along with the motion",
    "the bends of each blade, two numbers, are a root in each stage"};
constexpr ContactText of_any_method(std::string_view text) {
  return {text, text};
}
constexpr ContactText kExplicit = of_any_method("the force of each blade is explicit");

}  // namespace

std::span<const Family> families() {
  using enum ContactLaw;
  using enum MotionFamily;
  static const std::vector<ContactLaw> bending{elastica, beam_column};
  static const std::vector<Family> rows{
      {.kind = paper_s_rotor,
       .name = "the paper's rotor with elastic blades",
       .laws = bending,
       .consumes = effect_set<&Effects::unbalance>(),
       .is_for = nullptr,
       .contact = kOneBend,
       .flight = {}},
      {.kind = paper_s_rotor,
       .name = "the paper's rotor with rigid blades on an elastic ring",
       .laws = {elastic_ring},
       .consumes = effect_set<&Effects::unbalance>(),
       .is_for = nullptr,
       .contact = kExplicit,
       .flight = {}},
      {.kind = rigid_blades,
       .name = "rigid blades",
       .laws = {elastic_ring},
       .consumes = kMachine | kChanges | kFrictionWithVelocity,
       .is_for = friction_has_one_law,
       .contact = kExplicit,
       .flight = {}},
      {.kind = sticking_rigid_blades,
       .name = "rigid blades whose tips may stick",
       .laws = {elastic_ring},
       .consumes = kMachine | effect_set<&Effects::stick>(),
       .is_for = nullptr,
       .contact = of_any_method(
           "the force of each blade is explicit; the friction that holds tips at rest follows from a "
           "linear system"),
       .flight = {}},
      {.kind = elastic_blades,
       .name = "elastic blades",
       .laws = bending,
       .consumes = kMachine | kChanges | kElasticBladeOrRing | effect_set<&Effects::release>(),
       .is_for = nullptr,
       .contact = kOneBend,
       .flight = {}},
      {.kind = directed_elastic_blades,
       .name = "elastic blades under a load along the contact normal, or with friction that depends on the "
               "slip velocity",
       .laws = {elastica},
       .consumes = kMachine | kChanges | kFrictionWithVelocity | effect_set<&Effects::load_direction>(),
       .is_for = friction_has_one_law,
       .contact = kTwoBends,
       .flight = {}},
      {.kind = sticking_elastic_blades,
       .name = "elastic blades whose tips may stick",
       .laws = {elastica},
       .consumes = kMachine | effect_set<&Effects::stick>(),
       .is_for = nullptr,
       .contact = kTwoBends,
       .flight = {}},
      {.kind = blades_on_damped_ring,
       .name = "elastic blades on a ring with a damper under each tip",
       .laws = bending,
       .consumes = kMachine | kChanges | effect_set<&Effects::yielding_ring, &Effects::contact_damping>(),
       .is_for = ring_yields,
       .contact =
           {"how far the ring yields under each contact is found along with the motion",
            "how far the ring yields under each contact is a state, the bending of each blade a root in "
            "each stage"},
       .flight = {}},
      {.kind = blades_on_damped_ring,
       .name = "rigid blades on a ring with a damper under each tip",
       .laws = {elastic_ring},
       .consumes = kMachine | kChanges | effect_set<&Effects::contact_damping>(),
       .is_for = nullptr,
       .contact =
           of_any_method("the force of each blade is explicit, and vanishes inside the undeformed ring"),
       .flight = {}},
      {.kind = blades_in_ring_body,
       .name = "elastic blades in a ring that is a body",
       .laws = bending,
       .consumes = kMachine | effect_set<&Effects::axial_compliance, &Effects::ring_body>(),
       .is_for = ring_has_mass,
       .contact = kOneBend,
       .flight = "the ring oscillates freely beside the shaft"},
      {.kind = blades_in_ring_body,
       .name = "rigid blades in a ring that is a body",
       .laws = {elastic_ring},
       .consumes = kMachine | effect_set<&Effects::ring_body>(),
       .is_for = ring_has_mass,
       .contact = kExplicit,
       .flight = "the ring oscillates freely beside the shaft"},
      {.kind = blades_in_ring_without_mass,
       .name = "rigid blades in a ring without mass",
       .laws = {elastic_ring},
       .consumes = kMachine | effect_set<&Effects::ring_body>(),
       .is_for = ring_has_neither_mass_nor_damping,
       .contact = of_any_method(
           "the forces of all blades and the place of the ring, where its spring balances them, are found "
           "together"),
       .flight = "the ring stays at its place of rest"},
  };
  return rows;
}

EffectSet given(const Scene& scene) {
  return effects_that(&effects::Listed::is_in, scene);
}

EffectSet acting(const Scene& line) {
  const EffectSet all = effects_that(&effects::Listed::acts, line);
  return line.contact.friction == 0.0 ? all - kNeedFriction : all;
}

std::vector<std::string_view> EffectSet::sections() const {
  std::vector<std::string_view> result;
  const auto all = effects::listed();
  for (std::size_t place = 0; place < all.size(); ++place) {
    if (contains(place)) result.push_back(all[place].description.section);
  }
  return result;
}

std::optional<std::string> refusal_of_combination(const Scene& scene) {
  const EffectSet sections = given(scene);
  for (const Refusal& row : kRefusals) {
    const EffectSet refused = row.effects & sections;
    const EffectSet beside = row.beside & sections;
    if (refused.empty()) continue;
    if (beside.empty() && (row.where == nullptr || !row.where(scene))) continue;
    const auto method = quantity("/accuracy/method").read(scene);
    const double damping = scene.ring_body ? std::ranges::max(values_in(scene, "/ring_body/damping")) : 0.0;
    return fmt::format(
        "{}{}: {}", refused.sections().front(), row.quantity,
        fmt::format(fmt::runtime(row.sentence),
                    fmt::arg("beside", beside.empty() ? "" : beside.sections().front()),
                    fmt::arg("method", std::get<std::string>(*method)), fmt::arg("damping", damping)));
  }
  return std::nullopt;
}

bool Family::takes(const Scene& line) const {
  return std::ranges::count(laws, line.contact.law) > 0 && acting(line).is_within(consumes) &&
         (kind == MotionFamily::paper_s_rotor || method_of(line).takes_effects) &&
         (is_for == nullptr || is_for(line));
}

Combination combination_of(const Scene& line) {
  const auto family = std::ranges::find_if(families(), [&](const Family& row) { return row.takes(line); });
  if (family == families().end()) throw std::logic_error("no family of motions takes the line's effects");
  constexpr EffectSet kAnySupport = effect_set<&Effects::support, &Effects::speed_ripple>();
  const EffectSet effects = acting(line);
  return {&*family, (effects & kAnySupport).empty() ? Machine::isotropic_shaft : Machine::any_linear_support,
          effects & family->consumes};
}

std::vector<Combination> combinations_in(const Scene& scene) {
  // A combination depends only on which numbers are zero. So zero and one other value, where the axis has
  // them, represent all values of an axis.
  std::vector<Axis> axes = axes_of(scene);
  const auto sections = kEveryEffect.sections();
  std::erase_if(axes, [&](const Axis& axis) {
    const bool of_effect = std::ranges::count(sections, axis.quantity->section()) > 0;
    return !of_effect && axis.quantity->pointer != "/contact/friction";
  });
  for (Axis& axis : axes) {
    const auto zero = std::ranges::find(axis.values, 0.0);
    const auto other = std::ranges::find_if(axis.values, [](double value) { return value != 0.0; });
    std::vector<double> both;
    if (zero != axis.values.end()) both.push_back(*zero);
    if (other != axis.values.end()) both.push_back(*other);
    axis.values = std::move(both);
  }
  Scene line = scene;
  line.grid = {};
  std::vector<Combination> found;
  const auto walk = [&](const auto& self, std::size_t number) -> void {
    if (number == axes.size()) {
      const Combination one = combination_of(line);
      if (std::ranges::find(found, one) == found.end()) found.push_back(one);
      return;
    }
    for (const double value : axes[number].values) {
      axes[number].quantity->write(line, value);
      self(self, number + 1);
    }
  };
  walk(walk, 0);
  return found;
}

}  // namespace rubatlas::settings
