#include "observables/signal_spectrum.hpp"

#include <fftw3.h>

#include <cmath>
#include <complex>

namespace rubatlas::observables {

// FFTW_ESTIMATE and arrays from fftw_malloc: a measured plan, or another alignment, would round differently
// from run to run, whereas the atlas has to have equal bytes.
struct Spectrum::Plan {
  int revolutions;
  int max_order;
  int length;
  double* signal;
  fftw_complex* transform;
  fftw_plan plan;
};

Spectrum::Spectrum(int revolutions, int samples_per_revolution, int max_order)
    : plan_(std::make_unique<Plan>()) {
  plan_->revolutions = revolutions;
  plan_->max_order = max_order;
  plan_->length = revolutions * samples_per_revolution;
  const auto length = static_cast<std::size_t>(plan_->length);
  plan_->signal = fftw_alloc_real(length);
  plan_->transform = fftw_alloc_complex(length / 2 + 1);
  plan_->plan = fftw_plan_dft_r2c_1d(plan_->length, plan_->signal, plan_->transform, FFTW_ESTIMATE);
}

Spectrum::~Spectrum() {
  fftw_destroy_plan(plan_->plan);
  fftw_free(plan_->transform);
  fftw_free(plan_->signal);
}

std::size_t Spectrum::order_count() const {
  return static_cast<std::size_t>(plan_->max_order) * static_cast<std::size_t>(plan_->revolutions) + 1;
}

std::span<double> Spectrum::samples() {
  return {plan_->signal, static_cast<std::size_t>(plan_->length)};
}

void Spectrum::transform() {
  fftw_execute(plan_->plan);
}

std::complex<double> Spectrum::line(std::size_t k) const {
  return std::complex<double>(plan_->transform[k][0], plan_->transform[k][1]) /
         static_cast<double>(plan_->length);
}

bool Spectrum::is_nyquist(std::size_t k) const {
  return 2 * k == static_cast<std::size_t>(plan_->length);
}

void Spectrum::amplitudes(std::span<double> result) {
  transform();
  for (std::size_t k = 0; k < result.size(); ++k) {
    const bool once = k == 0 || is_nyquist(k);
    const double magnitude = std::hypot(plan_->transform[k][0], plan_->transform[k][1]);
    result[k] = (once ? 1.0 : 2.0) * magnitude / plan_->length;
  }
}

FullSpectrum::FullSpectrum(int revolutions, int samples_per_revolution, int max_order)
    : x_(revolutions, samples_per_revolution, max_order),
      y_(revolutions, samples_per_revolution, max_order) {}

// x and y are real, so that Z_k = X_k + i Y_k and the conjugate of Z_−k is X_k − i Y_k.
void FullSpectrum::amplitudes(std::span<double> result) {
  x_.transform();
  y_.transform();
  const std::size_t middle = x_.order_count() - 1;
  for (std::size_t k = 0; k <= middle; ++k) {
    const std::complex<double> x = x_.line(k);
    const std::complex<double> across = std::complex<double>(0.0, 1.0) * y_.line(k);
    const double share = x_.is_nyquist(k) ? 0.5 : 1.0;
    result[middle + k] = share * std::abs(x + across);
    result[middle - k] = share * std::abs(x - across);
  }
}

}  // namespace rubatlas::observables
