/// Amplitude spectrum of a uniformly sampled signal over a whole number of revolutions: of one coordinate,
/// and the full spectrum of a motion in the plane.
///
/// No window: the record is a whole number of revolutions, so every harmonic of the revolution falls on a
/// line. Amplitudes are 0-peak: 2|X_k|/N, and |X_k|/N at order 0 and at Nyquist.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace rubatlas::observables {

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

  /// Transforms the record.
  void transform();
  /// X_k/N of order k/revolutions after that: the record is Σ X_k/N e^{2πi kj/N} over the samples j.
  [[nodiscard]] std::complex<double> line(std::size_t k) const;
  /// The line of order k/revolutions is that of half the sampling rate.
  [[nodiscard]] bool is_nyquist(std::size_t k) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// The full spectrum: of z = x + iy, which is Σ Z_k e^{2πi kj/N}, the radii |Z_k| of the circles that it is
/// made of, turning from x to y (k > 0) and from y to x (k < 0). A motion along a line has |Z_k| = |Z_−k|,
/// half of its amplitude each. Source: Goldman and Muszynska, Application of full spectrum to rotating
/// machinery diagnostics, Orbit 20 (1999) 17–21.
class FullSpectrum {
 public:
  /// As `Spectrum`.
  FullSpectrum(int revolutions, int samples_per_revolution, int max_order);

  /// Number of orders kept: 2 * max_order * revolutions + 1.
  [[nodiscard]] std::size_t order_count() const { return 2 * x_.order_count() - 1; }
  /// The records to fill.
  [[nodiscard]] std::span<double> x() { return x_.samples(); }
  [[nodiscard]] std::span<double> y() { return y_.samples(); }
  /// Transforms the records and writes `order_count()` radii of orders −max_order to max_order, in the unit
  /// of the signal. At Nyquist, where samples do not tell the directions apart, each has a half.
  void amplitudes(std::span<double> result);

 private:
  Spectrum x_;
  Spectrum y_;
};

}  // namespace rubatlas::observables
