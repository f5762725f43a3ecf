/// Trial: attempts of contact steps of eight independent motions, one in each SIMD lane (README).
///
///   batch_trial
///
/// The lanes do the operations of `CarriedContact` and `RungeKutta::attempt` in the same order, so that each
/// has the bits of the scalar path; that is checked. Only what the next stage needs is computed in lanes: in
/// their favour.
#include <fmt/core.h>
#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <utility>
#include <vector>

#include "effects/unbalance.hpp"
#include "problem.hpp"
#include "solve/motion.hpp"

namespace {
using namespace rubatlas;
using Pair = integrate::DormandPrince853;
using System = solve::CarriedContact<contact::ElasticaContact, effects::NoForcing>;
using Step = integrate::RungeKutta<Pair, 6>;

// Private members that lanes gather from: naming them in an explicit instantiation is legal.
auto pieces_member();
auto index_member();
auto scale_member();
template <auto kMember>
struct Pieces {
  friend auto pieces_member() { return kMember; }
};
template <auto kMember>
struct Index {
  friend auto index_member() { return kMember; }
};
template <auto kMember>
struct Scale {
  friend auto scale_member() { return kMember; }
};
template struct Pieces<&blade::ElasticaCurve::pieces_>;
template struct Index<&blade::ElasticaCurve::index>;
template struct Scale<&System::scale_>;

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

#pragma GCC push_options
#pragma GCC target("avx2,fma,avx512f,avx512dq,avx512vl,prefer-vector-width=512")
constexpr int kLanes = 8;
typedef double Lanes __attribute__((vector_size(64)));

struct Batch {
  Lanes start[6], stages[13][6], end[6], size;
  Lanes speed, scale, slip, anchor_time, anchor_cosine, anchor_sine;
  double damping, force_unit, misalignment, reach, closing, length, load_unit, friction, mirror;
  const Request* lane[kLanes];
  const Point* points;
  const blade::ElasticaCurve* curve;
};

__attribute__((always_inline)) inline void lanes_rhs(const Batch& b, const Lanes* z, Lanes* d) {
  const Lanes angle = b.speed * (z[4] - b.anchor_time);
  const Lanes square = angle * angle;
  const Lanes fourth = square * square;
  const Lanes sine = angle + (angle * square) * ((-1.0 / 6 + square * (1.0 / 120)) +
                                                 fourth * (-1.0 / 5040 + square * (1.0 / 362880)));
  const Lanes less = square * ((-0.5 + square * (1.0 / 24)) + fourth * (-1.0 / 720 + square * (1.0 / 40320)));
  Lanes ec = b.anchor_cosine + (b.anchor_cosine * less - b.anchor_sine * sine);
  Lanes es = b.anchor_sine + (b.anchor_sine * less + b.anchor_cosine * sine);
  const auto& pieces = b.curve->*pieces_member();
  const double* base[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    if (!(square[i] < 0.0039)) {
      const auto& blades = b.points[b.lane[i]->point].blades;
      const auto er = blades.direction(b.lane[i]->contact.blade, blades.first(z[4][i]));
      ec[i] = er.cosine;
      es[i] = er.sine;
    }
    base[i] = &pieces[(b.curve->*index_member())(std::abs(z[5][i]))].centre;
  }
  const __m512i address = _mm512_loadu_si512(base);
  const auto gather = [&](std::size_t offset) __attribute__((always_inline)) {
    return static_cast<Lanes>(_mm512_i64gather_pd(
        _mm512_add_epi64(address, _mm512_set1_epi64(static_cast<long long>(8 * offset))), nullptr, 1));
  };
  const std::size_t first = static_cast<std::size_t>(pieces[0].coefficients[0].data() - &pieces[0].centre);
  const Lanes u = z[5];
  const Lanes magnitude = static_cast<Lanes>(_mm512_abs_pd(static_cast<__m512d>(u)));
  const Lanes inverse = gather(1);
  const Lanes t = (magnitude - gather(0)) * inverse;
  const Lanes t2 = t * t;
  Lanes value[3], slope[3];
  for (std::size_t m = 0; m < 3; ++m) {
    Lanes even = gather(first + 40 + m), odd = gather(first + 44 + m), even_slope{}, odd_slope{};
    for (std::size_t k = 10; k >= 2; k -= 2) {
      even_slope = even_slope * t2 + even;
      odd_slope = odd_slope * t2 + odd;
      even = even * t2 + gather(first + 4 * (k - 2) + m);
      odd = odd * t2 + gather(first + 4 * (k - 1) + m);
    }
    value[m] = even + t * odd;
    slope[m] = (odd + (2.0 * t) * (even_slope + t * odd_slope)) * inverse;
  }
  const Lanes one = Lanes{} + 1.0;
  const Lanes sign = u < 0.0 ? -one : one;
  const Lanes parity = u < 0.0 ? one * b.mirror : one;
  value[2] *= parity;
  slope[1] *= sign;
  slope[2] *= sign * parity;
  const Lanes cy = z[1] + b.misalignment;
  const Lanes radial = z[0] * ec + cy * es, tangential = cy * ec - z[0] * es;
  const Lanes vr = z[2] * ec + z[3] * es, vt = z[3] * ec - z[2] * es;
  const Lanes A = radial + b.reach - b.length * value[1];
  const Lanes B = tangential - b.slip * (b.length * value[2]);
  const Lanes bending_slope = (-2.0 * b.length) * (A * slope[1] + b.slip * B * slope[2]);
  const Lanes time_slope = 2.0 * A * (vr + b.speed * tangential) + 2.0 * B * (vt - b.speed * radial);
  const Lanes inverse_distance =
      1.0 / static_cast<Lanes>(_mm512_sqrt_pd(static_cast<__m512d>(A * A + B * B)));
  const Lanes nr = A * inverse_distance, nt = B * inverse_distance;
  const Lanes load = b.load_unit * value[0];
  const Lanes friction = b.slip * b.friction * load;
  const Lanes fr = -load * nr + friction * nt, ft = -load * nt - friction * nr;
  const Lanes rate = -b.scale * bending_slope;
  d[0] = rate * z[2];
  d[1] = rate * z[3];
  d[2] = rate * ((fr * ec - ft * es) * b.force_unit - b.damping * z[2] - z[0]);
  d[3] = rate * ((fr * es + ft * ec) * b.force_unit - b.damping * z[3] - z[1]);
  d[4] = rate;
  d[5] = b.scale * time_slope;
}

template <std::size_t kRow>
__attribute__((always_inline)) inline void lanes_state(const Batch& b, Lanes* z) {
  for (int c = 0; c < 6; ++c) {
    Lanes sum{};
    bool first = true;
#pragma GCC unroll 12
    for (std::size_t j = 0; j < 12; ++j) {
      const double w = kRow == 12 ? Pair::kWeight[j] : Pair::kStage[kRow][j];
      if (w == 0.0) continue;
      sum = first ? w * b.stages[j][c] : sum + w * b.stages[j][c];
      first = false;
    }
    z[c] = b.start[c] + b.size * sum;
  }
}

__attribute__((noinline)) void lanes_stage(const Batch& b, const Lanes* z, Lanes* d) {
  lanes_rhs(b, z, d);
}

__attribute__((noinline)) void lanes_attempt(Batch& b) {
  [&]<std::size_t... kI>(std::index_sequence<kI...>) __attribute__((always_inline)) {
    (([&]() __attribute__((always_inline)) {
       Lanes z[6];
       lanes_state<kI + 1>(b, z);
       lanes_stage(b, z, b.stages[kI + 1]);
     }()),
     ...);
  }
  (std::make_index_sequence<11>{});
  lanes_state<12>(b, b.end);
  lanes_stage(b, b.end, b.stages[12]);
}

__attribute__((noinline)) void pack(Batch& b, const Request* requests) {
  for (int i = 0; i < kLanes; ++i) {
    const Request& r = requests[i];
    const Point& p = b.points[r.point];
    b.lane[i] = &r;
    for (int c = 0; c < 6; ++c) {
      b.start[c][i] = r.step.start()[c];
      b.stages[0][c][i] = r.step.start_derivative()[c];
    }
    b.size[i] = r.size;
    b.speed[i] = p.rotor.speed_ratio;
    b.scale[i] = r.system.*scale_member();
    b.slip[i] = r.contact.slip;
    b.anchor_time[i] = r.step.start()[4];
    const auto er = p.blades.direction(r.contact.blade, p.blades.first(r.step.start()[4]));
    b.anchor_cosine[i] = er.cosine;
    b.anchor_sine[i] = er.sine;
  }
}
#pragma GCC pop_options

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
        points[i].rotor, scene.blades.count, law, none, {tolerance, scene.validity.max_shortening});
    TouchDowns seen;
    motion.start(solve::State::Zero());
    for (int k = 0; k < 12; ++k) motion.revolution(seen);
    for (const auto& event : seen.events) record(i, points[i], law, event, tolerance, of_point[i]);
    shortest = std::min(shortest, of_point[i].size());
  }
  std::vector<Request> requests;  // one of each point in turn, as they come
  for (std::size_t k = 0; k < std::min<std::size_t>(shortest, 60); ++k)
    for (auto& list : of_point) requests.push_back(list[k]);
  Batch b{};
  b.points = points.data();
  b.curve = curve.get();
  b.damping = 2.0 * points[0].rotor.damping_ratio;
  b.force_unit = points[0].rotor.force_unit;
  b.misalignment = points[0].rotor.misalignment;
  b.length = scene.blades.length;
  b.reach = law.geometry().reach;
  b.load_unit = scene.blades.youngs_modulus * scene.blades.width * std::pow(scene.blades.thickness, 3) /
                12.0 / (b.length * b.length);
  b.friction = curve->friction();
  b.mirror = b.friction > 0.0 ? 1.0 : -1.0;
  std::size_t different = 0;
  for (std::size_t k = 0; k + kLanes <= requests.size(); k += kLanes) {
    pack(b, &requests[k]);
    lanes_attempt(b);
    for (int i = 0; i < kLanes; ++i) {
      Request r = requests[k + static_cast<std::size_t>(i)];
      r.step.attempt(r.system, r.size);
      for (int c = 0; c < 6; ++c) {
        const double lane = b.end[c][i];
        const double alone = r.step.end()[c];
        const double lane_rate = b.stages[12][c][i];
        // An attempt too long may end in no number; which one is not the lanes' to keep.
        const auto same = [](double a, double b) {
          return std::memcmp(&a, &b, 8) == 0 || (a != a && b != b);
        };
        if (!same(lane, alone) || !same(lane_rate, r.step.end_derivative()[c])) ++different;
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
        pack(b, &requests[k]);
        lanes_attempt(b);
        sink += b.end[0][0];
      }
    const double t2 = now();
    for (int n = 0; n < 20; ++n)
      for (std::size_t k = 0; k + kLanes <= requests.size(); k += kLanes) lanes_attempt(b);
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
