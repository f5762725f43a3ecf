#include "trajectory/places_in_piece.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace rubatlas::trajectory {
namespace {

constexpr unsigned kPoints = 10;  ///< of Gauss
/// Of an oscillation of which each stretch has a whole period they leave 1e-14.
constexpr double kStretch = 2.0 * std::numbers::pi;

struct Point {
  double share;  ///< of [0, 1]
  double weight;
};
const std::array<Point, kPoints>& points() {
  static const std::array<Point, kPoints> kAll = [] {
    using Gauss = boost::math::quadrature::gauss<double, kPoints>;
    std::array<Point, kPoints> result;
    for (std::size_t i = 0; i < kPoints / 2; ++i) {
      const double half_weight = 0.5 * Gauss::weights()[i];
      result[2 * i] = {0.5 * (1.0 - Gauss::abscissa()[i]), half_weight};
      result[2 * i + 1] = {0.5 * (1.0 + Gauss::abscissa()[i]), half_weight};
    }
    return result;
  }();
  return kAll;
}

}  // namespace

void PlacesInPiece::rubs(MotionPiece& piece, const VisitRub& visit) {
  if (piece.solved_rubs(visit)) return;
  with_forces(piece, [&](const Place& place) {
    for (std::size_t i = 0; i < place.forces.size(); ++i)
      visit({i, place.weight, place.forces[i].normal, place.forces[i].friction_power()});
  });
}

void PlacesInPiece::states(MotionPiece& piece, const Pace& pace, const VisitPlace& visit) {
  if (piece.contact_count() > 0) {
    in_contact(piece, false, visit);
    return;
  }
  const auto between = [&](double begin, double end, double fastest) {
    const double length = end - begin;
    const int stretches = std::max(1, static_cast<int>(std::ceil(length * fastest / kStretch)));
    for (int i = 0; i < stretches; ++i) {
      for (const Point& point : points()) {
        const double time = begin + length * (i + point.share) / stretches;
        const State state = piece.state(time);
        visit(Place{point.weight * length / stretches, time, state, {}});
      }
    }
  };
  // What decays fast is soon gone to rounding, also where it is multiplied by what does not.
  constexpr double kGone = 80.0;
  const double slow = piece.begin() + kGone / pace.decay;
  if (pace.decay <= pace.frequency || slow >= piece.end()) {
    between(piece.begin(), piece.end(), std::max(pace.frequency, pace.decay));
  } else {
    between(piece.begin(), slow, pace.decay);
    between(slow, piece.end(), pace.frequency);
  }
}

void PlacesInPiece::in_contact(MotionPiece& piece, bool with_forces, const VisitPlace& visit) {
  if (piece.contact_count() == 0 || piece.solved_places(with_forces, visit)) return;
  forces_.clear();
  for (const Point& at : points()) {
    piece.path(at.share, point_, with_forces ? &forces_ : nullptr);
    visit(Place{at.weight * point_.time_rate, point_.time, point_.state, forces_});
  }
}

}  // namespace rubatlas::trajectory
