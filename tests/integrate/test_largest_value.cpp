/// The largest value of a function between samples of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "integrate/largest_value.hpp"

namespace rubatlas::integrate {
namespace {

template <std::size_t kCount, class Function>
Sample largest_of(const Function& function, double known = 0.0) {
  std::array<Sample, kCount> samples{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const double argument = static_cast<double>(i) / (kCount - 1);
    samples[i] = {argument, function(argument)};
  }
  return largest_value(function, samples, known);
}

TEST(LargestValue, OfAParabolaIsFoundWhereverItsTopLies) {
  for (int i = -10; i <= 110; ++i) {
    const double top = i / 100.0;
    const auto parabola = [&](double x) { return 2.0 - (x - top) * (x - top); };
    const double nearest = std::fmin(1.0, std::fmax(0.0, top));
    const Sample found = largest_of<3>(parabola);
    EXPECT_NEAR(found.argument, nearest, 3e-6) << top;
    EXPECT_NEAR(found.value, parabola(nearest), 1e-11) << top;
  }
}

TEST(LargestValue, IsThatOfTheHigherOfTwoTopsThoughTheOtherHasTheLargestSample) {
  // Tops near 1/4 and at 0.87; samples at the quarters.
  const auto wave = [](double x) {
    return std::sin(2.0 * std::numbers::pi * (x - 0.25) / 0.62 + std::numbers::pi / 2) + 0.15 * x;
  };
  EXPECT_GT(wave(0.25), wave(0.75));
  EXPECT_GT(wave(0.25), wave(1.0));
  const Sample found = largest_of<5>(wave);
  EXPECT_NEAR(found.argument, 0.87, 0.01);
  EXPECT_GT(found.value, 1.12);
}

TEST(LargestValue, IsNotLookedForWhereItCannotExceedWhatIsKnown) {
  int calls = 0;
  const auto counted = [&](double x) {
    ++calls;
    return x * (1.0 - x);
  };
  largest_of<5>(counted, 1.0);
  EXPECT_EQ(calls, 5);
}

}  // namespace
}  // namespace rubatlas::integrate
