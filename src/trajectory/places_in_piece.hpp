/// Places of a piece of motion and their weights: ∫ f dτ over the piece is the sum of weight × f there.
#pragma once

#include <vector>

#include "trajectory/motion_piece.hpp"

namespace rubatlas::trajectory {

class PlacesInPiece {
 public:
  /// Hands places of a piece in contact to `visit`, with the forces there.
  void with_forces(MotionPiece& piece, const VisitPlace& visit) { in_contact(piece, true, visit); }
  /// The same without forces, of any piece. `fastest`: frequency, or rate of decay, of what is summed up in
  /// flight.
  void states(MotionPiece& piece, double fastest, const VisitPlace& visit);

 private:
  void in_contact(MotionPiece& piece, bool with_forces, const VisitPlace& visit);

  PathPoint point_;
  std::vector<ContactForce> forces_;
};

}  // namespace rubatlas::trajectory
