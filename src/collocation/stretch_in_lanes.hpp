/// A first guess of a stretch of an interval: the interval's polynomials at the nodes of the stretch. As the
/// sweeps, compiled once for each kind of processor.
#pragma once

#include <array>
#include <cstddef>

#include "collocation/interval.hpp"
#include "collocation/nodes_in_lanes.hpp"

namespace rubatlas::collocation {
namespace {

/// `IntervalSolver::read_stretch`.
template <std::size_t kWidth>
void read_stretch(const Machine& machine, const Interval& interval, double fraction, Interval& stretch) {
  using Number = Lanes<kWidth>;
  const NodeTables& tables = kNodeTables;
  const Number node = Number(tables.node) * fraction;
  // Lagrange's polynomials in barycentric form. A node that is at a place of the interval is a little beside
  // it, so that the quotient of both sums is the value there.
  constexpr double kBeside = 1e-290;
  const auto share_of = [&](std::size_t place) {
    return Number(tables.weight[place]) / (node - tables.place[place] + kBeside);
  };
  const Number of_start = share_of(0);
  std::array<AtNodes, kNodes> of_nodes;
  Number sum = of_start;
  for (std::size_t j = 0; j < kNodes; ++j) {
    const Number share = share_of(j + 1);
    share.store(of_nodes[j]);
    sum = sum + share;
  }
  const Number per_sum = Number(1.0) / sum;
  const auto read = [&](double start, const AtNodes& from, AtNodes& to) {
    ((Number::combined(of_nodes, Number(from)) + of_start * start) * per_sum).store(to);
  };
  read(0.0, interval.deviation, stretch.deviation);
  const auto read_body = [&](const Body& from, Body& to) {
    read(from.start[0], from.x, to.x);
    read(from.start[1], from.y, to.y);
    read(from.start[2], from.vx, to.vx);
    read(from.start[3], from.vy, to.vy);
  };
  read_body(interval.shaft, stretch.shaft);
  if (machine.ring.moves) read_body(interval.ring, stretch.ring);
  for (std::size_t k = 0; k < interval.tips.size(); ++k) {
    const TipInTime& from = interval.tips[k];
    if (k > 0) read(from.start_square, from.square, stretch.tips[k].square);
    if (interval.leans()) read(from.start_lean, from.lean, stretch.tips[k].lean);
  }
}

}  // namespace
}  // namespace rubatlas::collocation
