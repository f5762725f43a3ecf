#include "contact_rotor.hpp"

#include <algorithm>

namespace rubatlas::bench {

ContactRotor::ContactRotor(const rotor::RotorConstants& rotor, int blade_count,
                           const contact::ElasticaContact& law)
    : machine_{rotor, rotor::BladeSet(blade_count, rotor.speed_ratio), {rotor::Harmonics({})}, {}},
      law_(std::vector(static_cast<std::size_t>(machine_.blades.count()), law)),
      system_({&machine_, &law_, {0.0, 1.0}, &meter_}),
      open_(static_cast<std::size_t>(blade_count), false),
      bending_(static_cast<std::size_t>(blade_count), 0.0) {
  contacts_.reserve(static_cast<std::size_t>(blade_count));
}

bool ContactRotor::evaluate(double time, const double* state, double* rates) {
  rotor::ContactState full;
  full << state[0], state[1], state[2], state[3], time, 0.0, 0.0, 0.0, 0.0, 0.0;
  rotor::ContactState derivative;
  if (!system_(full, derivative)) return false;
  std::copy_n(derivative.data(), 4, rates);
  return true;
}

bool ContactRotor::evaluate_by_gap(double time, const double* state, double* rates) {
  for (const modes::OpenContact& contact : system_.contacts())
    bending_[static_cast<std::size_t>(contact.blade)] = contact.bending;
  contacts_.clear();
  const contact::BladeDirection first = machine_.blades.first(time);
  const rotor::State at(state[0], state[1], state[2], state[3]);
  for (int k = 0; k < blade_count(); ++k) {
    const contact::Pose there =
        rotor::pose_of(machine_.constants, law_.geometry(0), machine_.blades.direction(k, first), at);
    if (there.gap > 0.0) contacts_.push_back({k, slip(there), bending_[static_cast<std::size_t>(k)]});
  }
  open_contacts();
  return evaluate(time, state, rates);
}

double ContactRotor::gap(int blade, double time, const double* state) const {
  return pose(blade, time, state).gap;
}

double ContactRotor::gap_rate(int blade, double time, const double* state) const {
  return contact::gap_rate(law_.geometry(0), pose(blade, time, state), machine_.constants.speed_ratio);
}

void ContactRotor::touch_down(int blade, double time, const double* state) {
  ++touchdowns_;
  open_[static_cast<std::size_t>(blade)] = true;
  contacts_ = system_.contacts();
  contacts_.push_back({blade, slip(pose(blade, time, state)), 0.0});
  open_contacts();
}

void ContactRotor::lift_off(int blade) {
  open_[static_cast<std::size_t>(blade)] = false;
  contacts_ = system_.contacts();
  std::erase_if(contacts_, [blade](const modes::OpenContact& contact) { return contact.blade == blade; });
  open_contacts();
}

void ContactRotor::count_touchdowns(double time, const double* state) {
  for (int k = 0; k < blade_count(); ++k) {
    const bool touches = gap(k, time, state) > 0.0;
    if (touches && !is_open(k)) ++touchdowns_;
    open_[static_cast<std::size_t>(k)] = touches;
  }
}

contact::Pose ContactRotor::pose(int blade, double time, const double* state) const {
  return rotor::pose_of(machine_.constants, law_.geometry(0),
                        machine_.blades.direction(blade, machine_.blades.first(time)), rotor::State(state));
}

double ContactRotor::slip(const contact::Pose& at) const {
  return contact::undeformed_slip_velocity(law_.geometry(0), at, machine_.constants.speed_ratio) >= 0.0
             ? 1.0
             : -1.0;
}

}  // namespace rubatlas::bench
