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
  static std::unique_ptr<Observable> make(const settings::Scene& /*scene*/) {
    return std::make_unique<NearestMiss>();
  }
  void begin(const trajectory::PointConstants& point) override {
    point_ = point;
    nearest_.reset();
  }
  void speed_changes(const trajectory::PointConstants& point) override { point_ = point; }
  void piece(trajectory::MotionPiece& piece) override {
    if (const auto pass = piece.nearest_pass(known(), point_)) nearest_ = pass;
  }
  void write(std::span<double> row) override {
    row[0] = nearest_ ? nearest_->miss : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] const std::optional<trajectory::Pass>& nearest() const { return nearest_; }

 private:
  [[nodiscard]] double known() const {
    return nearest_ ? nearest_->miss : std::numeric_limits<double>::infinity();
  }
  trajectory::PointConstants point_{};
  std::optional<trajectory::Pass> nearest_;
};

/// Smallest depth of a contact [m]: of the largest overlaps of the undeformed tip within each contact the
/// smallest. Only contacts that begin and end within the sampled revolutions count; NaN where none does. On a
/// cycle one that is open at its end goes on at its start.
class LightestTouch final : public Observable {
 public:
  struct Touch {
    double depth;  ///< [m]
    double side;   ///< s ct where it is deepest [m]
  };

  explicit LightestTouch(int blade_count)
      : open_(static_cast<std::size_t>(blade_count)), begun_before_(open_.size()) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<LightestTouch>(scene.blades.count);
  }
  void begin(const trajectory::PointConstants& /*point*/) override {
    lightest_.reset();
    std::ranges::fill(open_, std::nullopt);
    std::ranges::fill(begun_before_, std::nullopt);
  }
  void on_cycle(const variation::Tangents& /*return_map*/) override {
    std::ranges::fill(open_, Open{kUnseen, true});
  }
  void touch_down(int blade) override { open_[static_cast<std::size_t>(blade)] = Open{kUnseen, false}; }
  void lift_off(int blade) override {
    const auto number = static_cast<std::size_t>(blade);
    if (std::optional<Open>& open = open_[number]) {
      if (open->begun_before) {
        begun_before_[number] = open->touch;
      } else {
        take(open->touch, lightest_);
      }
      open.reset();
    }
  }
  void piece(trajectory::MotionPiece& piece) override {
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
      std::optional<Open>& open = open_[static_cast<std::size_t>(piece.blade(contact))];
      // What is deeper than the lightest contact so far need not be known better.
      const double enough = lightest_ ? lightest_->depth : std::numeric_limits<double>::infinity();
      if (!open || open->touch.depth > enough) continue;
      const trajectory::Tip deepest = piece.deepest(contact, enough);
      if (deepest.overlap > open->touch.depth) open->touch = {deepest.overlap, deepest.side};
    }
  }
  void write(std::span<double> row) override {
    const auto found = lightest();
    row[0] = found ? found->depth : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] std::optional<Touch> lightest() const {
    std::optional<Touch> lightest = lightest_;
    for (std::size_t blade = 0; blade < open_.size(); ++blade) {
      const auto& open = open_[blade];
      const auto& rest = begun_before_[blade];
      if (open && rest) take(rest->depth > open->touch.depth ? *rest : open->touch, lightest);
    }
    return lightest;
  }

 private:
  static constexpr Touch kUnseen{-std::numeric_limits<double>::infinity(), 0.0};
  struct Open {
    Touch touch;
    bool begun_before;  ///< before the first revolution that is observed
  };

  static void take(Touch touch, std::optional<Touch>& lightest) {
    if (!(touch.depth > kUnseen.depth)) return;
    touch.depth = std::max(touch.depth, 0.0);  // of a tip that barely touches it may be rounded
    if (!lightest || touch.depth < lightest->depth) lightest = touch;
  }

  std::vector<std::optional<Open>> open_;           ///< of each blade, the contact that it is in
  std::vector<std::optional<Touch>> begun_before_;  ///< of each blade, the contact that was open at first
  std::optional<Touch> lightest_;
};

/// On which side the rotor is nearest to grazing: of the nearest miss or of the lightest touch, whichever is
/// nearer to zero; head-on where |ct| is zero to rounding. 0 where there is neither.
class NearestGrazing final : public Observable {
 public:
  explicit NearestGrazing(const settings::Scene& scene)
      : head_on_(kHeadOn * scene.ring.radius), touch_(scene.blades.count) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<NearestGrazing>(scene);
  }
  void begin(const trajectory::PointConstants& point) override {
    miss_.begin(point);
    touch_.begin(point);
  }
  void on_cycle(const variation::Tangents& return_map) override { touch_.on_cycle(return_map); }
  void speed_changes(const trajectory::PointConstants& point) override { miss_.speed_changes(point); }
  void touch_down(int blade) override { touch_.touch_down(blade); }
  void lift_off(int blade) override { touch_.lift_off(blade); }
  void piece(trajectory::MotionPiece& piece) override {
    miss_.piece(piece);
    touch_.piece(piece);
  }
  void write(std::span<double> row) override { row[0] = static_cast<double>(side()); }

 private:
  static constexpr double kHeadOn = 1e-9;  ///< of R: |ct| below it is zero

  [[nodiscard]] GrazingSide side() const {
    const auto& miss = miss_.nearest();
    const auto touch = touch_.lightest();
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
