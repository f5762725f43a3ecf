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
  explicit TouchdownsPerRevolution(const settings::Scene& scene)
      : revolutions_(scene.protocol.sampled_revolutions) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<TouchdownsPerRevolution>(scene);
  }
  void begin(const trajectory::PointConstants& /*point*/) override { count_ = 0; }
  void touch_down(int /*blade*/) override { ++count_; }
  void write(std::span<double> row) override { row[0] = static_cast<double>(count_) / revolutions_; }

 private:
  int revolutions_;
  long count_ = 0;
};

/// Share of the time with any blade in contact [-].
class ContactFraction final : public Observable {
 public:
  explicit ContactFraction(const settings::Scene& scene) : revolutions_(scene.protocol.sampled_revolutions) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<ContactFraction>(scene);
  }
  void begin(const trajectory::PointConstants& point) override {
    sampled_time_ = point.period * revolutions_;
    in_contact_ = 0.0;
    period_ = point.period;
    left_ = revolutions_;
  }
  void speed_changes(const trajectory::PointConstants& point) override {
    sampled_time_ += (point.period - period_) * left_;
    period_ = point.period;
  }
  void revolution_ends(const trajectory::State& /*section*/) override { --left_; }
  void piece(trajectory::MotionPiece& piece) override {
    if (piece.contact_count() > 0) in_contact_ += piece.end() - piece.begin();
  }
  void write(std::span<double> row) override { row[0] = in_contact_ / sampled_time_; }

 private:
  int revolutions_;
  double sampled_time_ = 0.0;
  double in_contact_ = 0.0;
  double period_ = 0.0;
  int left_ = 0;  ///< sampled revolutions that have not ended
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
