/// The curve of a blade over p = asinh(u/β), for eight nodes at once.
///
/// In u the curve has branch points at ±iβ, next to the unloaded blade where friction is small. In p they are
/// gone, so that pieces of one width and degree 11 follow it everywhere to 2e-13, and the piece of a number
/// is found by one multiplication. Where friction is large the end of the curve, ψL = π, is near in p, and
/// pieces are narrower.
///
/// Without friction, β = 0, p = sqrt(u): a column's deflection, which grows as u, then grows as p², as that
/// of any other blade does.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rubatlas::blade {

class ElasticaCurve;

class BendingTable {
 public:
  /// Up to a shortening of 0.6 L at least.
  explicit BendingTable(const blade::ElasticaCurve& curve);

  static constexpr std::size_t kDegree = 11;
  /// Of powers of t in [0, 1]: F L²/EI, δ/L, Δ/L, 0.
  struct Piece {
    alignas(32) std::array<std::array<double, 4>, kDegree + 1> coefficients;
  };
  [[nodiscard]] const Piece* pieces() const { return pieces_.data(); }
  [[nodiscard]] double width() const { return width_; }  ///< of a piece in p, a power of two
  [[nodiscard]] int last_piece() const { return static_cast<int>(pieces_.size()) - 1; }

  [[nodiscard]] double scale() const { return scale_; }  ///< β
  [[nodiscard]] double bending(double p) const {         ///< u
    return scale_ > 0.0 ? scale_ * std::sinh(p) : p * p;
  }
  [[nodiscard]] double bending_slope(double p) const {  ///< du/dp
    return scale_ > 0.0 ? scale_ * std::cosh(p) : 2.0 * p;
  }
  [[nodiscard]] double argument(double u) const {  ///< p
    return scale_ > 0.0 ? std::asinh(u / scale_) : std::sqrt(u);
  }
  [[nodiscard]] double bending_slope_at(double u) const {  ///< du/dp
    return scale_ > 0.0 ? std::sqrt(scale_ * scale_ + u * u) : 2.0 * std::sqrt(u);
  }

  /// The curve at the ends of the pieces, for estimates.
  struct Knot {
    double argument;  ///< p
    double load;
    double shortening;
    double deflection;
  };
  [[nodiscard]] const std::vector<Knot>& knots() const { return knots_; }

 private:
  /// With pieces of the present width. False where they are not so exact.
  bool fill(const ElasticaCurve& curve);

  double scale_;          ///< β
  double width_ = 0.125;  ///< in p
  std::vector<Piece> pieces_;
  std::vector<Knot> knots_;
};

}  // namespace rubatlas::blade
