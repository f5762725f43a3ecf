/// What follows a motion for its maps: from section to section, and from touch-down to touch-down.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "modes/motion_listener.hpp"
#include "motion/point_start.hpp"
#include "observables/grazing.hpp"
#include "point/line_solver.hpp"
#include "trajectory/motion_piece.hpp"
#include "variation/tangent_flow.hpp"

namespace rubatlas::point {

/// Follows a motion for its section map.
class Mapping final : public modes::MotionListener {
 public:
  Mapping(variation::TangentFlow& flow, const trajectory::PointConstants& point)
      : flow_(&flow), touch_(point.blade_count), opened_(static_cast<std::size_t>(point.blade_count)) {
    miss_.begin(point);
    touch_.begin(point);
  }
  void piece(trajectory::MotionPiece& piece) override {
    flow_->piece(piece);
    const double before = miss_.nearest() ? miss_.nearest()->miss : std::numeric_limits<double>::infinity();
    miss_.piece(piece);
    if (const auto& pass = miss_.nearest(); pass && pass->miss < before)
      nearest_place_ = TipAtRing{pass->blade, revolution_, pass->time, piece.state(pass->time)};
    touch_.piece(piece);
  }
  void event(const modes::Event& event) override {
    using modes::Guard;
    if (event.kind == Guard::touch_down) {
      flow_->passes_ring(event.blade);
      touches_down({event.blade, revolution_, event.time, rotor::as_array(event.state)});
    } else if (event.kind == Guard::lift_off) {
      flow_->passes_ring(event.blade);
      events_.push_back(-event.blade - 1);
      const double before = lightest_depth();
      touch_.lift_off(event.blade);
      if (lightest_depth() < before) lightest_place_ = opened_[static_cast<std::size_t>(event.blade)];
    } else if (event.kind == Guard::slip_reversal) {
      flow_->slip_reverses(event.blade);
    } else {
      flow_->loses_track();
    }
  }
  /// A contact begins, of which the flow knows nothing yet or need not know.
  void touches_down(const TipAtRing& place) {
    events_.push_back(place.blade + 1);
    touch_.touch_down(place.blade);
    opened_[static_cast<std::size_t>(place.blade)] = place;
  }
  void revolution_ends(const motion::SectionState& section) override {
    sections_.push_back(section);
    ++revolution_;
  }
  [[nodiscard]] int revolution() const { return revolution_; }
  /// What has been found so far.
  [[nodiscard]] SectionMap map() const {
    SectionMap map;
    map.sections = sections_;
    map.differentiable = flow_->known();
    map.jacobian = flow_->tangents();
    map.log_volume = flow_->log_volume();
    map.nearest_pass = miss_.nearest();
    map.nearest_place = nearest_place_;
    map.events = events_;
    if (const auto& lightest = touch_.lightest()) {
      map.lightest_touch = lightest->depth;
      map.lightest_side = lightest->side;
      map.lightest_place = lightest_place_;
    }
    return map;
  }

 private:
  [[nodiscard]] double lightest_depth() const {
    return touch_.lightest() ? touch_.lightest()->depth : std::numeric_limits<double>::infinity();
  }

  variation::TangentFlow* flow_;
  observables::NearestMiss miss_;
  observables::LightestTouch touch_;
  std::vector<TipAtRing> opened_;  ///< of each blade, the last touch-down
  std::optional<TipAtRing> nearest_place_;
  std::optional<TipAtRing> lightest_place_;
  std::vector<motion::SectionState> sections_;
  std::vector<std::int32_t> events_;
  int revolution_ = 0;
};

/// Follows a motion from a touch-down to the flight that leads to the next, some passings of blades later.
class Returning final : public modes::MotionListener {
 public:
  Returning(variation::TangentFlow& flow, const trajectory::PointConstants& point,
            const motion::PointStart& start, int passings)
      : flow_(&flow),
        mapping_(flow, point),
        start_(start),
        period_(point.period),
        end_(start.time + point.period * passings / point.blade_count),
        longest_way_(kLongestWay * point.period / point.blade_count),
        blade_(in_place_of(start.blade, passings, point.blade_count, point.speed_ratio)) {
    mapping_.touches_down({start.blade, 0, start.time, start.state});
  }
  void piece(trajectory::MotionPiece& piece) override {
    if (!begun_) {
      rate_at_start_ =
          flow_->rate(start_.time, start_.state, variation::TangentFlow::force_in(piece, piece.begin()));
      begun_ = true;
    }
    mapping_.piece(piece);
    arriving_.reset();
    if (piece.contact_count() > 0) return;
    const double target = end_ - mapping_.revolution() * period_;
    const double distance = std::max({0.0, piece.begin() - target, target - piece.end()});
    if (distance > longest_way_) return;
    TouchdownMap map;
    map.map = mapping_.map();
    map.map.jacobian = flow_->after_flight(target - piece.end());
    map.complete = true;
    map.admissible = distance <= kTimeOfTouchdown * period_;
    map.end = piece.state(target);
    map.rate_at_start = rate_at_start_;
    map.rate_at_end = flow_->rate(target, map.end, Eigen::Vector2d::Zero());
    arriving_ = Arrival{map, distance, false};
    consider();
  }
  void event(const modes::Event& event) override {
    if (arriving_ && event.kind == modes::Guard::touch_down && event.blade == blade_) {
      arriving_->touches = true;
      consider();
    }
    arriving_.reset();
    mapping_.event(event);
  }
  void revolution_ends(const motion::SectionState& section) override { mapping_.revolution_ends(section); }
  [[nodiscard]] TouchdownMap map() const { return found_ ? found_->map : TouchdownMap{}; }

 private:
  static constexpr double kLongestWay = 0.25;  ///< from passing to passing, beyond the end of a flight
  static constexpr double kTimeOfTouchdown =
      1e-6;  ///< of a revolution: the flight ends by the touch-down itself

  struct Arrival {
    TouchdownMap map;
    double distance;  ///< of the time from the flight [τ]
    bool touches;     ///< the flight ends by a touch-down of the blade
  };
  /// Of all flights the one that ends by the touch-down of the blade, or else holds the time; the nearest in
  /// time.
  void consider() {
    const auto before = [](const Arrival& a, const Arrival& b) {
      return a.touches != b.touches ? a.touches : a.distance < b.distance;
    };
    if (!found_ || before(*arriving_, *found_)) found_ = arriving_;
  }

  variation::TangentFlow* flow_;
  Mapping mapping_;
  motion::PointStart start_;
  double period_;
  double end_;          ///< τ from the start of the first revolution
  double longest_way_;  ///< [τ]
  int blade_;           ///< that comes to the ring there
  bool begun_ = false;
  std::array<double, 4> rate_at_start_{};
  std::optional<Arrival> arriving_;  ///< the flight that has just ended
  std::optional<Arrival> found_;
};

}  // namespace rubatlas::point
