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
/// How much farther from its value at the start than at any node the polynomial through both may go: the
/// largest sum of magnitudes of Lagrange's polynomials of the nodes, 2.4275, which is at θ = 0.55.
inline constexpr double kFarther = 2.43;

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
  /// [j][k]: what node j contributes to coefficient k of Legendre's polynomials of 2θ − 1.
  std::array<AtNodes, kNodes> legendre;
  /// [j][k]: what node j, and what the start, contributes to coefficient 1 + k of Bernstein's polynomials of
  /// degree 8. Coefficient 0 is the value at the start.
  std::array<AtNodes, kNodes> bernstein;
  AtNodes bernstein_of_start;
  AtPlaces place;              ///< θ of the places
  AtPlaces weight;             ///< barycentric weights of the places
  AtNodes weight_among_nodes;  ///< those of the nodes without the start
  AtNodes value_at_start;      ///< at θ = 0 of the polynomials of degree 7 that are 1 at one node
};
extern const NodeTables kNodeTables;

/// Values at θ of the polynomials of degree 8 that are 1 at one place and 0 at the others.
AtPlaces basis_at(double fraction);
/// The same of the polynomials of degree 7 through the nodes alone: for slopes by θ.
AtNodes slope_basis_at(double fraction);

template <std::size_t kCount>
double sum_of_products(const std::array<double, kCount>& a, const std::array<double, kCount>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) sum += a[i] * b[i];
  return sum;
}
inline double sum_of_products(const AtNodes& a, const AtNodes& b) {
  return sum_of_products(a.value, b.value);
}

inline AtPlaces at_places(double start, const AtNodes& nodes) {
  AtPlaces values{start};
  std::copy(nodes.value.begin(), nodes.value.end(), values.begin() + 1);
  return values;
}

}  // namespace rubatlas::collocation
