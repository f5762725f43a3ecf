/// The door to the physics: one line of the atlas, point by point.
///
/// A scene's choices (contact law, effects, observables) become types once, in `make_line_solver`; from there
/// to the end of a point nothing is looked up by name. One virtual call per point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "observables/list.hpp"
#include "plan/grid.hpp"
#include "scene/scene.hpp"
#include "solve/point_status.hpp"
#include "solve/work_meter.hpp"

namespace rubatlas::solve {

/// x, y [m], dx/dτ, dy/dτ [m]: the shaft centre at phase 0, from its own equilibrium (MODEL 1).
using SectionState = std::array<double, 4>;

/// What effects remember from point to point besides the state, in the order of `observables::memories`.
/// Small enough to go along in any message.
class Memory {
 public:
  static constexpr std::size_t kMost = 64;  ///< numbers; fifty blades, and a ring

  Memory() = default;
  explicit Memory(std::span<const double> values) : count_(static_cast<std::uint32_t>(values.size())) {
    if (values.size() > kMost) throw std::length_error("effects remember too much");
    std::copy(values.begin(), values.end(), values_.begin());
  }
  [[nodiscard]] std::span<const double> view() const { return {values_.data(), count_}; }
  /// Bytes at the end of a Memory that say nothing.
  [[nodiscard]] std::size_t unused_bytes() const { return sizeof(double) * (kMost - count_); }

 private:
  std::uint32_t count_ = 0;
  std::array<double, kMost> values_{};
};

/// What a point starts from.
struct PointStart {
  PointStart() = default;
  // A state alone is a start. NOLINTNEXTLINE(google-explicit-constructor)
  PointStart(const SectionState& from, const Memory& remembered = {}) : state(from), memory(remembered) {}
  SectionState state{};
  Memory memory;  ///< empty: as new
};

/// Counts that tell what a point cost; never part of the atlas.
struct WorkCounts {
  std::uint64_t revolutions = 0;  ///< that came to their end
  std::uint64_t right_hand_sides = 0;
  std::uint64_t steps = 0;
  std::uint64_t rejected_steps = 0;
  std::uint64_t touchdowns = 0;
  std::uint64_t liftoffs = 0;
  std::uint64_t slip_reversals = 0;
  std::uint64_t slip_accumulations = 0;    ///< of reversals, in whose limit a tip comes to rest
  std::uint64_t gap_evaluations = 0;       ///< in flight
  std::uint64_t elastica_evaluations = 0;  ///< of the blade's curve, wherever a force is asked for
  std::int64_t price = 0;                  ///< of all of it, as the bound of a revolution counts it [ns]

  WorkCounts& operator+=(const WorkCounts& more) {
    revolutions += more.revolutions;
    right_hand_sides += more.right_hand_sides;
    steps += more.steps;
    rejected_steps += more.rejected_steps;
    touchdowns += more.touchdowns;
    liftoffs += more.liftoffs;
    slip_reversals += more.slip_reversals;
    slip_accumulations += more.slip_accumulations;
    gap_evaluations += more.gap_evaluations;
    elastica_evaluations += more.elastica_evaluations;
    price += more.price;
    return *this;
  }
};

struct PointOutcome {
  PointStatus status = PointStatus::pending;
  StatusDetail detail = StatusDetail::none;  ///< what ended the point, where it is not done
  std::int32_t failed_revolution = -1;       ///< counted from 0 through the transient; −1 when done
  SectionState final_state{};                ///< after the last revolution; NaN when not done
  Memory final_memory;                       ///< beside it; empty where no effect has one
  observables::Rows rows;                    ///< as `observables::descriptions(scene)`
  WorkCounts work;
};

/// The forces of contacts over their times, closer than a uniform grid of time can have them: contact after
/// contact in the order in which they begin, of each both ends, every peak, and what lies between.
struct ContactSamples {
  std::vector<std::int32_t> number;  ///< of the contact, from 0
  std::vector<std::int32_t> blade;   ///< from 0
  std::vector<double> time;   ///< τ [-] as in the orbit; ascends within a contact, twice the same at a jump
  std::vector<double> force;  ///< normal force F [N]
  std::vector<SectionState> state;
};

/// One point's motion on a uniform grid of time over the sampled revolutions, and its contacts.
struct Orbit {
  PointStatus status = PointStatus::pending;
  StatusDetail detail = StatusDetail::none;
  std::int32_t failed_revolution = -1;
  std::vector<double> time;            ///< τ [-] from the start of the sampled revolutions
  std::vector<SectionState> state;     ///< one per time
  std::vector<double> force;           ///< [time][blade], normal force F on each blade [N]
  std::vector<SectionState> sections;  ///< Poincaré sections, one per sampled revolution
  ContactSamples contacts;
};

class LineSolver {
 public:
  virtual ~LineSolver() = default;

  /// Runs transient and sampled revolutions at one speed ratio from `start`. `go_on` is asked after each
  /// revolution and every few milliseconds within (a rank answers its messages there): false gives the point
  /// up, which is then pending. Empty: nobody asks.
  virtual PointOutcome run(double speed_ratio, const PointStart& start, const GoOn& go_on = {}) = 0;

  /// The same motion, kept as `samples_per_revolution` samples over the sampled revolutions.
  virtual Orbit orbit(double speed_ratio, const PointStart& start) = 0;
};

/// Blade tables, one per friction coefficient, made on first use and shared by all lines of a rank.
class BladeTables;
std::shared_ptr<BladeTables> make_blade_tables();

/// `line` gives damping ratio, friction, unbalance and thickness; its speed ratio is not read.
std::unique_ptr<LineSolver> make_line_solver(const scene::Scene& scene, const plan::PointParameters& line,
                                             const std::shared_ptr<BladeTables>& tables);

}  // namespace rubatlas::solve
