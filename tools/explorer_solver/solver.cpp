/// The solver as a WebAssembly module: one point of a scene from numbers to its orbit, for the explorer's
/// page.
///
/// The page writes a request, calls `compute`, and reads arrays from the module's memory. Settings, motions
/// and the protocol of a point are those of the program, compiled from the same sources; this file fills a
/// scene from numbers instead of from JSON, and adds how far each blade bends, for the drawing. The scene is
/// the paper's rotor: no effect besides the unbalance, method `hybrid`.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "observables/observable.hpp"
#include "observables/recorder.hpp"
#include "point/line_solver.hpp"
#include "point/solver.hpp"
#include "settings/scene.hpp"

// The page keeps orbits, not observables: its list of them is empty, and no spectrum is linked.
namespace rubatlas::observables {
Recorder::Recorder(const settings::Scene& /*scene*/) {}
Rows Recorder::rows(bool /*done*/) {
  return {};
}
}  // namespace rubatlas::observables

// There are no exceptions in the module. Sources that would throw one trap, which the page hears of.
extern "C" void* __cxa_allocate_exception(std::size_t /*size*/) {  // NOLINT(bugprone-reserved-identifier)
  __builtin_trap();
}
extern "C" void __cxa_throw(void* /*thrown*/, void* /*type*/,
                            void (* /*destroy*/)(void*)) {  // NOLINT(bugprone-reserved-identifier)
  __builtin_trap();
}
// The module has one thread, which ends with the page: nothing is left to destroy.
extern "C" int __cxa_thread_atexit(void (* /*destroy*/)(void*), void* /*object*/,
                                   void* /*library*/) {  // NOLINT(bugprone-reserved-identifier)
  return 0;
}

namespace {

using namespace rubatlas;

/// What the page asks for. Numbers only, so that a script can write it; SI units.
struct Request {
  double speed_ratio;           ///< Ω [-]
  double damping_ratio;         ///< ζ [-]
  double friction;              ///< μ [-]
  double unbalance;             ///< me [kg m]
  double unbalance_phase;       ///< γ [rad]
  double thickness;             ///< h [m]
  double misalignment;          ///< y0 [m]
  double mass;                  ///< m [kg]
  double natural_frequency;     ///< ωn [rad/s]
  double blade_count;           ///< n [-]
  double blade_length;          ///< L [m]
  double blade_width;           ///< b [m]
  double youngs_modulus;        ///< E [Pa]
  double hub_radius;            ///< rh [m]
  double ring_radius;           ///< R [m]
  double ring_stiffness;        ///< kr [N/m]
  double contact_law;           ///< 0 elastica, 1 elastic_ring (`settings::ContactLaw`)
  double max_shortening;        ///< limit of δ/L [-]
  double tolerance;             ///< local error of a step relative to the clearance
  std::array<double, 4> start;  ///< x, y [m], dx/dτ, dy/dτ [m]
  double transient_revolutions;
  double sampled_revolutions;
  double samples_per_revolution;
  double stop_when_periodic;  ///< 0 or 1
};
static_assert(sizeof(Request) % sizeof(double) == 0);

Request request;
point::Orbit orbit;
std::vector<double>
    tip_slopes;  ///< θ(L) [rad] of each blade at each time of the orbit; 0 where it is straight
assembly::BladeTables* tables = nullptr;

settings::Scene scene_of(const Request& from) {
  settings::Scene scene;
  scene.rotor = {from.mass, from.natural_frequency, from.damping_ratio, from.misalignment};
  scene.blades = {static_cast<int>(from.blade_count),
                  from.blade_length,
                  from.blade_width,
                  from.thickness,
                  from.youngs_modulus,
                  from.hub_radius};
  scene.ring = {from.ring_radius, from.ring_stiffness};
  scene.contact = {static_cast<settings::ContactLaw>(from.contact_law), from.friction};
  // An unbalance of zero is the absent effect, as in a line of an atlas.
  if (from.unbalance != 0.0) scene.unbalance = settings::Unbalance{from.unbalance, from.unbalance_phase};
  scene.protocol = {static_cast<int>(from.transient_revolutions), static_cast<int>(from.sampled_revolutions),
                    static_cast<int>(from.samples_per_revolution), from.stop_when_periodic != 0.0};
  scene.validity.max_shortening = from.max_shortening;
  scene.accuracy.method = settings::Method::hybrid;
  scene.accuracy.tolerance = from.tolerance;
  return scene;
}

/// The module has no exceptions: what the reader of scenes would refuse must not come this far.
bool acceptable(const Request& given) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  const auto positive = [](double value, double high) { return value > 0.0 && value <= high; };
  constexpr double kLongest = 1e3;  // m
  return within(given.speed_ratio, 1e-4, 1e3) && within(given.damping_ratio, 0.0, 1e3) &&
         within(given.friction, 0.0, 2.0) && within(given.unbalance, 0.0, 1e6) &&
         within(given.unbalance_phase, -1e3, 1e3) && positive(given.thickness, kLongest) &&
         within(given.misalignment, -kLongest, kLongest) && positive(given.mass, 1e9) &&
         positive(given.natural_frequency, 1e6) && within(given.blade_count, 1.0, 50.0) &&
         positive(given.blade_length, kLongest) && positive(given.blade_width, kLongest) &&
         positive(given.youngs_modulus, 1e15) && within(given.hub_radius, 0.0, kLongest) &&
         positive(given.ring_radius, kLongest) && positive(given.ring_stiffness, 1e15) &&
         (given.contact_law == 0.0 || given.contact_law == 1.0) && positive(given.max_shortening, 0.75) &&
         within(given.tolerance, 1e-13, 1e-2) &&
         std::all_of(given.start.begin(), given.start.end(),
                     [](double value) { return std::isfinite(value); }) &&
         within(given.transient_revolutions, 0.0, 1e5) && within(given.sampled_revolutions, 1.0, 1e4) &&
         within(given.samples_per_revolution, 2.0, 4096.0);
}

