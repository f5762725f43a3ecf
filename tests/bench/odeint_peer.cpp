/// Boost.odeint: Dormand–Prince 5(4) with step control and dense output.
///
/// With event location, g of each blade is looked at after each step, and a change of sign is located on
/// dense output; integration starts anew there with the contact opened or closed.
#include <algorithm>
#include <boost/numeric/odeint.hpp>

#include "contact_rotor.hpp"
#include "integrate/root_between.hpp"
#include "peer.hpp"
#include "problem.hpp"

namespace rubatlas::bench {
namespace {

namespace odeint = boost::numeric::odeint;
using DormandPrince = odeint::runge_kutta_dopri5<PeerState>;
using Dense = odeint::result_of::make_dense_output<DormandPrince>::type;

constexpr double kFirstStep = 1e-3;      ///< in τ
constexpr double kShortestStep = 1e-12;  ///< in τ

/// A stage at which the contact force does not exist (MODEL 5).
struct NoForce {};

/// The rotor of a point, and its right-hand side as odeint calls it.
struct PointRotor {
  explicit PointRotor(double speed_ratio)
      : rotor(rotor_of(settings::Scene(), speed_ratio), settings::Scene().blades.count,
              contact_of(settings::Scene(), shared_tables().curve)) {}
  ContactRotor rotor;

  auto by_gap() {
    return [this](const PeerState& state, PeerState& rates, double time) {
      if (!rotor.evaluate_by_gap(time, state.data(), rates.data())) throw NoForce{};
    };
  }
  auto with_open_contacts() {
    return [this](const PeerState& state, PeerState& rates, double time) {
      if (!rotor.evaluate(time, state.data(), rates.data())) throw NoForce{};
    };
  }
};

/// Errors are absolute, as those of `hybrid`: tolerance × δc.
Dense dense_stepper(const ContactRotor& rotor, const PeerSettings& settings) {
  return odeint::make_dense_output(settings.tolerance * rotor.clearance(), 0.0, settings.max_step,
                                   DormandPrince());
}

PeerRun finish(PeerRun run, const ContactRotor& rotor, bool completed) {
  run.completed = completed;
  run.work.right_hand_sides = rotor.right_hand_sides();
  run.work.touchdowns = rotor.touchdowns();
  return run;
}

/// One step; a shorter one where a stage asks for a force where there is none.
template <class System>
void make_step(Dense& stepper, const System& system) {
  while (true) {
    try {
      stepper.do_step(system);
      return;
    } catch (const NoForce&) {
      const double step = 0.25 * stepper.current_time_step();
      if (step < kShortestStep) throw;
      const PeerState state = stepper.current_state();
      stepper.initialize(state, stepper.current_time(), step);
    }
  }
}

/// Reads the sections that a step has passed, up to a time, off its dense output.
void read_sections(Dense& stepper, double period, double until, std::size_t most, PeerRun& run) {
  while (run.sections.size() < most) {
    const double time = static_cast<double>(run.sections.size() + 1) * period;
    if (time > until) return;
    PeerState section;
    stepper.calc_state(time, section);
    run.sections.push_back(section);
  }
}

class OdeintDopri5 final : public Peer {
 public:
  using Peer::Peer;

  [[nodiscard]] PeerRun run(double speed_ratio, int revolutions,
                            const PeerSettings& settings) const override {
    PointRotor point(speed_ratio);
    Dense stepper = dense_stepper(point.rotor, settings);
    stepper.initialize(PeerState{}, 0.0, kFirstStep);
    const auto most = static_cast<std::size_t>(revolutions);
    PeerRun run;
    try {
      while (run.sections.size() < most) {
        make_step(stepper, point.by_gap());
        point.rotor.count_touchdowns(stepper.current_time(), stepper.current_state().data());
        read_sections(stepper, point.rotor.period(), stepper.current_time(), most, run);
      }
    } catch (const NoForce&) {
      return finish(std::move(run), point.rotor, false);
    }
    return finish(std::move(run), point.rotor, true);
  }
};

class OdeintDopri5Located final : public Peer {
 public:
  using Peer::Peer;

  [[nodiscard]] PeerRun run(double speed_ratio, int revolutions,
                            const PeerSettings& settings) const override {
    PointRotor point(speed_ratio);
    Dense stepper = dense_stepper(point.rotor, settings);
    stepper.initialize(PeerState{}, 0.0, kFirstStep);
    const auto most = static_cast<std::size_t>(revolutions);
    PeerRun run;
    PeerState state;
    try {
      while (run.sections.size() < most) {
        make_step(stepper, point.with_open_contacts());
        const Event event = first_event(point.rotor, stepper);
        read_sections(stepper, point.rotor.period(), std::min(event.time, stepper.current_time()), most, run);
        if (event.blade < 0) continue;
        const double step = stepper.current_time_step();
        stepper.calc_state(event.time, state);
        if (point.rotor.is_open(event.blade)) {
          point.rotor.lift_off(event.blade);
        } else {
          point.rotor.touch_down(event.blade, event.time, state.data());
        }
        stepper.initialize(state, event.time, step);
      }
    } catch (const NoForce&) {
      return finish(std::move(run), point.rotor, false);
    }
    return finish(std::move(run), point.rotor, true);
  }

 private:
  struct Event {
    int blade = -1;
    double time = std::numeric_limits<double>::infinity();
  };

  /// First change of sign of a gap in the step just made.
  static Event first_event(const ContactRotor& rotor, const Dense& stepper) {
    Event first;
    for (int k = 0; k < rotor.blade_count(); ++k) {
      const double sign = rotor.is_open(k) ? -1.0 : 1.0;
      if (sign * rotor.gap(k, stepper.current_time(), stepper.current_state().data()) <= 0.0) continue;
      const double time = crossing(rotor, stepper, k, sign);
      if (time < first.time) first = {k, time};
    }
    return first;
  }

  /// Where sign · g of a blade turns positive, known to be so at the end of the step.
  static double crossing(const ContactRotor& rotor, const Dense& stepper, int blade, double sign) {
    const auto function = [&](double time) {
      PeerState state;
      stepper.calc_state(time, state);
      return sign * rotor.gap(blade, time, state.data());
    };
    const double begin = stepper.previous_time();
    const double end = stepper.current_time();
    // A blade whose contact has opened or closed at the start of this step has g = 0 there, to rounding:
    // leave that zero behind.
    double from = begin;
    double at_from = function(from);
    for (double part = kLeaveBehind; !(at_from < 0.0) && part < 1.0; part *= 4.0) {
      from = begin + part * (end - begin);
      at_from = function(from);
    }
    return integrate::root_between(function, from, end, at_from, function(end));
  }

  static constexpr double kLeaveBehind = 1e-6;  ///< of a step
};

}  // namespace

std::unique_ptr<Peer> make_odeint_dopri5() {
  return std::make_unique<OdeintDopri5>("odeint", "dopri5");
}
std::unique_ptr<Peer> make_odeint_dopri5_located() {
  return std::make_unique<OdeintDopri5Located>("odeint", "dopri5, events located");
}

}  // namespace rubatlas::bench
