/// The solver as a WebAssembly module: one point of a scene from numbers to its orbit, for the explorer's
/// page.
///
/// The page writes a request, calls `compute`, and reads arrays from the module's memory. Settings, motions
/// and the protocol of a point are those of the program, compiled from the same sources; this file fills a
/// scene from numbers instead of from JSON. The scene is the paper's rotor: no effect besides the unbalance,
/// method `hybrid`.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "assembly/blade_tables.hpp"
#include "assembly/methods.hpp"
#include "modes/collocated_laws.hpp"
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

// The method is `hybrid`: nothing is left to collocation.
namespace rubatlas::modes {
template <class Blade>
std::unique_ptr<Phase> collocated(const ModesRequest& /*request*/,
                                  const contact::UnequalBlades<Blade>& /*law*/) {
  return nullptr;
}
template std::unique_ptr<Phase> collocated(const ModesRequest&,
                                           const contact::UnequalBlades<contact::ElasticaContact>&);
template std::unique_ptr<Phase> collocated(const ModesRequest&,
                                           const contact::UnequalBlades<contact::ElasticRingContact>&);
template std::unique_ptr<Phase> collocated(
    const ModesRequest&,
    const contact::UnequalBlades<contact::RigidBladeContact<contact::StickingFriction>>&);
template std::unique_ptr<Phase> collocated(
    const ModesRequest&,
    const contact::UnequalBlades<contact::RigidBladeContact<contact::VelocityFriction>>&);
}  // namespace rubatlas::modes

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
/// Computes the request. Returns the status of the point (`ending::PointStatus`), −1 for a request that no
/// scene may make.
RUBATLAS_EXPORT(compute) int compute() {
  if (!acceptable(request)) return -1;
  if (tables == nullptr) tables = new assembly::BladeTables;
  const settings::Scene scene = scene_of(request);
  const assembly::LineRequest line{scene, *tables, {}};
  const bool rigid = scene.contact.law == settings::ContactLaw::elastic_ring;
  orbit = assembly::hybrid_solver(line, rigid ? law_of_rigid_blades(line) : law_of_axial_loads(line))
              ->orbit(request.speed_ratio, request.start);
  return static_cast<int>(orbit.status);
}
/// What ended the point that `compute` has computed last: its text, and how long that is.
RUBATLAS_EXPORT(ending) const char* ending() {
  return ending::text_of(orbit.detail).data();
}
RUBATLAS_EXPORT(ending_size) int ending_size() {
  return static_cast<int>(ending::text_of(orbit.detail).size());
}
RUBATLAS_EXPORT(failed_revolution) int failed_revolution() {
  return orbit.failed_revolution;
}
/// Arrays of the last orbit. Sections and states are x, y, dx/dτ, dy/dτ; forces have one number per blade.
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