/// The bending of a blade that touches: the root of h (MODEL 4) along its curve, for a slip direction s. The
/// curve starts at h = g > 0 and has one root.
struct Bend {
  double load;       ///< F [N]
  double tip_slope;  ///< θ(L) [rad], positive to the side to which friction pushes the tip
};
Bend bend_of(const settings::Scene& scene, const blade::ElasticaCurve& curve, double radial,
             double tangential, double slip) {
  const settings::Blades& blades = scene.blades;
  const auto h = [&](double bending) {
    const blade::CurvePoint at = curve.at(bending);
    const double outward = radial + blades.hub_radius + blades.length * (1.0 - at.shortening);
    const double across = tangential - slip * blades.length * at.deflection;
    return outward * outward + across * across - scene.ring.radius * scene.ring.radius;
  };
  double low = 0.0;
  double high = curve.end();
  if (!(h(low) > 0.0) || !(h(high) < 0.0)) return {0.0, 0.0};
  constexpr int kHalvings = 52;  // of an interval of order one, to the last bit
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (h(middle) > 0.0 ? low : high) = middle;
  }
  const double stiffness = blades.youngs_modulus * blades.width * std::pow(blades.thickness, 3) / 12.0;
  const double load = curve.at(high).load * stiffness / (blades.length * blades.length);
  // ψL² = u² + β² at the tip, and θL = ψL − β.
  const double angle = curve.load_angle();
  return {load, slip * high * high / (std::hypot(high, angle) + angle)};
}

