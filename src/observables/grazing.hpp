/// How near a motion is to grazing: observables `nearest_miss`, `lightest_touch` and `grazing_side`.
///
/// A tip that passes the ring by less and less grazes it, and touches; a contact that becomes lighter and
/// lighter grazes it, and vanishes. Either may end a periodic motion, according to the side on which the tip
/// grazes (MODEL 4.2).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "integrate/root_between.hpp"
#include "observables/observable.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

/// The side on which a tip grazes; the numbers are those of the atlas' `/grazing_side`.
enum class GrazingSide : std::uint8_t { none = 0, approaching = 1, head_on = 2, receding = 3 };
inline constexpr const char* kGrazingSides = "none approaching head_on receding";

/// Smallest distance by which a tip that is not in contact passes the ring within the sampled revolutions: a
/// local maximum of its radius, R − |tip| [m]. NaN where no tip's radius has one.
class NearestMiss final : public Observable {
 public:
  explicit NearestMiss(const settings::Scene& scene)
      : misalignment_(scene.rotor.misalignment), speeds_are_known_(!scene.ring_body && !scene.speed_ripple) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<NearestMiss>(scene);
  }
  void begin(const PointConstants& point) override {
    point_ = point;
    nearest_.reset();
    room_ = 0.0;
  }
  void speed_changes(const PointConstants& point) override { point_ = point; }
  void touch_down(int /*blade*/) override { room_ = 0.0; }
  void lift_off(int /*blade*/) override { room_ = 0.0; }
  void piece(MotionPiece& piece) override {
    if (speeds_are_known_ && piece.contact_count() > 0 && other_tips_stay_away(piece)) return;
    room_ = 0.0;
    if (const auto pass = piece.nearest_pass(known(), point_)) nearest_ = pass;
  }
  void write(std::span<double> row) override {
    row[0] = nearest_ ? nearest_->miss : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] const std::optional<Pass>& nearest() const { return nearest_; }

 private:
  [[nodiscard]] double known() const {
    return nearest_ ? nearest_->miss : std::numeric_limits<double>::infinity();
  }
  /// While some blades touch, the other tips are far from the ring for many steps: they are looked at again
  /// when the shaft has moved and turned so far that one of them may have come near.
  bool other_tips_stay_away(MotionPiece& piece) {
    // The radius of a tip changes by no more than |c'| + Ω |c|.
    const auto speed = [&](double time) {
      const State at = piece.state(time);
      return std::hypot(at[2], at[3]) +
             std::abs(point_.speed_ratio) * std::hypot(at[0], at[1] + misalignment_);
    };
    const double way = std::max(speed(piece.begin()), speed(piece.end())) * (piece.end() - piece.begin());
    if (!(way < room_)) room_ = room_of_others(piece);
    if (!(way < room_)) return false;
    room_ -= way;
    return true;
  }
  /// How far the tips that do not touch may come outward before one passes nearer than is known [m].
  [[nodiscard]] double room_of_others(MotionPiece& piece) const {
    double room = std::numeric_limits<double>::infinity();
    for (int k = 0; k < point_.blade_count; ++k) {
      bool touches = false;
      for (std::size_t contact = 0; contact < piece.contact_count(); ++contact)
        touches |= piece.blade(contact) == k;
      if (!touches) room = std::min(room, -piece.tip(k, piece.begin()).overlap - known());
    }
    return room;
  }

  double misalignment_;    ///< y0 [m]
  bool speeds_are_known_;  ///< the ring rests, and the speed is constant
  PointConstants point_{};
  std::optional<Pass> nearest_;
  double room_ = 0.0;  ///< [m]
};

/// Smallest depth of a contact [m]: of the largest overlaps of the undeformed tip within each contact the
/// smallest. Only contacts that begin and end within the sampled revolutions count; NaN where none does.
class LightestTouch final : public Observable {
 public:
  struct Touch {
    double depth;  ///< [m]
    double side;   ///< s ct where it is deepest [m]
  };

