/// Numbers of the collocation method with eight Radau IIA nodes: order 15 at the end of an interval, 8
/// within.
///
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.5: the nodes in (0, 1]
/// are the zeros of P8(2θ − 1) − P7(2θ − 1), P Legendre's polynomials.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace rubatlas::collocation {

inline constexpr std::size_t kNodes = 8;
inline constexpr std::size_t kPlaces = kNodes + 1;  ///< the start of the interval and the nodes

/// A number at each node.
struct alignas(64) AtNodes {
  std::array<double, kNodes> value{};
  double& operator[](std::size_t node) { return value[node]; }
  double operator[](std::size_t node) const { return value[node]; }
  [[nodiscard]] double at_end() const { return value[kNodes - 1]; }
};
/// A number at the start of the interval and at each node.
using AtPlaces = std::array<double, kPlaces>;

struct NodeTables {
  AtNodes node;  ///< θ
  /// [j][i]: integral from 0 to node i of the polynomial of degree 7 that is 1 at node j, 0 at the others.
  std::array<AtNodes, kNodes> integral;
  /// [j][i]: slope at node i of the polynomial of degree 8 that is 1 at node j, 0 at the others and at 0.
  std::array<AtNodes, kNodes> slope;
  /// [k][j]: what node j contributes to coefficient 5 + k of Legendre's polynomials of 2θ − 1.
  std::array<AtNodes, 3> last_coefficients;
  /// [k][j]: what place j contributes to coefficient k of Bernstein's polynomials of degree 8.
  std::array<AtPlaces, kPlaces> bernstein;
  AtPlaces place;   ///< θ of the places
  AtPlaces weight;  ///< barycentric weights of the places
};
const NodeTables& node_tables();

/// Values at θ of the polynomials of degree 8 that are 1 at one place and 0 at the others.
AtPlaces basis_at(double fraction);

inline double sum_of_products(const AtPlaces& a, const AtPlaces& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kPlaces; ++i) sum += a[i] * b[i];
  return sum;
}

/// Whether the polynomial of degree 8 with these values at the places is positive throughout the interval:
/// true where all of its Bernstein coefficients are. `from_zero`: it is zero at the start, which does not
/// count.
bool proven_positive(const AtPlaces& values, bool from_zero = false);

/// Least and greatest value at the places, and bounds of the polynomial through them: it goes beyond them by
/// (Λ − 1)/2 of their difference at most, and Lebesgue's constant Λ of the places is below 3.
struct Extent {
  double least;
  double greatest;
  [[nodiscard]] double lower_bound() const { return least - (greatest - least); }
  [[nodiscard]] double upper_bound() const { return greatest + (greatest - least); }
  [[nodiscard]] double magnitude_bound() const { return std::max(upper_bound(), -lower_bound()); }
};
inline Extent extent(double start, const AtNodes& nodes) {
  Extent result{start, start};
  for (const double value : nodes.value) {
    result.least = std::min(result.least, value);
    result.greatest = std::max(result.greatest, value);
  }
  return result;
}
inline AtPlaces at_places(double start, const AtNodes& nodes) {
  AtPlaces values{start};
  std::copy(nodes.value.begin(), nodes.value.end(), values.begin() + 1);
  return values;
}

}  // namespace rubatlas::collocation
