/// Several lines of an atlas in one thread, each on a stack of its own, so that their attempts of contact
/// steps can be made side by side.
///
/// A line runs the program's own code; where it would make an attempt of a step of one carried contact it
/// lets the others go on, and finds the attempt made when it is its turn again. The door is a table of
/// coefficients, `BatchedDormandPrince853`, which is `DormandPrince853` but for the way its steps are tried.
#pragma once

#include <boost/context/fiber.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "contact_lanes.hpp"

namespace rubatlas::bench {

/// What the lanes were filled with.
struct LaneCounts {
  std::uint64_t batches = 0;   ///< of more than one attempt
  std::uint64_t in_lanes = 0;  ///< attempts made in them
  std::uint64_t alone = 0;     ///< attempts made by the scalar path, too few having come together

  LaneCounts& operator+=(const LaneCounts& more) {
    batches += more.batches;
    in_lanes += more.in_lanes;
    alone += more.alone;
    return *this;
  }
};

class LineFibers {
 public:
  /// `alive` lines at a time; the next one starts when one ends. Fewer requests than `fewest` are not worth
  /// a batch.
  LineFibers(std::size_t alive, std::size_t fewest);

  LaneCounts run(const std::vector<std::function<void()>>& lines);

  /// Within a line: the attempt, made when enough have come together or nobody can go on without.
  bool attempt(LaneSystem& system, LaneStep& step, double size);

  /// The one that runs the line that asks.
  static LineFibers* current;

 private:
  struct Line {
    boost::context::fiber fiber;
    bool attempted = false;  ///< result of its last request
  };
  void start(const std::function<void()>& work, Line& line);
  void make_requests();

  std::size_t alive_;
  std::size_t fewest_;
  boost::context::fiber caller_;  ///< the loop, while a line runs
  Line* running_ = nullptr;
  std::vector<std::unique_ptr<Line>> lines_;
  std::vector<Line*> ready_;  ///< lines that can go on, from `next_ready_`
  std::size_t next_ready_ = 0;
  std::vector<LaneRequest> requests_;
  std::vector<Line*> askers_;
  std::unique_ptr<ContactLanes<4>> four_ = std::make_unique<ContactLanes<4>>();
  std::unique_ptr<ContactLanes<8>> eight_ = std::make_unique<ContactLanes<8>>();
  LaneCounts counts_;
};

struct BatchedDormandPrince853 : integrate::DormandPrince853 {};

}  // namespace rubatlas::bench

template <>
class rubatlas::integrate::RungeKutta<rubatlas::bench::BatchedDormandPrince853, 6>
    : public rubatlas::bench::LaneStep {
 public:
  template <class System>
  bool attempt(System& system, double size) {
    if constexpr (std::is_same_v<System, rubatlas::bench::LaneSystem>) {
      return rubatlas::bench::LineFibers::current->attempt(system, *this, size);
    } else {
      return rubatlas::bench::LaneStep::attempt(system, size);
    }
  }
};
