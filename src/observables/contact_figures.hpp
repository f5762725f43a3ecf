/// Observables of the contacts: `touchdowns_per_revolution`, `contact_fraction`, the peaks
/// `max_contact_force`, `max_root_strain` and `max_root_stress`, and `clearance_growth`.
#pragma once

#include <algorithm>
#include <memory>

#include "observables/observable.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

/// Touch-downs within the sampled revolutions, per revolution. A contact that is open when they start does
/// not count.
class TouchdownsPerRevolution final : public Observable {
 public:
  static std::unique_ptr<Observable> make(const settings::Scene& /*scene*/) {
    return std::make_unique<TouchdownsPerRevolution>();
  }
  void begin(const trajectory::PointConstants& /*point*/) override { count_ = revolutions_ = 0; }
  void touch_down(int /*blade*/) override { ++count_; }
  void revolution_ends(const trajectory::State& /*section*/) override { ++revolutions_; }
  void write(std::span<double> row) override {
    row[0] = static_cast<double>(count_) / static_cast<double>(revolutions_);
  }

 private:
  long count_ = 0;
  long revolutions_ = 0;
};

/// Share of the time with any blade in contact [-].
class ContactFraction final : public Observable {
 public:
  static std::unique_ptr<Observable> make(const settings::Scene& /*scene*/) {
    return std::make_unique<ContactFraction>();
  }
  void begin(const trajectory::PointConstants& point) override {
    time_before_ = in_contact_ = 0.0;
    period_ = point.period;
    revolutions_ = 0;
  }
  void speed_changes(const trajectory::PointConstants& point) override {
    time_before_ += period_ * revolutions_;
    revolutions_ = 0;
    period_ = point.period;
  }
  void revolution_ends(const trajectory::State& /*section*/) override { ++revolutions_; }
  void piece(trajectory::MotionPiece& piece) override {
    if (piece.contact_count() > 0) in_contact_ += piece.end() - piece.begin();
  }
  void write(std::span<double> row) override {
    row[0] = in_contact_ / (time_before_ + period_ * revolutions_);
  }

 private:
  double in_contact_ = 0.0;
  double time_before_ = 0.0;  ///< τ of the revolutions at other speeds
  double period_ = 0.0;       ///< τ of one at the present speed
  int revolutions_ = 0;       ///< at it
};

/// Largest value of a load over all contacts.
template <trajectory::Load kLoad>
class ContactPeak final : public Observable {
 public:
  static std::unique_ptr<Observable> make(const settings::Scene& /*scene*/) {
    return std::make_unique<ContactPeak>();
  }
  void begin(const trajectory::PointConstants& /*point*/) override { peak_ = 0.0; }
  void piece(trajectory::MotionPiece& piece) override {
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact)
      peak_ = std::max(peak_, piece.largest(kLoad, contact, peak_).value);
  }
  void write(std::span<double> row) override { row[0] = peak_; }

 private:
  double peak_ = 0.0;
};

using MaxContactForce = ContactPeak<trajectory::Load::normal_force>;
using MaxRootStrain = ContactPeak<trajectory::Load::root_strain>;

/// Largest bending stress at the root of a blade [Pa]: E times the strain.
class MaxRootStress final : public Observable {
 public:
  explicit MaxRootStress(const settings::Scene& scene) : youngs_modulus_(scene.blades.youngs_modulus) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<MaxRootStress>(scene);
  }
  void begin(const trajectory::PointConstants& point) override { strain_.begin(point); }
  void piece(trajectory::MotionPiece& piece) override { strain_.piece(piece); }
  void write(std::span<double> row) override {
    strain_.write(row);
    row[0] *= youngs_modulus_;
  }

 private:
  double youngs_modulus_;  ///< E [Pa]
  MaxRootStrain strain_;
};

/// The flag of `validity.yield_strain`: 1 where a blade's root has been strained beyond it, else 0.
class Yielded final : public Observable {
 public:
  explicit Yielded(double yield_strain) : yield_strain_(yield_strain) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<Yielded>(*scene.validity.yield_strain);
  }
  void begin(const trajectory::PointConstants& point) override { strain_.begin(point); }
  void piece(trajectory::MotionPiece& piece) override { strain_.piece(piece); }
  void write(std::span<double> row) override {
    strain_.write(row);
    row[0] = row[0] > yield_strain_ ? 1.0 : 0.0;
  }

 private:
  double yield_strain_;  ///< [-]
  MaxRootStrain strain_;
};

/// Growth of the clearance of the blade that has worn most, over the point with its transient [m].
class ClearanceGrowth final : public Observable {
 public:
  static std::unique_ptr<Observable> make(const settings::Scene& /*scene*/) {
    return std::make_unique<ClearanceGrowth>();
  }
  void begin(const trajectory::PointConstants& /*point*/) override { growth_ = 0.0; }
  void clearance_grows(double growth) override { growth_ = growth; }
  void write(std::span<double> row) override { row[0] = growth_; }

 private:
  double growth_ = 0.0;
};

}  // namespace rubatlas::observables
