/// Observable `spectrum`: amplitude of x over order, over all sampled revolutions (`analysis/spectrum.hpp`).
#pragma once

#include <memory>

#include "analysis/spectrum.hpp"
#include "observables/observable.hpp"
#include "settings/scene.hpp"

namespace rubatlas::observables {

class SpectrumOfDisplacement final : public Observable {
 public:
  explicit SpectrumOfDisplacement(const settings::Scene& scene)
      : samples_per_revolution_(scene.protocol.samples_per_revolution),
        spectrum_(scene.protocol.sampled_revolutions, samples_per_revolution_, scene.spectrum.max_order) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<SpectrumOfDisplacement>(scene);
  }

  void begin(const PointConstants& point) override {
    period_ = point.period;
    sample_ = 0;
    filled_ = 0;
  }
  void speed_changes(const PointConstants& point) override { period_ = point.period; }
  void piece(MotionPiece& piece) override {
    for (; sample_ < samples_per_revolution_; ++sample_) {
      const double time = period_ * sample_ / samples_per_revolution_;
      if (time >= piece.end()) return;
      spectrum_.samples()[filled_++] = piece.place_x(time);
    }
  }
  void revolution_ends(const State& /*section*/) override { sample_ = 0; }
  void write(std::span<double> row) override { spectrum_.amplitudes(row); }

 private:
  int samples_per_revolution_;
  analysis::Spectrum spectrum_;
  double period_ = 0.0;
  int sample_ = 0;          ///< next one within the revolution
  std::size_t filled_ = 0;  ///< samples so far
};

}  // namespace rubatlas::observables
