/// Amplitude spectrum of a uniformly sampled real signal over a whole number of revolutions.
///
/// No window: the record is a whole number of revolutions, so every harmonic of the revolution falls on a
/// line. Amplitudes are 0-peak: 2|X_k|/N, and |X_k|/N at order 0 and at Nyquist.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace rubatlas::analysis {

class Spectrum {
 public:
  /// A record of `revolutions * samples_per_revolution` samples; orders 0, 1/revolutions, ... max_order are
  /// kept.
  Spectrum(int revolutions, int samples_per_revolution, int max_order);
  ~Spectrum();
  Spectrum(const Spectrum&) = delete;
  Spectrum& operator=(const Spectrum&) = delete;

  /// Number of orders kept: max_order * revolutions + 1.
  [[nodiscard]] std::size_t order_count() const;
  /// The record to fill, in the unit of the signal.
  [[nodiscard]] std::span<double> samples();
  /// Transforms the record and writes `order_count()` amplitudes, in the unit of the signal.
  void amplitudes(std::span<double> result);

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace rubatlas::analysis
