/// The blade as the solver uses it: piecewise polynomials of the bending parameter, one table per friction,
/// theory and axial compliance.
///
/// The curve is dimensionless, so that one table serves every length, width, thickness and modulus
/// (MODEL 3.2). Pieces are quarter octaves of u below 1 and sixteenths above, found from the bits of the
/// number; the first piece reaches from the unloaded blade to β/32 (1/8 where μ = 0) and keeps the exact
/// leading powers, so that errors are relative all the way down. Graded like this, pieces are short against
/// their distance from the curve's singularities u = ±iβ and ψL = π, and degree 11 leaves less than 1e-13 for
/// every μ in [0, 2]. The beam-column (`beam_column.hpp`) has u = ±iμ for ±iβ and no other singularity.
///
/// Axial compliance adds ε F L²/EI to the shortening δ/L, ε = EI/(EA L²): the axial strain F/EA of the blade,
/// taken along the undeformed blade, which is right to the order of strain times slope squared.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "blade/elastica.hpp"

namespace rubatlas::blade {

/// A point of the curve with its slope, all dimensionless; derivatives are by the bending parameter u.
struct CurvePoint {
  double load;              ///< F L² / EI
  double shortening;        ///< δ / L
  double deflection;        ///< Δ / L
  double load_slope;        ///< d(F L² / EI)/du
  double shortening_slope;  ///< d(δ/L)/du
  double deflection_slope;  ///< d(Δ/L)/du
};

/// F L²/EI of the cantilever that begins to buckle: π²/4.
inline constexpr double kEulerLoad = std::numbers::pi * std::numbers::pi / 4.0;

/// How far the blade may bend.
enum class Theory : std::uint8_t {
  elastica,    ///< large deflections (MODEL 3)
  beam_column  ///< small slopes
};

class BendingTable;

class ElasticaCurve {
 public:
  /// Tabulates the curve for a Coulomb coefficient μ in [0, 2] up to a shortening of 0.8 L.
  /// `axial_compliance`: ε = EI/(EA L²) >= 0 [-], h²/(12 L²) for a rectangular section.
  explicit ElasticaCurve(double friction, Theory theory = Theory::elastica, double axial_compliance = 0.0);

  [[nodiscard]] double friction() const { return friction_; }
  [[nodiscard]] Theory theory() const { return theory_; }
  /// ε [-].
  [[nodiscard]] double axial_compliance() const { return axial_compliance_; }
  /// β = atan μ [rad], μ for the beam-column: the scale on which the curve bends near the unloaded blade.
  [[nodiscard]] double load_angle() const { return load_angle_; }
  /// End of the table; beyond it the last piece is continued.
  [[nodiscard]] double end() const { return end_; }

  /// The curve at u. Negative u continues it by symmetry: all functions even for μ > 0, the deflection odd
  /// for μ = 0.
  [[nodiscard]] CurvePoint at(double bending) const {
    const double magnitude = std::abs(bending);
    const Piece& piece = pieces_[index(magnitude)];
    const auto& coefficients = piece.coefficients;
    const double t = (magnitude - piece.centre) * piece.inverse_half_width;
    // Even and odd powers apart: two chains of half the length, which the processor works on side by side.
    const double square = t * t;
    Eigen::Array4d even = coefficients[kDegree - 1];
    Eigen::Array4d odd = coefficients[kDegree];
    // Slopes by t², whose first terms are the highest coefficients themselves.
    Eigen::Array4d even_slope = even;
    Eigen::Array4d odd_slope = odd;
    const auto next = [&](std::size_t k) {
      even = even * square + coefficients[k - 2];
      odd = odd * square + coefficients[k - 1];
    };
    next(kDegree - 1);
#pragma GCC unroll 4
    for (std::size_t k = kDegree - 3; k >= 2; k -= 2) {
      even_slope = even_slope * square + even;
      odd_slope = odd_slope * square + odd;
      next(k);
    }
    const Eigen::Array4d value = even + odd * t;
    const Eigen::Array4d slope = (odd + (even_slope + odd_slope * t) * (2.0 * t)) * piece.inverse_half_width;
    if (bending < 0.0) [[unlikely]] {
      return {value[0], value[1], mirror_ * value[2], -slope[0], -slope[1], -mirror_ * slope[2]};
    }
    return {value[0], value[1], value[2], slope[0], slope[1], slope[2]};
  }

  /// Boundaries of the pieces from 0 to `end()`, with the curve there: for bracketing roots and folds along
  /// the curve. Slopes are by the load, finite at the unloaded blade too; for μ = 0, where the load hardly
  /// rises, by u.
  struct Knot : CurvePoint {
    double bending;
  };
  [[nodiscard]] const std::vector<Knot>& knots() const {
    return knots_;
  }

  /// The curve over p = asinh(u/β), sqrt(u) where μ = 0.
  [[nodiscard]] const BendingTable& over_asinh() const {
    return *over_asinh_;
  }

 private:
  static constexpr int kDegree = 11;
  struct Piece {
    double centre;
    double inverse_half_width;
    std::array<Eigen::Array4d, kDegree + 1> coefficients;  ///< load, shortening, deflection, 0; powers of t
  };

  static constexpr int kCoarseShift = 50;  ///< leaves exponent and two leading bits: quarter octaves
  static constexpr int kFineShift = 48;    ///< two bits more: sixteenths of an octave, from u = 1 on

  [[nodiscard]] std::size_t index(double magnitude) const {
    const auto bits = std::bit_cast<std::uint64_t>(magnitude);
    const std::int64_t piece = magnitude < 1.0
                                   ? static_cast<std::int64_t>(bits >> kCoarseShift) - coarse_origin_
                                   : static_cast<std::int64_t>(bits >> kFineShift) - fine_origin_;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(piece, 0, last_piece_));
  }
  void add_first_piece(double width);
  void add_piece(double from, double to);

  /// Without axial compliance.
  [[nodiscard]] Equilibrium<long double> exact(long double bending) const;
  void add_knot(double bending);
  void add_slopes();

  double friction_;
  Theory theory_;
  double axial_compliance_;
  double load_angle_;
  double mirror_;
  double end_ = 0.0;
  std::int64_t coarse_origin_ = 0;  ///< shifted bits of the number whose piece would be piece 0
  std::int64_t fine_origin_ = 0;
  std::int64_t last_piece_ = 0;
  std::vector<Piece> pieces_;
  std::vector<Knot> knots_;
  std::shared_ptr<const BendingTable> over_asinh_;
};

}  // namespace rubatlas::blade
