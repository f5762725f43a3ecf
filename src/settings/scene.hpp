/// A scene: everything that a user can say about one atlas, typed, checked and in SI units.
///
/// The structs mirror the sections of the scene file (keys.md); the reader (`reader.hpp`)
/// fills them, and no code after the reader sees JSON. Defaults are the paper's default rotor (MODEL 6.1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "settings/effects/list.hpp"

namespace rubatlas::settings {

/// Point mass on a massless isotropic shaft (MODEL 1).
struct Rotor {
  double mass = 1.0;                ///< m [kg]
  double natural_frequency = 10.0;  ///< ωn [rad/s]
  double damping_ratio = 0.1;       ///< ζ [-]
  double misalignment = 0.01001;    ///< y0 [m]: the ring's centre is at (0, -y0)
};

/// Equal, massless, elastic blades clamped on a hub (MODEL 2, 3).
struct Blades {
  int count = 3;                  ///< n [-]
  double length = 0.1;            ///< L [m]
  double width = 0.01;            ///< b [m]
  double thickness = 0.001;       ///< h [m]
  double youngs_modulus = 206e9;  ///< E [Pa]
  double hub_radius = 0.0;        ///< rh [m]
};

struct Ring {
  double radius = 0.11;    ///< R [m], inner radius
  double stiffness = 1e4;  ///< kr [N/m]; read by the law `elastic_ring` only (MODEL 4.7)
};

enum class ContactLaw : std::uint8_t { elastica, elastic_ring, beam_column };

struct Contact {
  ContactLaw law = ContactLaw::elastica;
  double friction = 0.1;  ///< μ [-]
};

/// An effect is present only where the scene has its section or a grid axis of its quantity: absent means
/// absent (`effects/list.hpp`).
using Unbalance = effects::Unbalance;

/// Values of a quantity that the grid names by its JSON pointer: an axis of the atlas besides the usual five.
struct PointerAxis {
  std::string pointer;         ///< of the quantity, for example "/ring/stiffness"
  std::vector<double> values;  ///< ascending, in the quantity's unit
};

/// Values along each axis of the atlas, ascending. Of the five axes that every atlas has, those that the
/// scene does not name hold the scene's one value.
struct Grid {
  std::vector<double> thickness;        ///< h [m]
  std::vector<double> unbalance;        ///< me [kg m]
  std::vector<double> friction;         ///< μ [-]
  std::vector<double> damping_ratio;    ///< ζ [-]
  std::vector<double> speed_ratio;      ///< Ω [-]
  std::vector<PointerAxis> swept = {};  ///< further axes, sorted by the names of their dimensions
};

/// Where a point starts: from its neighbour below or above in Ω, both ways, or always from `initial`.
enum class Sweep : std::uint8_t { up, down, both, independent };

/// A line of a sweep cut into pieces, which several ranks compute at the same time (`plan/pieces.hpp`).
struct Pieces {
  int points = 48;  ///< of a piece; the last piece of a line may be shorter
  int lead_in = 0;  ///< points of the line before a piece, swept from `initial` on to lead into it

  // Lines are cut unasked where they are longer than this, in a scene of fewer than so many.
  static constexpr std::size_t kLongestWhole = 256;  ///< points
  static constexpr std::size_t kManyLines = 128;     ///< keep ranks busy as they are
};

/// State of the shaft centre at phase 0 (MODEL 6).
struct Initial {
  double x = 0.0;   ///< [m]
  double y = 0.0;   ///< [m]
  double vx = 0.0;  ///< dx/dτ [m]
  double vy = 0.0;  ///< dy/dτ [m]
};

/// How a transient ends that approaches a cycle: `newton`, on the cycle that Newton's method finds ahead of
/// it, as soon as that is certainly where it ends; `never`, after all its revolutions.
enum class Settle : std::uint8_t { newton, never };

struct Protocol {
  int transient_revolutions = 200;   ///< run before anything is kept; 0 is legal
  int sampled_revolutions = 100;     ///< S, at least 1
  int samples_per_revolution = 256;  ///< of the spectrum and of `orbit`
  Settle settle = Settle::newton;
};

struct Spectrum {
  int max_order = 12;  ///< highest order kept; default max(12, 4 n)
};

struct Validity {
  double max_shortening = 0.5;         ///< limit of δ/L [-] (MODEL 5)
  std::optional<double> yield_strain;  ///< root bending strain flag [-]; absent: no flag
};

/// How a point is integrated: `hybrid` (closed-form flight, located events, order 8 in contact);
/// `collocation`, the same with contacts by collocation; `hybrid` with pairs of order 5(4) and 3(2); `paper`,
/// the published scheme; `located`, one adaptive pair with located events; `fixed`, classical Runge–Kutta
/// with a fixed step.
enum class Method : std::uint8_t { hybrid, collocation, hybrid_54, hybrid_32, paper, located, fixed };

struct Accuracy {
  Method method = Method::collocation;
  double tolerance = 1e-9;        ///< local error of a step relative to the clearance
  double force_increment = 0.04;  ///< dF [N]; read by the method `paper` only
  double max_step = 0.02;         ///< longest step in τ; read by `paper` and `located` only
  double step = 1e-3;             ///< in τ; read by `fixed` only
};

struct Scene : effects::Effects {
  std::string title;
  std::string reference;
  std::optional<std::string> creator;  ///< of the atlas
  std::optional<std::string> license;  ///< under which the atlas may be used
  Rotor rotor;
  Blades blades;
  Ring ring;
  Contact contact;
  Grid grid;
  Sweep sweep = Sweep::up;
  std::optional<Pieces> pieces;  ///< without them each line is swept from its one end to the other
  Initial initial;
  Protocol protocol;
  Spectrum spectrum;
  Validity validity;
  std::vector<std::string> observables;  ///< in the order of the registration list, not of the file
  Accuracy accuracy;

  /// δc = R − rh − L [m] (MODEL 2). Zero where the three lengths cancel to their rounding: tolerances are
  /// relative to the clearance, and 1e-17 m would make them meaningless.
  [[nodiscard]] double clearance() const {
    constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
    const double difference = ring.radius - blades.hub_radius - blades.length;
    return std::abs(difference) <= kRounding * ring.radius ? 0.0 : difference;
  }
  [[nodiscard]] bool observes(std::string_view name) const {
    return std::find(observables.begin(), observables.end(), name) != observables.end();
  }
  /// Signals of which a point keeps all samples, to transform them together.
  [[nodiscard]] int transformed_signals() const {
    return (observes("spectrum") ? 1 : 0) + (observes("full_spectrum") ? 2 : 0);
  }
};

}  // namespace rubatlas::settings
