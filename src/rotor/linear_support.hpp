/// The shaft on a general linear support: exact motion in flight for any 2×2 stiffness and damping.
///
///     z'' + C z' + K z = f(τ),    f(τ) = Σ F_j e^{iν_j τ}    (z = x + iy as the vector (x, y))
///
/// K and C are any real matrices: anisotropic, cross-coupled (not symmetric), singular, unstable. Each
/// forcing frequency turns as a pair of states of its own, so that flight is e^{Mτ} of one constant matrix
/// and resonance is no special case. The exponential is neither diagonalised (defective at critical damping
/// and at isotropy's neighbours) nor worked out per call (Padé: microseconds); instead
///
///     elapsed = (d0 + 32 d1 + 32² d2 + ...) h + r,   h a power of two, 0 <= d < 32, |r| <= h/2, ‖A‖ h <=
///     1/8:
///
/// one product with a stored propagator for each d that is not zero, and nine terms of the Taylor series over
/// r. There are three levels of d, and more where the support is stiff and h short. The splitting is exact in
/// binary, so no phase is lost however long the flight; propagators are built in extended precision and
/// rounded once. Assumes elapsed >= 0. Source: MODEL 1, 4.5; Moler & Van Loan, SIAM
/// Rev. 45, 3-49 (2003), methods 1 and 3.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace rubatlas::rotor {

/// F e^{iντ}, one term of the forcing.
struct HarmonicForcing {
  std::complex<double> amplitude;  ///< F [m per unit τ²]
  double frequency;                ///< ν [-]: 0 static, Ω unbalance; negative turns backward
};

class LinearSupport {
 public:
  using Complex = std::complex<double>;
  using State = Eigen::Vector4d;  ///< x, y, x', y' [m, m per unit τ]

  /// Different frequencies of the forcing: an unbalance has up to 35 under the deepest ripple of the speed.
  static constexpr std::size_t kMostTerms = 40;

  /// `stiffness` K and `damping` C are those of the equation above [-]. Terms of equal frequency are added.
  /// Throws std::invalid_argument for more than kMostTerms frequencies and for values that are not finite.
  LinearSupport(const Eigen::Matrix2d& stiffness, const Eigen::Matrix2d& damping,
                std::span<const HarmonicForcing> forcing);

  /// Motion at `start_time` + `elapsed` (finite) from `start` at `start_time` (τ); exact to a few roundings
  /// of the largest motion on the way. Back, where `elapsed` is negative, it goes in small steps, and
  /// farther than 2^20 of them the motion is not a number.
  [[nodiscard]] State state(double start_time, const State& start, double elapsed) const {
    return moved(start_time, start, elapsed, terms_.size());
  }

  /// The same without forcing.
  [[nodiscard]] State free(const State& start, double elapsed) const { return moved(0.0, start, elapsed, 0); }

  /// The response from rest to each forcing, on the real and imaginary part of its F e^{iντ} at the start.
  [[nodiscard]] std::vector<Eigen::Matrix<double, 4, 2>> from_rest(double elapsed) const;

  /// z'' [m per unit τ²] of the support alone, and with the forcing.
  [[nodiscard]] Complex acceleration(const State& state) const;
  [[nodiscard]] Complex acceleration(double time, const State& state) const;
  /// f(τ) [m per unit τ²].
  [[nodiscard]] Complex forcing(double time) const;

  [[nodiscard]] const Eigen::Matrix2d& stiffness() const { return stiffness_; }    ///< K
  [[nodiscard]] const Eigen::Matrix2d& damping() const { return damping_; }        ///< C
  [[nodiscard]] std::span<const HarmonicForcing> terms() const { return terms_; }  ///< frequencies all differ
  [[nodiscard]] const Eigen::Matrix4d& system_matrix() const { return system_; }   ///< A of s' = A s + (0, f)

  /// Propagators over `time` keep the slow part of the motion beside the fastest: a long double has 64 bits,
  /// and each of the doublings from h to `time` takes one.
  [[nodiscard]] bool resolves(double time) const;

 private:
  static constexpr std::size_t kBitsOfDigit = 5;
  static constexpr std::size_t kDigits = std::size_t{1}
                                         << kBitsOfDigit;  ///< base of the splitting of `elapsed`
  static constexpr std::size_t kFewestLevels = 3;
  static constexpr double kLongestPiece = 256.0;  ///< τ: a propagator of the last level leads at least so far
  static constexpr int kOrder = 9;                ///< (1/16)^10/9! is below 1e-17

  /// Response of s to a forcing u e^{iντ} from rest over a stored time, and the factor of u over it.
  struct Response {
    Eigen::Matrix<double, 4, 2> gain;  ///< on (Re u, Im u)
    double cosine;
    double sine;
  };
  /// u_j = F_j e^{iν_j τ} of the `count` terms from number `first` on; more are never set or read.
  struct Phasors {
    std::size_t first;
    std::size_t count;
    std::array<double, kMostTerms> real;
    std::array<double, kMostTerms> imaginary;
  };

  void build_propagators();
  [[nodiscard]] Phasors phasors_at(double time, std::size_t count) const;
  [[nodiscard]] State moved(double time, State state, double elapsed, std::size_t terms) const;
  /// Goes on by a time of more than −h/2.
  void pass(double elapsed, State& state, Phasors& phasors) const;
  void advance(std::size_t entry, State& state, Phasors& phasors) const;
  void advance_within_step(double time, State& state, Phasors& phasors) const;

  Eigen::Matrix2d stiffness_;
  Eigen::Matrix2d damping_;
  std::vector<HarmonicForcing> terms_;
  Eigen::Matrix4d system_;
  std::size_t levels_ = kFewestLevels;
  double step_;                               ///< h
  double steps_per_time_;                     ///< 1/h, exact
  std::vector<Eigen::Matrix4d> propagators_;  ///< e^{A d h 32^level} at level·32 + d
  std::vector<Response> responses_;           ///< the same, one for each term
};

}  // namespace rubatlas::rotor
