/// Multipliers of an orbit from both ends of a stretch of it: those of a pencil, either matrix of which may
/// have no inverse.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "integrate/decompositions.hpp"

namespace rubatlas::test {
namespace {

using Eigen::Matrix4d;
using Values = std::array<std::complex<double>, 4>;

/// A matrix with entries in [-1, 1] which has an inverse: its diagonal outweighs them.
Matrix4d random_matrix(std::mt19937_64& generator) {
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  Matrix4d result = 5.0 * Matrix4d::Identity();
  for (double& value : result.reshaped()) value += entry(generator);
  return result;
}

/// Those of X A Y against X B Y, with random X and Y.
Values values_of(const Matrix4d& matrix, const Matrix4d& other, std::mt19937_64& generator) {
  const Matrix4d left = random_matrix(generator);
  const Matrix4d right = random_matrix(generator);
  const Eigen::Vector4cd found =
      integrate::generalised_eigenvalues(left * matrix * right, left * other * right);
  Values values{};
  std::copy(found.begin(), found.end(), values.begin());
  return values;
}

/// How far the nearest of the values is from one that is expected.
double missed(const Values& values, const std::complex<double>& expected) {
  double least = INFINITY;
  for (const std::complex<double>& value : values) least = std::min(least, std::abs(value - expected));
  return least;
}

TEST(GeneralisedEigenvalues, AreThoseOfThePencilWhereverTheyLie) {
  std::mt19937_64 generator(1);
  // Folds, period doublings, a superstable orbit; and places of which an inverse is taken.
  constexpr std::array kPlaces{1.0, -1.0, 0.0, 0.3, -0.4, 0.7, -0.6, 1.6, -1.7, 1e-6, 1e4};
  std::uniform_int_distribution<std::size_t> place(0, kPlaces.size() - 1);
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector4d expected;
    for (double& value : expected) value = kPlaces.at(place(generator));
    const Values found = values_of(Matrix4d(expected.asDiagonal()), Matrix4d::Identity(), generator);
    // Values that lie together are found to the rounding of the matrices.
    for (const double value : expected)
      EXPECT_LT(missed(found, value), 1e-11 * std::max(1.0, expected.norm())) << expected.transpose();
  }
}

TEST(GeneralisedEigenvalues, OfAFocusAreAPair) {
  std::mt19937_64 generator(2);
  Matrix4d matrix = Matrix4d::Identity();
  const std::complex<double> pair = std::polar(0.9, 1.1);
  matrix.topLeftCorner<2, 2>() << pair.real(), -pair.imag(), pair.imag(), pair.real();
  const Values found = values_of(matrix, Matrix4d::Identity(), generator);
  EXPECT_LT(missed(found, pair), 1e-13);
  EXPECT_LT(missed(found, std::conj(pair)), 1e-13);
  EXPECT_LT(missed(found, 1.0), 1e-13);
}

TEST(GeneralisedEigenvalues, AreVeryLargeWhereTheSecondMatrixHasNoInverse) {
  std::mt19937_64 generator(3);
  Matrix4d other = Matrix4d::Identity();
  other(3, 3) = 0.0;
  const Values found =
      values_of(Matrix4d(Eigen::Vector4d(0.5, -1.0, 1.0, 1.0).asDiagonal()), other, generator);
  for (const double value : {0.5, -1.0, 1.0}) EXPECT_LT(missed(found, value), 1e-13);
  EXPECT_EQ(std::ranges::count_if(found, [](const auto& value) { return !(std::abs(value) < 1e12); }), 1);
}

}  // namespace
}  // namespace rubatlas::test
