#include "trajectory/places_in_piece.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace rubatlas::trajectory {
namespace {

/// As many as an interval of a collocated contact has nodes; a step is of order 8 at most.
constexpr unsigned kOfPath = 8;
/// Of a function of q that varies little in a step; of an oscillation of which each stretch has a whole
/// period they leave 1e-14.
constexpr unsigned kOfRoots = 10;
constexpr unsigned kOfFlight = 10;
constexpr double kStretch = 2.0 * std::numbers::pi;

/// Gauss points of [0, 1].
struct Point {
  double share;
  double weight;
};
template <unsigned kCount>
const std::array<Point, kCount>& points() {
  static const std::array<Point, kCount> kPoints = [] {
    using Gauss = boost::math::quadrature::gauss<double, kCount>;
    std::array<Point, kCount> result;
    for (std::size_t i = 0; i < kCount / 2; ++i) {
      const double half_weight = 0.5 * Gauss::weights()[i];
      result[2 * i] = {0.5 * (1.0 - Gauss::abscissa()[i]), half_weight};
      result[2 * i + 1] = {0.5 * (1.0 + Gauss::abscissa()[i]), half_weight};
    }
    return result;
  }();
  return kPoints;
}

}  // namespace

void PlacesInPiece::states(MotionPiece& piece, double fastest, const VisitPlace& visit) {
  if (piece.contact_count() > 0) {
    in_contact(piece, false, visit);
    return;
  }
  const double length = piece.end() - piece.begin();
  const int stretches = std::max(1, static_cast<int>(std::ceil(length * fastest / kStretch)));
  for (int i = 0; i < stretches; ++i) {
    for (const Point& point : points<kOfFlight>()) {
      const double time = piece.begin() + length * (i + point.share) / stretches;
      const State state = piece.state(time);
      visit(Place{point.weight * length / stretches, time, state, {}});
    }
  }
}

/// False where the mode has no path.
bool PlacesInPiece::find(MotionPiece& piece, double share, bool with_forces) {
  return with_forces ? piece.forces_on_path(share, point_, forces_) : piece.path(share, point_);
}

void PlacesInPiece::in_contact(MotionPiece& piece, bool with_forces, const VisitPlace& visit) {
  if (piece.contact_count() == 0 || piece.solved_places(with_forces, visit)) return;
  forces_.clear();
  if (piece.path(0.5, point_)) {
    for (const Point& at : points<kOfPath>()) {
      find(piece, at.share, with_forces);
      visit(Place{at.weight * point_.time_rate, point_.time, point_.state, forces_});
    }
    return;
  }
  // Without a path: a force that starts or ends like a square root of the time (MODEL 3.3) is smooth in q,
  // τ = begin + length q²(3 − 2q).
  const double length = piece.end() - piece.begin();
  for (const Point& at : points<kOfRoots>()) {
    const double q = at.share;
    const double share = q * q * (3.0 - 2.0 * q);
    const double weight = at.weight * 6.0 * q * (1.0 - q);
    const double time = piece.begin() + length * share;
    const State state = piece.state(time);
    forces_.clear();
    for (std::size_t i = 0; with_forces && i < piece.contact_count(); ++i)
      forces_.push_back(piece.contact_force(i, time));
    visit(Place{weight * length, time, state, forces_});
  }
}

}  // namespace rubatlas::trajectory
