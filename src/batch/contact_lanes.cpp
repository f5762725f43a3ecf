#include "batch/contact_lanes.hpp"

#include <cstddef>

namespace rubatlas::batch {
namespace {

/// Lanes left over repeat the first.
template <int kLanes>
void pack(std::span<LaneRequest* const> requests, LaneBlock<kLanes>& block) {
  block.any_unbalance = false;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const LaneRequest& request = *requests[i < requests.size() ? i : 0];
    const contact::ElasticaContact& law = *request.law;
    block.request[i] = &request;
    block.curve[i] = &law.curve();
    block.any_unbalance = block.any_unbalance || request.unbalance != nullptr;
    for (int c = 0; c < 6; ++c) {
      block.start[c].lane[i] = request.step->start()[c];
      block.stages[0][c].lane[i] = request.step->start_derivative()[c];
    }
    block.size.lane[i] = request.size;
    block.speed.lane[i] = request.blades->angular_speed(request.anchor.time);
    block.damping_ratio.lane[i] = request.rotor->damping_ratio;
    block.force_unit.lane[i] = request.rotor->force_unit;
    block.misalignment.lane[i] = request.rotor->misalignment;
    block.reach.lane[i] = law.geometry().reach;
    block.ring_radius.lane[i] = law.geometry().ring_radius;
    block.length.lane[i] = law.length();
    block.load_unit.lane[i] = law.load_unit();
    block.strain_unit.lane[i] = law.strain_unit();
    block.friction.lane[i] = law.curve().friction();
    block.mirror.lane[i] = law.curve().mirror();
    block.scale.lane[i] = request.scale;
    block.slip.lane[i] = request.slip;
    block.anchor_time.lane[i] = request.anchor.time;
    block.anchor_cosine.lane[i] = request.anchor.direction.cosine;
    block.anchor_sine.lane[i] = request.anchor.direction.sine;
  }
}

template <int kLanes>
void unpack(const LaneBlock<kLanes>& block, std::span<LaneRequest* const> requests) {
  for (std::size_t i = 0; i < requests.size(); ++i) {
    LaneRequest& request = *requests[i];
    request.finite = request.step->adopt(request.size, [&](auto& stages, auto& end) {
      for (std::size_t s = 1; s <= kEvaluationsOfAttempt; ++s) {
        for (int c = 0; c < 6; ++c) stages[s][c] = block.stages[s][c].lane[i];
      }
      for (int c = 0; c < 6; ++c) end[c] = block.end[c].lane[i];
    });
    request.last = {{block.force_radial.lane[i], block.force_tangential.lane[i], block.load.lane[i],
                     block.shortening.lane[i], block.root_strain.lane[i], block.slip_velocity.lane[i]},
                    block.residual.lane[i],
                    block.bending_slope.lane[i],
                    block.time_slope.lane[i]};
    request.acceleration = {block.acceleration_x.lane[i], block.acceleration_y.lane[i]};
  }
}

}  // namespace

ContactLanes::ContactLanes(int width) : four_(std::make_unique<LaneBlock<4>>()) {
  if (width > 4) eight_ = std::make_unique<LaneBlock<8>>();
}

void ContactLanes::attempt(std::span<LaneRequest* const> requests) {
  if (requests.size() > 4) {
    pack(requests, *eight_);
    attempt_avx512(*eight_);
    unpack(*eight_, requests);
  } else {
    pack(requests, *four_);
    attempt_avx2(*four_);
    unpack(*four_, requests);
  }
}

void direct(const LaneRequest& request, double time, double& cosine, double& sine) {
  const contact::BladeDirection er = request.blades->direction_near(request.anchor, time);
  cosine = er.cosine;
  sine = er.sine;
}

void unbalance(const LaneRequest& request, double time, double& x, double& y) {
  if (request.unbalance == nullptr) return;
  const std::complex<double> acceleration = request.unbalance->acceleration(time);
  x = acceleration.real();
  y = acceleration.imag();
}

int lanes_of_processor() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return 8;
  if (__builtin_cpu_supports("avx2")) return 4;
#endif
  return 1;
}

}  // namespace rubatlas::batch
