// Attempts of contact steps in lanes against the scalar path, bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "batch/contact_lanes.hpp"
#include "batch/lane_request.hpp"
#include "contact/elastica_contact.hpp"
#include "motion/modes_of_axial_loads.hpp"
#include "motion/motion.hpp"

namespace rubatlas::batch {
namespace {

constexpr double kTolerance = 1e-11;  // m

/// One attempt, to be made in a lane and alone.
struct Asked {
  virtual ~Asked() = default;
  virtual LaneRequest& begin_in_lane() = 0;
  virtual void expect_as_alone() = 0;
};

/// The same bits; where there is no number, none on both sides (which of the many is nobody's to keep).
void expect_same(double one, double other) {
  if (std::isnan(one) && std::isnan(other)) return;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(one), std::bit_cast<std::uint64_t>(other)) << one << " " << other;
}

template <class Forcing>
class AskedUnder final : public Asked {
 public:
  using System = modes::Carried<contact::ElasticaContact, Forcing>;
  AskedUnder(const System& system, const rotor::ContactState& state, double size)
      : system_(system), state_(state), size_(size), in_lane_(system) {}

  LaneRequest& begin_in_lane() override {
    in_lane_ = system_;
    step_in_lane_.begin(in_lane_, state_);
    request_.emplace(in_lane_, step_in_lane_, size_);
    return *request_;
  }

  void expect_as_alone() override {
    in_lane_.adopt(request_->last, request_->acceleration, kEvaluationsOfAttempt);
    System alone = system_;
    LaneStep step;
    step.begin(alone, state_);
    EXPECT_EQ(request_->finite, step.attempt(alone, size_));
    const auto all = [](const auto& vector, const auto& other) {
      for (int c = 0; c < 6; ++c) expect_same(vector[c], other[c]);
    };
    all(step_in_lane_.start(), step.start());
    all(step_in_lane_.end(), step.end());
    all(step_in_lane_.end_derivative(), step.end_derivative());
    expect_same(step_in_lane_.size(), step.size());
    const auto norm = [](const auto& d) { return d.abs().maxCoeff(); };
    expect_same(step_in_lane_.error_estimate(norm), step.error_estimate(norm));  // of all stages
    expect_same(in_lane_.last().residual, alone.last().residual);
    expect_same(in_lane_.last().bending_slope, alone.last().bending_slope);
    expect_same(in_lane_.last().time_slope, alone.last().time_slope);
    const contact::TipForce& force = in_lane_.last().force;
    const contact::TipForce& other = alone.last().force;
    expect_same(force.radial, other.radial);
    expect_same(force.tangential, other.tangential);
    expect_same(force.normal, other.normal);
    expect_same(force.shortening, other.shortening);
    expect_same(force.root_strain, other.root_strain);
    expect_same(force.slip_velocity, other.slip_velocity);
    expect_same(in_lane_.last_acceleration().real(), alone.last_acceleration().real());
    expect_same(in_lane_.last_acceleration().imag(), alone.last_acceleration().imag());
    EXPECT_EQ(in_lane_.evaluations(), alone.evaluations());
    ASSERT_TRUE(step.make_dense(alone) && step_in_lane_.make_dense(in_lane_));
    all(step_in_lane_.interpolate(0.3), step.interpolate(0.3));
  }

 private:
  System system_;  ///< opened, and anchored at the start of the step
  rotor::ContactState state_;
  double size_;
  System in_lane_;
  LaneStep step_in_lane_;
  std::optional<LaneRequest> request_;
};

class TouchDowns final : public modes::MotionListener {
 public:
  void event(const modes::Event& event) override {
    if (event.kind == modes::Guard::touch_down) events.push_back(event);
  }
  std::vector<modes::Event> events;
};

/// A rotor, its blades, and what its contacts ask for.
template <class Forcing>
class Machine {
 public:
  Machine(double speed_ratio, double damping_ratio, double friction, double thickness, const Forcing& forcing)
      : rotor_{speed_ratio, damping_ratio, 0.01001, 0.01, 0.01},
        blades_(3, speed_ratio),
        law_({0.1, 0.11}, {0.1, thickness, 206e9 * 0.01 * std::pow(thickness, 3) / 12.0},
             std::make_shared<blade::ElasticaCurve>(friction)),
        forcing_(forcing) {}

