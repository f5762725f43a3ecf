/// Contacts of one blade alone in a motion, and the start of an interval of one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../support/hybrid_motion.hpp"
#include "collocation/interval.hpp"
#include "modes/motion_listener.hpp"
#include "motion/point_motion.hpp"
#include "rotor/constants.hpp"

namespace rubatlas::test {

/// A contact of one blade alone: its touch-down and the event that ends it.
struct LoneContact {
  modes::Event start;
  modes::Event end;
};

/// Contacts that begin and end within a revolution, in which no other tip touches.
class LoneContacts final : public modes::MotionListener {
 public:
  explicit LoneContacts(int open) : open_(open) {}
  void event(const modes::Event& event) override {
    if (event.kind == modes::Guard::touch_down) {
      alone_ = ++open_ == 1;
      if (alone_) start_ = event;
      return;
    }
    if (alone_) found.push_back({start_, event});
    alone_ = false;
    if (event.kind == modes::Guard::lift_off) --open_;
  }
  void drops_open_contacts() { alone_ = false; }
  std::vector<LoneContact> found;

 private:
  int open_;
  bool alone_ = false;
  modes::Event start_{};
};

/// Those of the first revolutions of a motion, until there are `enough`; `open`: blades that touch where it
/// starts.
inline std::vector<LoneContact> lone_contacts(motion::PointMotion& motion, const rotor::State& start,
                                              int open, std::size_t enough = SIZE_MAX) {
  constexpr int kRevolutions = 5;
  LoneContacts contacts(open);
  if (motion.start(rotor::as_array(start)) != ending::StatusDetail::none) return {};
  for (int i = 0; i < kRevolutions && contacts.found.size() < enough; ++i) {
    if (revolve(motion, contacts) != ending::PointStatus::done) break;
    contacts.drops_open_contacts();
  }
  return contacts.found;
}

/// The machine of such an interval, and its blade without what a law of contact adds.
inline collocation::Machine machine_at_ring() {
  collocation::Machine machine{};
  machine.speed_ratio = 0.37;
  machine.damping_ratio = 0.1;
  machine.misalignment = 0.01001;
  machine.ring_radius = 0.11;
  machine.force_unit = 0.01;
  return machine;
}
inline collocation::Blade blade_at_ring() {
  collocation::Blade blade{};
  blade.reach = 0.1;
  blade.closing = -0.0021;
  return blade;
}
/// The start and the first guess of an interval: a blade that points down, of a hub of 0.1 m in a ring of
/// 0.11 m, and a shaft from which its tip just reaches the ring.
inline collocation::Interval interval_at_ring(double misalignment, const collocation::Blade& blade) {
  collocation::Interval first{};
  first.leader().blade = &blade;
  first.blade = {std::cos(-1.2), std::sin(-1.2)};
  const double x = 0.002;
  const double across = x * first.blade[0];
  const double y_from_ring =
      -0.1 * first.blade[1] - std::sqrt(std::pow(0.1 * first.blade[1], 2) - (x * x + 0.2 * across - 0.0021));
  first.shaft.start = {x, y_from_ring - misalignment, 0.01, -0.03};
  first.chord = {0.004, 0.4};
  first.normal = {-0.012, 0.12};
  for (std::size_t i = 0; i < collocation::kNodes; ++i) {
    const double node = collocation::kNodeTables.node[i];
    first.deviation[i] = 0.1 * node * (1.0 - node);
  }
  return first;
}

}  // namespace rubatlas::test
