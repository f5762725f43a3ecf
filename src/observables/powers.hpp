/// Observables `friction_power`, `viscous_power`, `deformation_power` and `drive_torque`: means over the
/// sampled revolutions, in W and N m. powers.md has their balance and where it comes from.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>

#include "observables/observable.hpp"
#include "settings/scene.hpp"
#include "trajectory/places_in_piece.hpp"

namespace rubatlas::observables {

/// The mean over the sampled revolutions of what is added up over places of their pieces.
class MeanOverTime {
 public:
  void begin() {
    sum_ = 0.0;
    time_ = 0.0;
  }
  void add(double amount) { sum_ += amount; }
  void time_passes(const trajectory::MotionPiece& piece) { time_ += piece.end() - piece.begin(); }
  /// Per unit τ.
  [[nodiscard]] double value() const { return sum_ / time_; }

 private:
  double sum_ = 0.0;
  double time_ = 0.0;  ///< τ
};

/// What the friction at the tips takes from the motion, Σ c F v [W] (MODEL 4.3, 4.4).
class FrictionPower final : public Observable {
 public:
  explicit FrictionPower(const settings::Scene& scene) : frequency_(scene.rotor.natural_frequency) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<FrictionPower>(scene);
  }
  void begin(const trajectory::PointConstants& /*point*/) override { mean_.begin(); }
  void piece(trajectory::MotionPiece& piece) override {
    places_.rubs(piece, [this](const trajectory::Rub& rub) { mean_.add(rub.weight * rub.friction_power); });
    mean_.time_passes(piece);
  }
  void write(std::span<double> row) override { row[0] = frequency_ * mean_.value(); }

 private:
  double frequency_;  ///< ωn [rad/s]
  trajectory::PlacesInPiece places_;
  MeanOverTime mean_;
};

/// What the shaft's viscous damping takes, c |z'|² ωn² = 2ζ m ωn³ |z'|² [W].
class ViscousPower final : public Observable {
 public:
  explicit ViscousPower(const settings::Scene& scene)
      : damping_ratio_(scene.rotor.damping_ratio),
        unit_(2.0 * damping_ratio_ * scene.rotor.mass * std::pow(scene.rotor.natural_frequency, 3)) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<ViscousPower>(scene);
  }
  void begin(const trajectory::PointConstants& point) override {
    mean_.begin();
    speed_changes(point);
  }
  void speed_changes(const trajectory::PointConstants& point) override {
    pace_ = {2.0 * std::max(1.0, std::abs(point.speed_ratio)), 4.0 * damping_ratio_};
  }
  void piece(trajectory::MotionPiece& piece) override {
    places_.states(piece, pace_, [this](const trajectory::Place& place) {
      const trajectory::State& state = place.state;
      mean_.add(place.weight * (state[2] * state[2] + state[3] * state[3]));
    });
    mean_.time_passes(piece);
  }
  void write(std::span<double> row) override { row[0] = unit_ * mean_.value(); }

 private:
  double damping_ratio_;  ///< ζ [-]
  double unit_;           ///< [W per (m per unit τ)²]
  trajectory::PlacesInPiece places_;
  trajectory::PlacesInPiece::Pace pace_{};  ///< of |z'|²
  MeanOverTime mean_;
};

/// What the contacts take from the motion besides friction [W]: the work of their normal forces, which bend
/// the blades and push the ring, −Σ [Fk·z' + Ω (rk − c) × Fk] − Σ c F v.
class DeformationPower final : public Observable {
 public:
  explicit DeformationPower(const settings::Scene& scene) : frequency_(scene.rotor.natural_frequency) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<DeformationPower>(scene);
  }
  void begin(const trajectory::PointConstants& point) override {
    mean_.begin();
    speed_ratio_ = point.speed_ratio;
  }
  void speed_changes(const trajectory::PointConstants& point) override { speed_ratio_ = point.speed_ratio; }
  void piece(trajectory::MotionPiece& piece) override {
    places_.with_forces(piece, [this](const trajectory::Place& place) {
      for (const trajectory::ContactForce& force : place.forces) {
        const double of_shaft =
            force.on_rotor.real() * place.state[2] + force.on_rotor.imag() * place.state[3];
        mean_.add(-place.weight * (of_shaft + speed_ratio_ * force.torque + force.friction_power()));
      }
    });
    mean_.time_passes(piece);
  }
  void write(std::span<double> row) override { row[0] = frequency_ * mean_.value(); }

 private:
  double frequency_;  ///< ωn [rad/s]
  double speed_ratio_ = 0.0;
  trajectory::PlacesInPiece places_;
  MeanOverTime mean_;
};

/// The torque that keeps the speed constant, −Σ (rk − c) × Fk + me u × z'' ωn² [N m], along +z. u =
/// e^{i(Ωτ+γ)} points to the centre of mass. z'' is integrated by parts, ∫ u × z'' dτ = [u × z'] + Ω ∫ u·z'
/// dτ.
class DriveTorque final : public Observable {
 public:
  explicit DriveTorque(const settings::Scene& scene) : damping_ratio_(scene.rotor.damping_ratio) {
    if (!scene.unbalance) return;
    const double frequency = scene.rotor.natural_frequency;
    unbalance_ = std::polar(scene.unbalance->moment * frequency * frequency, scene.unbalance->phase);
  }
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<DriveTorque>(scene);
  }
  void begin(const trajectory::PointConstants& point) override {
    mean_.begin();
    speed_ratio_ = point.speed_ratio;
    before_.reset();
  }
  void speed_changes(const trajectory::PointConstants& point) override { speed_ratio_ = point.speed_ratio; }
  void piece(trajectory::MotionPiece& piece) override {
    places_.with_forces(piece, [this](const trajectory::Place& place) {
      for (const trajectory::ContactForce& force : place.forces) mean_.add(-place.weight * force.torque);
    });
    mean_.time_passes(piece);
    if (unbalance_ == 0.0) return;
    if (!before_) before_ = piece.state(piece.begin());
    const trajectory::PlacesInPiece::Pace pace{2.0 * std::max(1.0, std::abs(speed_ratio_)),
                                               2.0 * damping_ratio_};
    places_.states(piece, pace, [this](const trajectory::Place& place) {
      const std::complex<double> u = unbalance_ * std::polar(1.0, speed_ratio_ * place.time);
      mean_.add(place.weight * speed_ratio_ * along(u, place.state));
    });
  }
  /// u has turned round once.
  void revolution_ends(const trajectory::State& section) override {
    if (unbalance_ == 0.0) return;
    const std::complex<double> across = unbalance_ * std::complex<double>(0.0, 1.0);
    mean_.add(along(across, section) - along(across, *before_));
    before_ = section;
  }
  void write(std::span<double> row) override { row[0] = mean_.value(); }

 private:
  static double along(const std::complex<double>& vector, const trajectory::State& state) {
    return vector.real() * state[2] + vector.imag() * state[3];
  }

  double damping_ratio_;                  ///< ζ [-]
  std::complex<double> unbalance_ = 0.0;  ///< me ωn² e^{iγ} [N]
  double speed_ratio_ = 0.0;
  std::optional<trajectory::State> before_;  ///< at the start of the revolution
  trajectory::PlacesInPiece places_;
  MeanOverTime mean_;
};

}  // namespace rubatlas::observables