  /// Attempts at sizes that keep the tolerance and at some that do not, up to past lift-off.
  void ask(std::vector<std::unique_ptr<Asked>>& asked) {
    motion::Motion<contact::ElasticaContact, Forcing> motion(rotor_, blades_, law_, forcing_,
                                                             {kTolerance, 0.5});
    TouchDowns seen;
    ASSERT_EQ(motion.start(rotor::State::Zero()), point::PointStatus::done);
    for (int i = 0; i < 6; ++i) motion.revolution(seen);
    ASSERT_FALSE(seen.events.empty());
    for (const modes::Event& event : seen.events) {
      modes::Carried<contact::ElasticaContact, Forcing> system(
          {&rotor_, &blades_, &law_, &forcing_, {kTolerance, 0.5}, &meter_});
      rotor::ContactState state;
      if (!system.open(event.time, event.state, {{event.blade, event.slip, 0.0}}, state)) continue;
      double size = 0.1;
      for (int i = 0; i < 20 && state[rotor::kBending] >= 0.0; ++i) {
        system.begins_step(state);
        LaneStep step;
        step.begin(system, state);
        for (const double factor : {1.0, 3.0, 30.0, 1e6, 1e200}) {
          asked.push_back(std::make_unique<AskedUnder<Forcing>>(system, state, factor * size));
        }
        step.attempt(system, size);
        const double error =
            step.error_estimate([](const auto& d) { return d.template head<4>().abs().maxCoeff(); });
        if (error < kTolerance) state = step.end();
        size *= std::clamp(0.9 * std::pow(error / kTolerance, -1.0 / 8), 0.2, 5.0);
      }
    }
  }

 private:
  rotor::RotorConstants rotor_;
  rotor::BladeSet blades_;
  contact::ElasticaContact law_;
  Forcing forcing_;
  modes::WorkMeter meter_;
};

/// By attempts side by side, as many as the processor has lanes.
class Lanes : public testing::TestWithParam<int> {
 protected:
  Lanes() {
    for (const double friction : {0.1, 0.5, 0.0}) {
      for (const double speed_ratio : {0.15, 0.36, 0.62}) {
        const double thickness = speed_ratio < 0.5 ? 0.001 : 0.0007;
        steady_.emplace_back(speed_ratio, 0.1, friction, thickness, rotor::NoForcing{});
        unbalanced_.emplace_back(speed_ratio, 0.05, friction, thickness,
                                 rotor::RotatingUnbalance(1e-4, 0.3, speed_ratio, 0.05));
      }
    }
    for (auto& machine : steady_) machine.ask(asked_);
    for (auto& machine : unbalanced_) machine.ask(asked_);
    // Neighbours in a batch are of different machines and sizes: strides through the list.
    for (std::size_t stride = 0; stride < kStride; ++stride) {
      for (std::size_t i = stride; i < asked_.size(); i += kStride) order_.push_back(asked_[i].get());
    }
  }

  void expect_same_bits(std::size_t in_a_batch) {
    ContactLanes lanes(lanes_of_processor());
    ASSERT_GT(order_.size(), 1000U);
    for (std::size_t first = 0; first + in_a_batch <= order_.size() && !HasFailure(); first += in_a_batch) {
      std::vector<LaneRequest*> requests;
      for (std::size_t i = 0; i < in_a_batch; ++i) requests.push_back(&order_[first + i]->begin_in_lane());
      lanes.attempt(requests);
      for (std::size_t i = 0; i < in_a_batch; ++i) order_[first + i]->expect_as_alone();
    }
  }

 private:
  static constexpr std::size_t kStride = 173;
  std::list<Machine<rotor::NoForcing>> steady_;  // requests point at them
  std::list<Machine<rotor::RotatingUnbalance>> unbalanced_;
  std::vector<std::unique_ptr<Asked>> asked_;
  std::vector<Asked*> order_;
};

TEST_P(Lanes, AttemptsHaveTheBitsOfTheScalarPath) {
  expect_same_bits(static_cast<std::size_t>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(SideBySide, Lanes, testing::Range(2, lanes_of_processor() + 1),
                         testing::PrintToStringParamName());
// Where the processor has none no batch is made (`LineBatch`), and there is nothing to compare.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Lanes);

}  // namespace
}  // namespace rubatlas::batch
