/// The solver as a WebAssembly module: one point of a scene to its orbit, for the explorer's page.
///
/// The page writes a scene as JSON text, with a grid of one point, and what effects remember; it calls
/// `compute`, and reads arrays from the module's memory. Reader, laws, effects and the protocol of a point
/// are those of the program, compiled from the same sources.

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "assembly/methods.hpp"
#include "motion/point_start.hpp"
#include "observables/recorder.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/reader.hpp"

// The page keeps orbits, not observables: its list of them is empty, and no spectrum is linked.
namespace rubatlas::observables {
Recorder::Recorder(const settings::Scene& /*scene*/) {}
Rows Recorder::rows(bool /*done*/) {
  return {};
}
}  // namespace rubatlas::observables

// Methods that only comparisons ask for are not linked; the page does not ask for them.
namespace rubatlas::assembly {
namespace {
std::unique_ptr<point::LineSolver> not_here() {
  throw std::logic_error("the page computes by collocation or hybrid");
}
}  // namespace
std::unique_ptr<point::LineSolver> make_hybrid_54(const LineRequest& /*request*/) {
  return not_here();
}
std::unique_ptr<point::LineSolver> make_hybrid_32(const LineRequest& /*request*/) {
  return not_here();
}
std::unique_ptr<point::LineSolver> make_paper(const LineRequest& /*request*/) {
  return not_here();
}
std::unique_ptr<point::LineSolver> make_located(const LineRequest& /*request*/) {
  return not_here();
}
std::unique_ptr<point::LineSolver> make_fixed(const LineRequest& /*request*/) {
  return not_here();
}
}  // namespace rubatlas::assembly

namespace {

using namespace rubatlas;

std::string scene_text;
std::array<double, motion::Memory::kMost> memory;
std::string refusal;  ///< what a source has thrown
point::Orbit orbit;
std::shared_ptr<assembly::BladeTables> tables;

template <class Values>
const void* address(const Values& values) {
  return values.data();
}

}  // namespace

// There are no exceptions in the module: what is thrown ends it with a trap, and leaves its sentence. All
// that the program throws has std::exception as its first base.
extern "C" void* __cxa_allocate_exception(std::size_t size) {  // NOLINT(bugprone-reserved-identifier)
  return ::operator new(size);
}
extern "C" void __cxa_throw(void* thrown, void* /*type*/,
                            void (* /*destroy*/)(void*)) {  // NOLINT(bugprone-reserved-identifier)
  refusal = static_cast<const std::exception*>(thrown)->what();
  __builtin_trap();
}
// Arithmetic of 128 bits in the compiler's library guards its stack.
extern "C" std::uintptr_t __stack_chk_guard = 0x595e9fbd;  // NOLINT(bugprone-reserved-identifier)
extern "C" void __stack_chk_fail() {                       // NOLINT(bugprone-reserved-identifier)
  __builtin_trap();
}
// The module has one thread, which ends with the page: nothing is left to destroy.
extern "C" int __cxa_thread_atexit(void (* /*destroy*/)(void*), void* /*object*/,
                                   void* /*library*/) {  // NOLINT(bugprone-reserved-identifier)
  return 0;
}

#define RUBATLAS_EXPORT(name) extern "C" __attribute__((export_name(#name), visibility("default")))

/// Where the page writes the scene's text of so many bytes.
RUBATLAS_EXPORT(scene_of_size) char* scene_of_size(int size) {
  scene_text.resize(static_cast<std::size_t>(size));
  return scene_text.data();
}
/// Where it writes what effects remember, in the order of the atlas' `/final_state_<effect>`.
RUBATLAS_EXPORT(memory_of_effects) double* memory_of_effects() {
  return memory.data();
}
/// Computes the one point of the scene from its initial state and so many remembered numbers. Returns the
/// status of the point (`ending::PointStatus`).
RUBATLAS_EXPORT(compute) int compute(int remembered) {
  if (!tables) tables = assembly::make_blade_tables();
  const settings::Scene scene = settings::parse_scene(scene_text);
  const plan::PointParameters point = plan::Grid(scene).parameters(0);
  const motion::Memory start(std::span(memory).first(static_cast<std::size_t>(remembered)));
  const settings::Initial& initial = scene.initial;
  orbit = assembly::make_line_solver(scene, point, tables)
              ->orbit(point.speed_ratio, {{initial.x, initial.y, initial.vx, initial.vy}, start});
  return static_cast<int>(orbit.status);
}
/// Why the module has ended with a trap, and how long that is; empty where nothing says why.
RUBATLAS_EXPORT(refusal_text) const char* refusal_text() {
  return refusal.data();
}
RUBATLAS_EXPORT(refusal_size) int refusal_size() {
  return static_cast<int>(refusal.size());
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
/// What effects remember at its end.
RUBATLAS_EXPORT(final_memory) const void* final_memory() {
  return orbit.final_memory.view().data();
}
RUBATLAS_EXPORT(final_memory_size) int final_memory_size() {
  return static_cast<int>(orbit.final_memory.view().size());
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
