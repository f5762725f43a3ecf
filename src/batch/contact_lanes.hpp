/// Attempts of contact steps of several independent motions at once, one in each SIMD lane.
///
/// The lanes evaluate the equation of `Carried` and attempt steps of `RungeKutta`, with lanes for numbers:
/// each has the bits of the scalar path, whatever its neighbours hold. Motions may differ in everything:
/// speed, damping, friction, blade, unbalance.
#pragma once

#include <memory>
#include <span>

#include "batch/lane_block.hpp"
#include "batch/lane_request.hpp"

namespace rubatlas::batch {

class ContactLanes {
 public:
  /// `width`: lanes of the processor, 4 or 8 (`lanes_of_processor`).
  explicit ContactLanes(int width);

  /// Makes up to `width` attempts; steps and requests are then as their own attempts would have left them.
  void attempt(std::span<LaneRequest* const> requests);

 private:
  std::unique_ptr<LaneBlock<4>> four_;
  std::unique_ptr<LaneBlock<8>> eight_;  ///< none where the processor has four lanes only
};

/// How many attempts this processor makes side by side: 8 with AVX-512, 4 with AVX2, else 1.
int lanes_of_processor();

}  // namespace rubatlas::batch
