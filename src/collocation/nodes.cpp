#include "collocation/nodes.hpp"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>

#include "integrate/decompositions.hpp"

namespace rubatlas::collocation {
namespace {

using Real = long double;
using Matrix = integrate::LongMatrix;
using boost::math::legendre_p;

Real legendre(std::size_t degree, Real fraction) {
  return legendre_p(static_cast<int>(degree), 2 * fraction - 1);
}

/// Zeros of P8 − P7 of 2θ − 1 in (0, 1].
constexpr std::array<Real, kNodes> kZeros{
    0.022479386438712498111L, 0.11467905316090423191L, 0.26578982278458946850L, 0.45284637366944461700L,
    0.64737528288683036264L,  0.81975930826310763498L, 0.94373743946307785352L, 1.0L};

AtNodes row_of(const Matrix& matrix, Eigen::Index column) {
  AtNodes row;
  for (std::size_t i = 0; i < kNodes; ++i)
    row[i] = static_cast<double>(matrix(static_cast<Eigen::Index>(i), column));
  return row;
}

/// Lagrange's polynomials of these places at θ.
template <std::size_t kCount>
std::array<double, kCount> barycentric(double fraction, const std::array<double, kCount>& places,
                                       const std::array<double, kCount>& weights) {
  std::array<double, kCount> basis;
  for (std::size_t i = 0; i < kCount; ++i) basis[i] = weights[i] / (fraction - places[i]);
  double sum = 0.0;
  for (const double value : basis) sum += value;
  if (std::isfinite(sum)) {
    for (double& value : basis) value /= sum;
    return basis;
  }
  // It is one of the places.
  for (std::size_t i = 0; i < kCount; ++i) basis[i] = fraction == places[i] ? 1.0 : 0.0;
  return basis;
}

NodeTables make_tables() {
  constexpr auto kSize = static_cast<Eigen::Index>(kNodes);
  const std::array<Real, kNodes>& at = kZeros;
  NodeTables tables{};
  for (std::size_t i = 0; i < kNodes; ++i) {
    tables.node[i] = static_cast<double>(at[i]);
    tables.place[i + 1] = tables.node[i];
  }

  // Legendre's polynomials at the nodes, and their integrals from 0 to the nodes.
  Matrix value(kSize, kSize);
  Matrix integral(kSize, kSize);
  for (std::size_t i = 0; i < kNodes; ++i) {
    for (std::size_t k = 0; k < kNodes; ++k) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto column = static_cast<Eigen::Index>(k);
      value(row, column) = legendre(k, at[i]);
      integral(row, column) =
          k == 0 ? at[i]
                 : (legendre(k + 1, at[i]) - legendre(k - 1, at[i])) / (2 * (2 * static_cast<Real>(k) + 1));
    }
  }
  const Matrix coefficients = integrate::solve_long(value, Matrix::Identity(kSize, kSize));
  const Matrix integrals = integral * coefficients;
  for (std::size_t j = 0; j < kNodes; ++j)
    tables.integral[j] = row_of(integrals, static_cast<Eigen::Index>(j));
  for (std::size_t j = 0; j < kNodes; ++j)
    tables.legendre[j] = row_of(coefficients, static_cast<Eigen::Index>(j));

  std::array<Real, kPlaces> place{};
  std::copy(at.begin(), at.end(), place.begin() + 1);
  std::array<Real, kPlaces> weight{};
  for (std::size_t i = 0; i < kPlaces; ++i) {
    weight[i] = 1;
    for (std::size_t j = 0; j < kPlaces; ++j) {
      if (j != i) weight[i] /= place[i] - place[j];
    }
    tables.weight[i] = static_cast<double>(weight[i]);
    if (i > 0) tables.weight_among_nodes[i - 1] = static_cast<double>(weight[i] * place[i]);
  }
  for (std::size_t j = 0; j < kNodes; ++j) {
    Real value_at_start = 1;
    for (std::size_t k = 0; k < kNodes; ++k) {
      if (k != j) value_at_start *= at[k] / (at[k] - at[j]);
    }
    tables.value_at_start[j] = static_cast<double>(value_at_start);
  }
  for (std::size_t j = 1; j < kPlaces; ++j) {
    for (std::size_t i = 1; i < kPlaces; ++i) {
      Real slope = 0;
      if (i == j) {
        for (std::size_t k = 0; k < kPlaces; ++k) {
          if (k != j) slope += 1 / (place[j] - place[k]);
        }
      } else {
        slope = weight[j] / weight[i] / (place[i] - place[j]);
      }
      tables.slope[j - 1][i - 1] = static_cast<double>(slope);
    }
  }

  Matrix bernstein(kPlaces, kPlaces);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    Real binomial = 1;
    for (std::size_t k = 0; k < kPlaces; ++k) {
      Real term = binomial;
      for (std::size_t power = 0; power < k; ++power) term *= place[i];
      for (std::size_t power = k; power < kNodes; ++power) term *= 1 - place[i];
      bernstein(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = term;
      binomial = binomial * static_cast<Real>(kNodes - k) / static_cast<Real>(k + 1);
    }
  }
  const Matrix to_bernstein = integrate::solve_long(bernstein, Matrix::Identity(kPlaces, kPlaces));
  const Matrix later = to_bernstein.bottomRows(kSize);
  tables.bernstein_of_start = row_of(later, 0);
  for (std::size_t j = 0; j < kNodes; ++j)
    tables.bernstein[j] = row_of(later, static_cast<Eigen::Index>(j + 1));
  return tables;
}

}  // namespace

const NodeTables kNodeTables = make_tables();

AtPlaces basis_at(double fraction) {
  return barycentric(fraction, kNodeTables.place, kNodeTables.weight);
}
AtNodes slope_basis_at(double fraction) {
  return {barycentric(fraction, kNodeTables.node.value, kNodeTables.weight_among_nodes.value)};
}

}  // namespace rubatlas::collocation
