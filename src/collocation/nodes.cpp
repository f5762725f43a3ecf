#include "collocation/nodes.hpp"

#include <algorithm>
#include <boost/math/special_functions/binomial.hpp>
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
  constexpr unsigned kSize = kNodes;
  NodeTables tables{};
  std::array<Real, kPlaces> place{};
  std::copy(kZeros.begin(), kZeros.end(), place.begin() + 1);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    Real weight = 1;
    for (std::size_t j = 0; j < kPlaces; ++j) {
      if (j != i) weight /= place[i] - place[j];
    }
    tables.place[i] = static_cast<double>(place[i]);
    tables.weight[i] = static_cast<double>(weight);
    if (i == 0) continue;
    tables.node[i - 1] = tables.place[i];
    tables.weight_among_nodes[i - 1] = static_cast<double>(weight * place[i]);
  }

  // Legendre's polynomials at the places, their integrals from 0 and their slopes; and Bernstein's.
  Matrix value(kPlaces, kPlaces);
  Matrix integral(kPlaces, kPlaces);
  Matrix slope(kPlaces, kPlaces);
  Matrix bernstein(kPlaces, kPlaces);
  for (unsigned i = 0; i < kPlaces; ++i) {
    const Real at = place[i];
    for (unsigned k = 0; k < kPlaces; ++k) {
      value(i, k) = legendre(k, at);
      integral(i, k) = k == 0 ? at : (legendre(k + 1, at) - legendre(k - 1, at)) / (2 * (2 * k + 1));
      slope(i, k) = 2 * boost::math::legendre_p_prime(static_cast<int>(k), 2 * at - 1);
      bernstein(i, k) = boost::math::binomial_coefficient<Real>(kNodes, k) *
                        std::pow(at, static_cast<Real>(k)) * std::pow(1 - at, static_cast<Real>(kNodes - k));
    }
  }
  const auto inverse = [](const Matrix& matrix) {
    return integrate::solve_long(matrix, Matrix::Identity(matrix.rows(), matrix.cols()));
  };
  const Matrix coefficients = inverse(value.block(1, 0, kSize, kSize));  // of degree 7, from the nodes
  const Matrix integrals = integral.block(1, 0, kSize, kSize) * coefficients;
  const Matrix slopes = slope.bottomRows(kSize) * inverse(value);
  const Matrix later = inverse(bernstein).bottomRows(kSize);
  tables.bernstein_of_start = row_of(later, 0);
  for (unsigned j = 0; j < kSize; ++j) {
    tables.integral[j] = row_of(integrals, j);
    tables.slope[j] = row_of(slopes, j + 1);
    tables.legendre[j] = row_of(coefficients, j);
    tables.bernstein[j] = row_of(later, j + 1);
    Real value_at_start = 0;  // at θ = 0 the polynomials are 1 and −1 by turns
    for (unsigned k = 0; k < kSize; ++k) value_at_start += (k % 2 == 0 ? 1 : -1) * coefficients(k, j);
    tables.value_at_start[j] = static_cast<double>(value_at_start);
  }
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
