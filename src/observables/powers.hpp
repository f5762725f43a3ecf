/// Observables `friction_power`, `viscous_power`, `deformation_power` and `drive_torque`: means over the
/// sampled revolutions, in W and N m. README has their balance and where it comes from.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <optional>

#include "integrate/integral.hpp"
#include "observables/observable.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

/// The mean over the sampled revolutions of a rate, which is handed over as integrals over pieces.
class MeanOverPieces {
 public:
  void begin() {
    sum_ = 0.0;
    time_ = 0.0;
  }
  /// Adds what a rate of each contact, a function of its force and the state, amounts to in a piece.
  template <class Rate>
  void add_of_contacts(MotionPiece& piece, const Rate& rate) {
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
      const auto at = [&](double time) { return rate(piece, piece.contact_force(contact, time), time); };
      sum_ += integrate::integral_with_root_ends<kPoints>(at, piece.begin(), piece.end());
    }
  }
  /// The same of a rate that is a function of state and time, in contact or in flight. `fastest`: frequency
  /// or rate of decay of the motion in flight.
  template <class Rate>
  void add_of_state(MotionPiece& piece, double fastest, const Rate& rate) {
    const auto at = [&](double time) { return rate(piece.state(time), time); };
    if (piece.contact_count() > 0) {
      sum_ += integrate::integral_with_root_ends<kPoints>(at, piece.begin(), piece.end());
      return;
    }
    const double length = piece.end() - piece.begin();
    const int stretches = std::max(1, static_cast<int>(std::ceil(length * fastest / kStretch)));
    for (int i = 0; i < stretches; ++i) {
      sum_ += integrate::integral<kPoints>(at, piece.begin() + length * i / stretches,
                                           piece.begin() + length * (i + 1) / stretches);
    }
  }
  void add(double amount) { sum_ += amount; }
  void time_passes(const MotionPiece& piece) { time_ += piece.end() - piece.begin(); }
  /// Per unit τ.
  [[nodiscard]] double value() const { return sum_ / time_; }

 private:
  /// As in `motion/friction_work.hpp`; and of an oscillation over half of its period, the square of which
  /// goes through one whole period, they leave 1e-14.
  static constexpr unsigned kPoints = 10;
  static constexpr double kStretch = std::numbers::pi;

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
  void begin(const PointConstants& /*point*/) override { mean_.begin(); }
  void piece(MotionPiece& piece) override {
    mean_.add_of_contacts(
        piece, [](MotionPiece&, const ContactForce& force, double) { return force.friction_power(); });
    mean_.time_passes(piece);
  }
  void write(std::span<double> row) override { row[0] = frequency_ * mean_.value(); }

 private:
  double frequency_;  ///< ωn [rad/s]
  MeanOverPieces mean_;
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
  void begin(const PointConstants& point) override {
    mean_.begin();
    speed_changes(point);
  }
  void speed_changes(const PointConstants& point) override {
    fastest_ = std::max({1.0, std::abs(point.speed_ratio), 2.0 * damping_ratio_});
  }
  void piece(MotionPiece& piece) override {
    mean_.add_of_state(piece, fastest_,
                       [](const State& state, double) { return state[2] * state[2] + state[3] * state[3]; });
    mean_.time_passes(piece);
  }
  void write(std::span<double> row) override { row[0] = unit_ * mean_.value(); }

 private:
  double damping_ratio_;  ///< ζ [-]
  double unit_;           ///< [W per (m per unit τ)²]
  double fastest_ = 1.0;
  MeanOverPieces mean_;
};

/// What the contacts take from the motion besides friction [W]: the work of their normal forces, which bend
/// the blades and push the ring, −Σ [Fk·z' + Ω (rk − c) × Fk] − Σ c F v.
class DeformationPower final : public Observable {
 public:
  explicit DeformationPower(const settings::Scene& scene) : frequency_(scene.rotor.natural_frequency) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<DeformationPower>(scene);
  }
  void begin(const PointConstants& point) override {
    mean_.begin();
    speed_ratio_ = point.speed_ratio;
  }
  void speed_changes(const PointConstants& point) override { speed_ratio_ = point.speed_ratio; }
  void piece(MotionPiece& piece) override {
    mean_.add_of_contacts(piece, [this](MotionPiece& at, const ContactForce& force, double time) {
      const State state = at.state(time);
      const double of_shaft = force.on_rotor.real() * state[2] + force.on_rotor.imag() * state[3];
      return -(of_shaft + speed_ratio_ * force.torque) - force.friction_power();
    });
    mean_.time_passes(piece);
  }
  void write(std::span<double> row) override { row[0] = frequency_ * mean_.value(); }

 private:
  double frequency_;  ///< ωn [rad/s]
  double speed_ratio_ = 0.0;
  MeanOverPieces mean_;
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
  void begin(const PointConstants& point) override {
    mean_.begin();
    speed_ratio_ = point.speed_ratio;
    before_.reset();
  }
  void speed_changes(const PointConstants& point) override { speed_ratio_ = point.speed_ratio; }
  void piece(MotionPiece& piece) override {
    mean_.add_of_contacts(piece,
                          [](MotionPiece&, const ContactForce& force, double) { return -force.torque; });
    mean_.time_passes(piece);
    if (unbalance_ == 0.0) return;
    if (!before_) before_ = piece.state(piece.begin());
    const double fastest = std::max({1.0, std::abs(speed_ratio_), damping_ratio_});
    mean_.add_of_state(piece, fastest, [this](const State& state, double time) {
      return speed_ratio_ * along(unbalance_ * std::polar(1.0, speed_ratio_ * time), state);
    });
  }
  /// u has turned round once.
  void revolution_ends(const State& section) override {
    if (unbalance_ == 0.0) return;
    const std::complex<double> across = unbalance_ * std::complex<double>(0.0, 1.0);
    mean_.add(along(across, section) - along(across, *before_));
    before_ = section;
  }
  void write(std::span<double> row) override { row[0] = mean_.value(); }

 private:
  static double along(const std::complex<double>& vector, const State& state) {
    return vector.real() * state[2] + vector.imag() * state[3];
  }

  double damping_ratio_;                  ///< ζ [-]
  std::complex<double> unbalance_ = 0.0;  ///< me ωn² e^{iγ} [N]
  double speed_ratio_ = 0.0;
  std::optional<State> before_;  ///< at the start of the revolution
  MeanOverPieces mean_;
};

}  // namespace rubatlas::observables
