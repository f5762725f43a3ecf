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
      block.start[c][i] = request.step->start()[c];
      block.stages[0][c][i] = request.step->start_derivative()[c];
    }
    block.size[i] = request.size;
    block.speed[i] = request.blades->angular_speed(request.anchor.time);
    block.damping[i] = 2.0 * request.rotor->damping_ratio;
    block.force_unit[i] = request.rotor->force_unit;
    block.misalignment[i] = request.rotor->misalignment;
    block.reach[i] = law.geometry().reach;
    block.closing[i] = law.geometry().closing();
    block.length[i] = law.length();
    block.load_unit[i] = law.load_unit();
    block.strain_unit[i] = law.strain_unit();
    block.friction[i] = law.curve().friction();
    block.mirror[i] = law.curve().mirror();
    block.scale[i] = request.scale;
    block.slip[i] = request.slip;
    block.anchor_time[i] = request.anchor.time;
    block.anchor_cosine[i] = request.anchor.direction.cosine;
    block.anchor_sine[i] = request.anchor.direction.sine;
  }
}

template <int kLanes>
void unpack(const LaneBlock<kLanes>& block, std::span<LaneRequest* const> requests) {
  for (std::size_t i = 0; i < requests.size(); ++i) {
    LaneRequest& request = *requests[i];
    request.finite = request.step->adopt(request.size, [&](auto& stages, auto& end) {
      for (std::size_t s = 1; s <= kEvaluationsOfAttempt; ++s) {
        for (int c = 0; c < 6; ++c) stages[s][c] = block.stages[s][c][i];
      }
      for (int c = 0; c < 6; ++c) end[c] = block.end[c][i];
    });
    request.last = {{block.force_radial[i], block.force_tangential[i], block.load[i], block.shortening[i],
                     block.root_strain[i], block.slip_velocity[i]},
                    block.residual[i],
                    block.bending_slope[i],
                    block.time_slope[i]};
    request.acceleration = {block.acceleration_x[i], block.acceleration_y[i]};
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

int lanes_of_processor() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return 8;
  if (__builtin_cpu_supports("avx2")) return 4;
#endif
  return 1;
}

}  // namespace rubatlas::batch
