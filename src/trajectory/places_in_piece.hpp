/// Places of a piece of motion and their weights: ∫ f dτ over the piece is the sum of weight × f there.
#pragma once

#include <vector>

#include "trajectory/motion_piece.hpp"

namespace rubatlas::trajectory {

class PlacesInPiece {
 public:
  /// Hands places of a piece in contact to `visit`, with the forces there.
  void with_forces(MotionPiece& piece, const VisitPlace& visit) { in_contact(piece, true, visit); }
  /// Hands how the tips of a piece in contact rub to `visit`.
  void rubs(MotionPiece& piece, const VisitRub& visit);
  /// How fast what is summed up changes in flight [per unit τ].
  struct Pace {
    double frequency;  ///< the highest
    double decay;      ///< the highest rate
  };
  /// The same without forces, of any piece.
  void states(MotionPiece& piece, const Pace& pace, const VisitPlace& visit);

 private:
  void in_contact(MotionPiece& piece, bool with_forces, const VisitPlace& visit);

  PathPoint point_;
  std::vector<ContactForce> forces_;
};

}  // namespace rubatlas::trajectory
