/// Observables of each blade: `touchdowns_of_blades`, `contact_fraction_of_blades`, `impulse_of_blades` and
/// `max_contact_force_of_blades`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "observables/observable.hpp"
#include "settings/scene.hpp"
#include "trajectory/places_in_piece.hpp"

namespace rubatlas::observables {

/// A number of each blade.
class OfBlades : public Observable {
 public:
  explicit OfBlades(const settings::Scene& scene) : values_(static_cast<std::size_t>(scene.blades.count)) {}
  void begin(const trajectory::PointConstants& /*point*/) override {
    std::ranges::fill(values_, 0.0);
    revolutions_ = 0;
  }
  void revolution_ends(const trajectory::State& /*section*/) override { ++revolutions_; }

 protected:
  [[nodiscard]] double& of(int blade) { return values_[static_cast<std::size_t>(blade)]; }
  [[nodiscard]] int revolutions() const { return revolutions_; }
  /// The numbers times `unit`, divided by `whole`.
  void write_shares(std::span<double> row, double unit, double whole) const {
    std::ranges::transform(values_, row.begin(), [&](double value) { return unit * value / whole; });
  }

 private:
  int revolutions_ = 0;  ///< that have been observed
  std::vector<double> values_;
};

/// Touch-downs of each blade per revolution, counted as `touchdowns_per_revolution` counts them.
class TouchdownsOfBlades final : public OfBlades {
 public:
  using OfBlades::OfBlades;
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<TouchdownsOfBlades>(scene);
  }
  void touch_down(int blade) override { of(blade) += 1.0; }
  void write(std::span<double> row) override { write_shares(row, 1.0, revolutions()); }
};

/// Share of the time that each blade is in contact [-].
class ContactFractionOfBlades final : public OfBlades {
 public:
  using OfBlades::OfBlades;
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<ContactFractionOfBlades>(scene);
  }
  void begin(const trajectory::PointConstants& point) override {
    OfBlades::begin(point);
    time_ = 0.0;
  }
  void piece(trajectory::MotionPiece& piece) override {
    const double length = piece.end() - piece.begin();
    time_ += length;
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact)
      of(piece.blade(contact)) += length;
  }
  void write(std::span<double> row) override { write_shares(row, 1.0, time_); }

 private:
  double time_ = 0.0;  ///< τ
};

/// Impulse of the normal force on each blade per revolution, ∫ F dt [N s].
class ImpulseOfBlades final : public OfBlades {
 public:
  explicit ImpulseOfBlades(const settings::Scene& scene)
      : OfBlades(scene), time_unit_(1.0 / scene.rotor.natural_frequency) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<ImpulseOfBlades>(scene);
  }
  void piece(trajectory::MotionPiece& piece) override {
    places_.rubs(
        piece, [&](const trajectory::Rub& rub) { of(piece.blade(rub.contact)) += rub.weight * rub.normal; });
  }
  void write(std::span<double> row) override { write_shares(row, time_unit_, revolutions()); }

 private:
  double time_unit_;  ///< 1/ωn [s]
  trajectory::PlacesInPiece places_;
};

/// Largest normal force on each blade [N].
class MaxContactForceOfBlades final : public OfBlades {
 public:
  using OfBlades::OfBlades;
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<MaxContactForceOfBlades>(scene);
  }
  void piece(trajectory::MotionPiece& piece) override {
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
      double& peak = of(piece.blade(contact));
      peak = std::max(peak, piece.largest(trajectory::Load::normal_force, contact, peak).value);
    }
  }
  void write(std::span<double> row) override { write_shares(row, 1.0, 1.0); }
};

}  // namespace rubatlas::observables
