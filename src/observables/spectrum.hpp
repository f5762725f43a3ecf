/// Observable `spectrum`: amplitude of x over order, over all sampled revolutions (`analysis/spectrum.hpp`).
#pragma once

#include <algorithm>
#include <cstddef>
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
    const SampleTimes times{period_, samples_per_revolution_};
    const int after = first_from(times, piece.end());
    if (after <= sample_) return;
    const auto count = static_cast<std::size_t>(after - sample_);
    piece.places_x(times, sample_, spectrum_.samples().subspan(filled_, count));
    filled_ += count;
    sample_ = after;
  }
  void revolution_ends(const State& /*section*/) override { sample_ = 0; }
  void write(std::span<double> row) override { spectrum_.amplitudes(row); }

 private:
  /// Number of the first time that is not before `end`.
  static int first_from(const SampleTimes& times, double end) {
    int number = std::clamp(static_cast<int>(end / times.spacing()), 0, times.count);
    while (number > 0 && times[number - 1] >= end) --number;
    while (number < times.count && times[number] < end) ++number;
    return number;
  }

  int samples_per_revolution_;
  analysis::Spectrum spectrum_;
  double period_ = 0.0;
  int sample_ = 0;          ///< next one within the revolution
  std::size_t filled_ = 0;  ///< samples so far
};

}  // namespace rubatlas::observables