  explicit LightestTouch(int blade_count) : open_(static_cast<std::size_t>(blade_count)) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<LightestTouch>(scene.blades.count);
  }
  void begin(const PointConstants& /*point*/) override {
    lightest_.reset();
    std::ranges::fill(open_, std::nullopt);
  }
  void touch_down(int blade) override { open_[static_cast<std::size_t>(blade)] = Touch{0.0, 0.0}; }
  void lift_off(int blade) override {
    std::optional<Touch>& touch = open_[static_cast<std::size_t>(blade)];
    if (touch && (!lightest_ || touch->depth < lightest_->depth)) lightest_ = touch;
    touch.reset();
  }
  void piece(MotionPiece& piece) override {
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
      const int blade = piece.blade(contact);
      if (std::optional<Touch>& touch = open_[static_cast<std::size_t>(blade)]) deepen(*touch, piece, blade);
    }
  }
  void write(std::span<double> row) override {
    row[0] = lightest_ ? lightest_->depth : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] const std::optional<Touch>& lightest() const { return lightest_; }

 private:
  static constexpr unsigned kBits = 20;  ///< of the time; a maximum is flat, so its value has twice as many

  void deepen(Touch& touch, MotionPiece& piece, int blade) const {
    // What is deeper than the lightest contact so far need not be known better.
    if (lightest_ && touch.depth > lightest_->depth) return;
    const auto take = [&](const Tip& tip) {
      if (tip.overlap > touch.depth) touch = {tip.overlap, tip.side};
    };
    const Tip begin = piece.tip(blade, piece.begin());
    const Tip end = piece.tip(blade, piece.end());
    take(begin);
    take(end);
    if (lightest_ && touch.depth > lightest_->depth) return;
    if (!(begin.rate > 0.0 && end.rate < 0.0)) return;
    const auto rate = [&](double time) { return piece.tip(blade, time).rate; };
    take(piece.tip(blade,
                   integrate::root_between(rate, piece.begin(), piece.end(), begin.rate, end.rate, kBits)));
  }

  std::vector<std::optional<Touch>> open_;  ///< of each blade, the contact that it is in since its touch-down
  std::optional<Touch> lightest_;
};

/// On which side the rotor is nearest to grazing: of the nearest miss or of the lightest touch, whichever is
/// nearer to zero; head-on where |ct| is zero to rounding. 0 where there is neither.
class NearestGrazing final : public Observable {
 public:
  explicit NearestGrazing(const settings::Scene& scene)
      : head_on_(kHeadOn * scene.ring.radius), miss_(scene), touch_(scene.blades.count) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<NearestGrazing>(scene);
  }
  void begin(const PointConstants& point) override {
    miss_.begin(point);
    touch_.begin(point);
  }
  void speed_changes(const PointConstants& point) override { miss_.speed_changes(point); }
  void touch_down(int blade) override {
    miss_.touch_down(blade);
    touch_.touch_down(blade);
  }
  void lift_off(int blade) override {
    miss_.lift_off(blade);
    touch_.lift_off(blade);
  }
  void piece(MotionPiece& piece) override {
    miss_.piece(piece);
    touch_.piece(piece);
  }
  void write(std::span<double> row) override { row[0] = static_cast<double>(side()); }

 private:
  static constexpr double kHeadOn = 1e-9;  ///< of R: |ct| below it is zero

  [[nodiscard]] GrazingSide side() const {
    const auto& miss = miss_.nearest();
    const auto& touch = touch_.lightest();
    if (!miss && !touch) return GrazingSide::none;
    const bool misses = miss && !(touch && touch->depth < miss->miss);
    const double side = misses ? miss->side : touch->side;
    if (std::abs(side) <= head_on_) return GrazingSide::head_on;
    return side > 0.0 ? GrazingSide::approaching : GrazingSide::receding;
  }

  double head_on_;  ///< [m]
  NearestMiss miss_;
  LightestTouch touch_;
};

}  // namespace rubatlas::observables
