/// The spectrum of motions made of known harmonics.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "observables/spectrum.hpp"
#include "synthetic_motion.hpp"

namespace rubatlas::observables {
namespace {

constexpr int kRevolutions = 10;

settings::Scene scene_of(int samples_per_revolution, int max_order) {
  settings::Scene scene;
  scene.protocol.sampled_revolutions = kRevolutions;
  scene.protocol.samples_per_revolution = samples_per_revolution;
  scene.spectrum.max_order = max_order;
  return scene;
}

std::vector<double> spectrum_of(const settings::Scene& scene, double speed_ratio,
                                const std::function<trajectory::State(double)>& motion) {
  SpectrumOfDisplacement spectrum(scene);
  feed(spectrum, point_at(speed_ratio, 3), kRevolutions, motion);
  std::vector<double> row(static_cast<std::size_t>(scene.spectrum.max_order * kRevolutions + 1));
  spectrum.write(row);
  return row;
}

TEST(SpectrumOfDisplacement, ShowsEachHarmonicAtItsOrderWithItsAmplitude) {
  const double speed = 0.62;
  const auto motion = [speed](double time) {
    const double phase = speed * time;
    // y must not matter.
    return trajectory::State{
        1e-3 - 2e-3 * std::cos(phase + 0.3) + 5e-4 * std::sin(3 * phase) + 7e-5 * std::cos(2.5 * phase), 0.1,
        0, 0};
  };
  const auto row = spectrum_of(scene_of(256, 12), speed, motion);
  ASSERT_EQ(row.size(), 121U);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double expected = i == 0 ? 1e-3 : i == 10 ? 2e-3 : i == 30 ? 5e-4 : i == 25 ? 7e-5 : 0.0;
    EXPECT_NEAR(row[i], expected, 1e-16) << "order " << static_cast<double>(i) / kRevolutions;
  }
}

TEST(SpectrumOfDisplacement, ReachesTheNyquistOrder) {
  const auto motion = [](double time) { return trajectory::State{3e-3 * std::cos(4 * 0.5 * time), 0, 0, 0}; };
  const auto row = spectrum_of(scene_of(8, 4), 0.5, motion);
  ASSERT_EQ(row.size(), 41U);
  EXPECT_NEAR(row.back(), 3e-3, 1e-16) << "|X|/N at Nyquist";
  EXPECT_NEAR(row[20], 0.0, 1e-16);
}

TEST(SpectrumOfDisplacement, ForgetsThePointBefore) {
  const settings::Scene scene = scene_of(64, 4);
  SpectrumOfDisplacement spectrum(scene);
  std::vector<double> row(41);
  for (const double size : {5.0, 1e-3}) {
    feed(spectrum, point_at(0.8, 3), kRevolutions, [size](double time) {
      return trajectory::State{size * std::cos(0.8 * time), 0, 0, 0};
    });
    spectrum.write(row);
    EXPECT_NEAR(row[10], size, 1e-13 * size);
    EXPECT_NEAR(row[0], 0.0, 1e-13 * size);
  }
}

std::vector<double> full_spectrum_of(const settings::Scene& scene, double speed_ratio,
                                     const std::function<trajectory::State(double)>& motion) {
  FullSpectrumOfDisplacement spectrum(scene);
  trajectory::PointConstants point = point_at(std::abs(speed_ratio), 3);
  point.speed_ratio = speed_ratio;
  feed(spectrum, point, kRevolutions, motion);
  std::vector<double> row(static_cast<std::size_t>(2 * scene.spectrum.max_order * kRevolutions + 1));
  spectrum.write(row);
  return row;
}

TEST(FullSpectrum, TellsForwardFromBackwardWhirl) {
  for (const double speed : {0.62, -0.62}) {
    const auto motion = [speed](double time) {
      const std::complex<double> z =
          std::complex<double>(1e-3, -2e-3) + std::polar(3e-3, speed * time + 0.3) +
          std::polar(5e-4, -speed * time - 0.1) + std::polar(7e-5, -2.5 * speed * time);
      return trajectory::State{z.real(), z.imag(), 0, 0};
    };
    const auto row = full_spectrum_of(scene_of(256, 12), speed, motion);
    ASSERT_EQ(row.size(), 241U);
    for (int i = 0; i < 241; ++i) {
      const int line = i - 120;
      const double expected = line == 0     ? std::hypot(1e-3, 2e-3)
                              : line == 10  ? 3e-3
                              : line == -10 ? 5e-4
                              : line == -25 ? 7e-5
                                            : 0.0;
      EXPECT_NEAR(row[static_cast<std::size_t>(i)], expected, 1e-16)
          << "order " << line / 10.0 << " at speed ratio " << speed;
    }
  }
}

TEST(FullSpectrum, HasHalfOfEachAmplitudeOfAMotionAlongXOnEitherSide) {
  const auto motion = [](double time) {
    return trajectory::State{1e-3 + 2e-3 * std::cos(0.5 * time) + 4e-4 * std::sin(1.7 * 0.5 * time) +
                                 3e-3 * std::cos(4 * 0.5 * time),
                             0, 0, 0};
  };
  const settings::Scene scene = scene_of(8, 4);  // the last order is that of Nyquist
  const auto amplitude = spectrum_of(scene, 0.5, motion);
  const auto radius = full_spectrum_of(scene, 0.5, motion);
  const std::size_t middle = amplitude.size() - 1;
  EXPECT_EQ(radius[middle], amplitude[0]);
  for (std::size_t i = 1; i <= middle; ++i) {
    EXPECT_EQ(radius[middle + i], radius[middle - i]);
    EXPECT_NEAR(radius[middle + i] + radius[middle - i], amplitude[i], 1e-17) << i;
  }
}

}  // namespace
}  // namespace rubatlas::observables
