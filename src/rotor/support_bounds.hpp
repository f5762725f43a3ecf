/// Bounds of flight on a general linear support, for searches that must not miss a touch-down.
///
/// How far the motion can get: s' = A s + (0, f) in a norm ‖s‖_P = (sᵀ P s)^½ obeys
///
///     d/dτ ‖s‖_P <= μ ‖s‖_P + w Σ|F_j|,    μ: logarithmic norm of A in ‖.‖_P,  w = ‖(0, e)‖_P at most,
///
/// and |z|² + |z'|² <= ‖s‖_P² / λ_min(P). Three norms, each bound the least that they give:
/// Euclidean; energy, P = diag(sym K, I) where sym K > 0 (μ = 0 for symmetric K and damping that nowhere
/// feeds); modal, P = V^{−*} V^{−1} with the eigenvectors V (μ = largest real part of an eigenvalue). The
/// same holds for the distance to the steady response, where there is one, without the forcing.
///
/// How fast it can bend: z'', z''' and (d/dτ + iΩ)³ z written with z, z' and f, as spectral norms.
/// Source: Söderlind, The logarithmic norm, BIT 46, 631-652 (2006); Hairer, Nørsett, Wanner, Solving ODEs I,
/// I.10.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "rotor/free_motion.hpp"
#include "rotor/linear_support.hpp"

namespace rubatlas::rotor {

/// A bound of the form slope · b + offset, where b bounds (|z|² + |z'|²)^½.
struct LinearBound {
  double slope;
  double offset;
  [[nodiscard]] double operator()(double bound) const { return slope * bound + offset; }
};

class SupportBounds {
 public:
  using State = LinearSupport::State;

  explicit SupportBounds(const LinearSupport& support);

  /// Bound of (|z|² + |z'|²)^½ [m] over the time `horizon` after `time` in flight from `state`. An infinite
  /// horizon gives infinity unless the motion is proven to stay bounded.
  [[nodiscard]] double amplitude_bound(double time, const State& state, double horizon) const;

  /// Bounds of |z''|, |z'''| and |z''''| while (|z|² + |z'|²)^½ <= `bound`.
  [[nodiscard]] DerivativeBounds derivative_bounds(double bound) const {
    return {second_(bound), third_(bound), fourth_(bound)};
  }

  /// Bound of |f| [m per unit τ²]: the sum of the amplitudes.
  [[nodiscard]] double forcing_bound() const { return forcing_; }

  /// The forced motion that repeats, at `time`; only where no forcing frequency is an eigenvalue.
  [[nodiscard]] State steady(double time) const;

  /// Smallest μ of the three norms [1 per unit τ]: no motion grows faster than e^{μτ} in that norm.
  [[nodiscard]] double logarithmic_norm() const;
  /// Over which a bound of a motion that may grow does so by a factor of e at most [τ]; infinite where none
  /// grows.
  [[nodiscard]] double growth_time() const { return growth_time_; }

 private:
  /// ‖s‖ = |root · s|, rootᵀ root = P.
  struct Norm {
    Eigen::Matrix4d root;
    double growth;          ///< μ
    double to_amplitude;    ///< 1/λ_min(P)^½
    double forcing_weight;  ///< w
  };

  void add_norm(const Eigen::Matrix4d& weight, bool never_grows);
  void add_energy_norm();
  void add_modal_norm();
  void find_steady_response();

  Eigen::Matrix2d stiffness_;
  Eigen::Matrix2d damping_;
  Eigen::Matrix4d system_;
  std::vector<HarmonicForcing> terms_;
  std::array<Norm, 3> norms_;
  std::size_t norm_count_ = 0;
  double forcing_ = 0.0;
  bool has_steady_ = false;
  std::vector<Eigen::Matrix<double, 4, 2>> steady_;  ///< on (cos ντ, sin ντ)
  double steady_bound_ = 0.0;                        ///< of (|z|² + |z'|²)^½ of the steady response
  double growth_time_ = 0.0;
  LinearBound second_{};
  LinearBound third_{};
  LinearBound fourth_{};
};

}  // namespace rubatlas::rotor