/// Tip slopes of the blades that bear a force.
void find_tip_slopes(const settings::Scene& scene, double speed_ratio) {
  tip_slopes.assign(orbit.force.size(), 0.0);
  if (scene.contact.law == settings::ContactLaw::elastic_ring) return;  // its blades are rigid
  const auto curve = tables->curve(scene.contact.friction);
  const auto count = static_cast<std::size_t>(scene.blades.count);
  for (std::size_t i = 0; i < orbit.force.size(); ++i) {
    const double force = orbit.force[i];
    if (!(force > 0.0)) continue;
    const auto& state = orbit.state[i / count];
    const double angle = speed_ratio * orbit.time[i / count] +
                         2.0 * std::numbers::pi * static_cast<double>(i % count) / static_cast<double>(count);
    const double y = state[1] + scene.rotor.misalignment;
    const double radial = state[0] * std::cos(angle) + y * std::sin(angle);
    const double tangential = y * std::cos(angle) - state[0] * std::sin(angle);
    // The orbit does not keep s: of the two directions it is the one whose force is the orbit's.
    const Bend forward = bend_of(scene, *curve, radial, tangential, 1.0);
    const Bend backward = bend_of(scene, *curve, radial, tangential, -1.0);
    const bool is_forward = std::abs(forward.load - force) <= std::abs(backward.load - force);
    tip_slopes[i] = (is_forward ? forward : backward).tip_slope;
  }
}

template <class Values>
const void* address(const Values& values) {
  return values.data();
}

}  // namespace

#define RUBATLAS_EXPORT(name) extern "C" __attribute__((export_name(#name), visibility("default")))

RUBATLAS_EXPORT(request_numbers) double* request_numbers() {
  return reinterpret_cast<double*>(&request);
}
RUBATLAS_EXPORT(request_size) int request_size() {
  return static_cast<int>(sizeof(Request) / sizeof(double));
}
/// Computes the request. Returns the status of the point (`point::PointStatus`), −1 for a request that no
/// scene may make.
RUBATLAS_EXPORT(compute) int compute() {
  if (!acceptable(request)) return -1;
  if (tables == nullptr) tables = new assembly::BladeTables;
  const settings::Scene scene = scene_of(request);
  orbit = assembly::make_hybrid({scene, *tables})->orbit(request.speed_ratio, request.start);
  find_tip_slopes(scene, request.speed_ratio);
  return static_cast<int>(orbit.status);
}
/// What ended the point that `compute` has computed last: its text, and how long that is.
RUBATLAS_EXPORT(ending) const char* ending() {
  return point::text_of(orbit.detail).data();
}
RUBATLAS_EXPORT(ending_size) int ending_size() {
  return static_cast<int>(point::text_of(orbit.detail).size());
}
RUBATLAS_EXPORT(failed_revolution) int failed_revolution() {
  return orbit.failed_revolution;
}
/// Arrays of the last orbit. Sections and states are x, y, dx/dτ, dy/dτ; forces and slopes have one number
/// per blade.
RUBATLAS_EXPORT(section_count) int section_count() {
  return static_cast<int>(orbit.sections.size());
}
RUBATLAS_EXPORT(sections) const void* sections() {
  return address(orbit.sections);
}
RUBATLAS_EXPORT(time_count) int time_count() {
  return static_cast<int>(orbit.time.size());
}
RUBATLAS_EXPORT(times) const void* times() {
  return address(orbit.time);
}
RUBATLAS_EXPORT(states) const void* states() {
  return address(orbit.state);
}
RUBATLAS_EXPORT(forces) const void* forces() {
  return address(orbit.force);
}
RUBATLAS_EXPORT(slopes) const void* slopes() {
  return address(tip_slopes);
}
RUBATLAS_EXPORT(contact_sample_count) int contact_sample_count() {
  return static_cast<int>(orbit.contacts.time.size());
}
RUBATLAS_EXPORT(contact_numbers) const void* contact_numbers() {
  return address(orbit.contacts.number);
}
RUBATLAS_EXPORT(contact_blades) const void* contact_blades() {
  return address(orbit.contacts.blade);
}
RUBATLAS_EXPORT(contact_times) const void* contact_times() {
  return address(orbit.contacts.time);
}
RUBATLAS_EXPORT(contact_forces) const void* contact_forces() {
  return address(orbit.contacts.force);
}
