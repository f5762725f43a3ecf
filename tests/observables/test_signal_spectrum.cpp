// Amplitude spectrum against signals whose Fourier series is known.
#include "observables/signal_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace rubatlas::observables {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Amplitudes of a signal given as a function of the time in revolutions.
template <typename Signal>
std::vector<double> amplitudes_of(int revolutions, int samples_per_revolution, int max_order, Signal signal) {
  Spectrum spectrum(revolutions, samples_per_revolution, max_order);
  auto samples = spectrum.samples();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = signal(static_cast<double>(i) / samples_per_revolution);
  }
  std::vector<double> result(spectrum.order_count());
  spectrum.amplitudes(result);
  return result;
}

TEST(Spectrum, KeepsOrdersFromZeroToTheHighestInStepsOfOneOverTheRevolutions) {
  EXPECT_EQ(Spectrum(100, 256, 12).order_count(), 1201U);
  EXPECT_EQ(Spectrum(1, 8, 4).order_count(), 5U);
}

TEST(Spectrum, GivesZeroToPeakAmplitudesOfSinusoidsAtTheirOwnOrders) {
  const int revolutions = 20;
  const auto amplitudes = amplitudes_of(revolutions, 64, 12, [](double t) {
    return 3e-3 * std::sin(kTwoPi * t + 0.3) + 7e-4 * std::cos(kTwoPi * 2.5 * t) +
           2e-5 * std::sin(kTwoPi * 12.0 * t);
  });
  for (std::size_t k = 0; k < amplitudes.size(); ++k) {
    const double expected = k == 20 ? 3e-3 : k == 50 ? 7e-4 : k == 240 ? 2e-5 : 0.0;
    EXPECT_NEAR(amplitudes[k], expected, 1e-17) << "line " << k;
  }
}

TEST(Spectrum, GivesTheMeanAtOrderZeroWithoutDoublingIt) {
  const auto amplitudes = amplitudes_of(7, 32, 3, [](double t) { return -0.25 + std::cos(kTwoPi * t); });
  EXPECT_NEAR(amplitudes[0], 0.25, 1e-15);
  EXPECT_NEAR(amplitudes[7], 1.0, 1e-14);
}

TEST(Spectrum, GivesTheNyquistOrderWithoutDoublingIt) {
  const auto amplitudes = amplitudes_of(5, 8, 4, [](double t) { return 0.5 * std::cos(kTwoPi * 4.0 * t); });
  EXPECT_NEAR(amplitudes.back(), 0.5, 1e-15);
}

TEST(Spectrum, HoldsThePowerOfTheSignal) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const int revolutions = 9;
  const int samples = 16;
  std::vector<double> noise(static_cast<std::size_t>(revolutions * samples));
  for (auto& value : noise) value = normal(random);
  const auto amplitudes = amplitudes_of(revolutions, samples, samples / 2, [&](double t) {
    return noise[static_cast<std::size_t>(std::lround(t * samples))];
  });
  double power = 0.0;
  for (const double value : noise) power += value * value / static_cast<double>(noise.size());
  double sum = amplitudes.front() * amplitudes.front() + amplitudes.back() * amplitudes.back();
  for (std::size_t k = 1; k + 1 < amplitudes.size(); ++k) sum += 0.5 * amplitudes[k] * amplitudes[k];
  EXPECT_NEAR(sum, power, 1e-13 * power);
}

TEST(Spectrum, GivesTheSameBitsEveryTime) {
  const auto signal = [](double t) { return std::sin(kTwoPi * 1.37 * t) + std::exp(-t); };
  const auto first = amplitudes_of(100, 256, 12, signal);
  const std::vector<double> in_between(12345, 1.0);  // moves the heap, so that alignments differ
  EXPECT_EQ(first, amplitudes_of(100, 256, 12, signal));
}

}  // namespace
}  // namespace rubatlas::observables
