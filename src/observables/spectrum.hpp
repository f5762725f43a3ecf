/// Observables `spectrum`, the amplitude of x over order, and `full_spectrum`, that of the whirl x + iy over
/// signed order; both over all sampled revolutions (`observables/signal_spectrum.hpp`).
#pragma once

#include <algorithm>
#include <memory>

#include "observables/observable.hpp"
#include "observables/repeated.hpp"
#include "observables/sample_cursor.hpp"
#include "observables/signal_spectrum.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

class SpectrumOfDisplacement final : public Observable {
 public:
  explicit SpectrumOfDisplacement(const settings::Scene& scene)
      : cursor_(scene.protocol.samples_per_revolution),
        spectrum_(scene.protocol.sampled_revolutions, scene.protocol.samples_per_revolution,
                  scene.spectrum.max_order) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<SpectrumOfDisplacement>(scene);
  }

  void begin(const trajectory::PointConstants& point) override { cursor_.begin(point); }
  void speed_changes(const trajectory::PointConstants& point) override { cursor_.speed_changes(point); }
  void piece(trajectory::MotionPiece& piece) override {
    const auto [times, first, before, count] = cursor_.next(piece);
    if (count > 0) piece.places(times, first, spectrum_.samples().subspan(before, count), {});
  }
  void revolution_ends(const trajectory::State& /*section*/) override { cursor_.revolution_ends(); }
  void write(std::span<double> row) override {
    repeat(spectrum_.samples(), cursor_.filled());
    spectrum_.amplitudes(row);
  }

 private:
  SampleCursor cursor_;
  Spectrum spectrum_;
};

/// Radii of the circles that make up the motion of the shaft's centre, from order −max_order to max_order:
/// with the rotation (forward whirl) where the order is positive, against it (backward whirl) where it is
/// negative.
class FullSpectrumOfDisplacement final : public Observable {
 public:
  explicit FullSpectrumOfDisplacement(const settings::Scene& scene)
      : cursor_(scene.protocol.samples_per_revolution),
        spectrum_(scene.protocol.sampled_revolutions, scene.protocol.samples_per_revolution,
                  scene.spectrum.max_order) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<FullSpectrumOfDisplacement>(scene);
  }

  void begin(const trajectory::PointConstants& point) override {
    cursor_.begin(point);
    spins_backward_ = point.speed_ratio < 0.0;
  }
  void speed_changes(const trajectory::PointConstants& point) override { cursor_.speed_changes(point); }
  void piece(trajectory::MotionPiece& piece) override {
    const auto [times, first, before, count] = cursor_.next(piece);
    if (count > 0) {
      piece.places(times, first, spectrum_.x().subspan(before, count), spectrum_.y().subspan(before, count));
    }
  }
  void revolution_ends(const trajectory::State& /*section*/) override { cursor_.revolution_ends(); }
  void write(std::span<double> row) override {
    repeat(spectrum_.x(), cursor_.filled());
    repeat(spectrum_.y(), cursor_.filled());
    spectrum_.amplitudes(row);
    if (spins_backward_) std::ranges::reverse(row);
  }

 private:
  SampleCursor cursor_;
  FullSpectrum spectrum_;
  bool spins_backward_ = false;  ///< Ω < 0
};

}  // namespace rubatlas::observables
