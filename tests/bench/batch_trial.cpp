/// Trial: attempts of contact steps of eight independent motions, one in each SIMD lane (README).
///
///   batch_trial
///
/// The lanes do the operations of `CarriedContact` and `RungeKutta::attempt` in the same order, so that each
/// has the bits of the scalar path; that is checked.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <memory>
#include <span>
#include <vector>

#include "contact_lanes.hpp"
#include "effects/harmonic.hpp"
#include "problem.hpp"
#include "solve/motion.hpp"

namespace {
using namespace rubatlas;
using Pair = integrate::DormandPrince853;
using System = bench::LaneSystem;
using Step = bench::LaneStep;

constexpr std::size_t kLanes = 8;

/// One attempt that a motion asks for.
struct Request {
  std::size_t point;
  solve::OpenContact contact;
  System system;  ///< opened, anchored at the step's start
  Step step;      ///< begun
  double size;
};

struct Point {
  solve::RotorConstants rotor;
  solve::BladeSet blades;
};

class TouchDowns final : public solve::MotionListener {
 public:
  void event(const solve::Event& event) override {
    if (event.kind == solve::PhaseEvent::touch_down) events.push_back(event);
  }
  std::vector<solve::Event> events;
};

double now() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Attempts of one contact, with sizes that keep the tolerance.
void record(std::size_t index, const Point& point, const contact::ElasticaContact& law,
            const solve::Event& event, double tolerance, std::vector<Request>& requests) {
  static const effects::NoForcing kNone;
  System system(point.rotor, point.blades, law, kNone);
  solve::ContactState state;
  state << event.state, event.time, 0.0;
  const solve::OpenContact contact{event.blade, event.slip, 0.0};
  if (!system.open(contact, state)) return;
  double size = 0.1;
  Step step;
  for (int i = 0; i < 30; ++i) {
    system.anchor(state[solve::kTime]);
    step.begin(system, state);
    const Request request{index, contact, system, step, size};
    const bool done = step.attempt(system, size);
    const double error =
        step.error_estimate([](const auto& d) { return d.template head<4>().abs().maxCoeff(); });
    const double ratio = done ? error / (tolerance * Pair::kEstimateExcess) : 1e8;
    requests.push_back(request);
    requests.back().size = size;
    size *= std::clamp(0.9 * std::pow(std::max(ratio, 1e-16), -1.0 / 8), 0.2, 5.0);
    if (ratio > 1.0) continue;
    state = step.end();
    if (state[solve::kBending] <= 0.0) return;
  }
}

int run() {
  scene::Scene scene = bench::default_scene(30, 1e-9);
  const auto curve = std::make_shared<blade::ElasticaCurve>(scene.contact.friction);
  const auto law = bench::contact_of(scene, curve);
  const effects::NoForcing none;
  std::vector<Point> points;
  std::vector<std::vector<Request>> of_point(16);
  for (int i = 0; i < 16; ++i) {
    const double speed = 0.1 + 0.7 * i / 15;
    points.push_back({bench::rotor_of(scene, speed), {scene.blades.count, speed}});
  }
  const double tolerance = 1e-9 * scene.clearance();
  std::size_t shortest = 1000;
  for (std::size_t i = 0; i < points.size(); ++i) {
    solve::Motion<contact::ElasticaContact, effects::NoForcing> motion(
        points[i].rotor, points[i].blades, law, none, {tolerance, scene.validity.max_shortening});
    TouchDowns seen;
    motion.start(solve::State::Zero());
    for (int k = 0; k < 12; ++k) motion.revolution(seen);
    for (const auto& event : seen.events) record(i, points[i], law, event, tolerance, of_point[i]);
    shortest = std::min(shortest, of_point[i].size());
  }
  std::vector<Request> requests;  // one of each point in turn, as they come
  for (std::size_t k = 0; k < std::min<std::size_t>(shortest, 60); ++k)
    for (auto& list : of_point) requests.push_back(list[k]);
  std::vector<bench::LaneRequest> asked;
  for (Request& r : requests) asked.push_back({&r.system, &r.step, r.size});
  const auto eight = [&](std::size_t first) { return std::span(asked).subspan(first, kLanes); };
  const auto lanes_of = std::make_unique<bench::ContactLanes<kLanes>>();
  bench::ContactLanes<kLanes>& batch = *lanes_of;
  std::size_t different = 0;
  for (std::size_t k = 0; k + kLanes <= requests.size(); k += kLanes) {
    std::vector<Request> alone(requests.begin() + static_cast<std::ptrdiff_t>(k),
                               requests.begin() + static_cast<std::ptrdiff_t>(k + kLanes));
    batch.pack(eight(k));
    batch.attempt();
    batch.unpack();
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Request& in_lane = requests[k + i];
      alone[i].step.attempt(alone[i].system, alone[i].size);
      for (int c = 0; c < 6; ++c) {
        // An attempt too long may end in no number; which one is not the lanes' to keep.
        const auto same = [](double one, double other) {
          return std::memcmp(&one, &other, 8) == 0 || (one != one && other != other);
        };
        if (!same(in_lane.step.end()[c], alone[i].step.end()[c]) ||
            !same(in_lane.step.end_derivative()[c], alone[i].step.end_derivative()[c])) {
          ++different;
        }
      }
    }
  }
  std::vector<double> scalar, lanes, packed, ratio, packed_ratio;
  double sink = 0.0;
  const double count = 20.0 * static_cast<double>(requests.size());
  for (int repeat = 0; repeat < 31; ++repeat) {
    const double t0 = now();
    for (int n = 0; n < 20; ++n)
      for (Request& r : requests) r.step.attempt(r.system, r.size);
    const double t1 = now();
    for (int n = 0; n < 20; ++n)
      for (std::size_t k = 0; k + kLanes <= requests.size(); k += kLanes) {
        batch.pack(eight(k));
        batch.attempt();
        batch.unpack();
        if (std::isfinite(requests[k].step.end()[0])) sink += requests[k].step.end()[0];
      }
    const double t2 = now();
    for (int n = 0; n < 20; ++n)
      for (std::size_t k = 0; k + kLanes <= requests.size(); k += kLanes) batch.attempt();
    const double t3 = now();
    scalar.push_back((t1 - t0) / count * 1e9);
    packed.push_back((t2 - t1) / count * 1e9);
    lanes.push_back((t3 - t2) / count * 1e9);
    ratio.push_back((t1 - t0) / (t3 - t2));
    packed_ratio.push_back((t1 - t0) / (t2 - t1));
  }
  const auto median = [](std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + 15, v.end());
    return v[15];
  };
  fmt::print(
      "attempts {}\nnumbers with other bits {} of {}\nscalar_ns {:.0f}\nlanes_ns {:.0f}\npacked_ns {:.0f}\n",
      requests.size(), different, requests.size() * 6, median(scalar), median(lanes), median(packed));
  fmt::print("ratio {:.2f}\nratio_with_packing {:.2f}\nchecksum {:.3g}\n", median(ratio),
             median(packed_ratio), sink);
  return different == 0 ? 0 : 1;
}
}  // namespace

int main() {
  if (!__builtin_cpu_supports("avx512dq")) {
    fmt::print("batch_trial: this processor has no AVX-512\n");
    return 0;
  }
  return run();
}
