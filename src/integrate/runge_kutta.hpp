/// One step of an explicit Runge–Kutta pair, with its error estimate and dense output on demand.
///
/// Knows no rotor: a system is anything that writes the derivative of a state and says whether it could
/// (`bool system(const Vector& state, Vector& derivative)`; false rejects the step). The independent variable
/// does not appear: systems that need the time carry it as a component.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "integrate/tableau.hpp"

namespace rubatlas::integrate {

/// `kSize` components, or as many as the state has at run time, up to `kMostSize` (Eigen::Dynamic).
template <int kSize, int kMostSize = kSize>
class RungeKuttaStep {
 public:
  using Vector = Eigen::Array<double, kSize, 1, 0, kMostSize, 1>;

  /// What the tableau points at outlives the step.
  explicit RungeKuttaStep(const Tableau& table) : table_(table) {}

  /// Starts from a state; evaluates the first stage.
  template <class System>
  bool begin(System& system, const Vector& state) {
    start_ = state;
    return system(start_, stages_[0]);
  }

  /// The same with a first stage that is known.
  void resume(const Vector& state, const Vector& derivative) {
    start_ = state;
    stages_[0] = derivative;
  }

  /// Tries a step of the given size. On true, `end()` and the error estimate are set.
  template <class System>
  bool attempt(System& system, double size) {
    size_ = size;
    dense_ready_ = false;
    for (std::size_t row = 1; row < table_.stages; ++row) {
      if (!evaluate_stage(system, row)) return false;
    }
    end_ = start_ + size * weighted_sum(table_.weight);
    if (!system(end_, stages_[table_.stages])) return false;
    return end_.isFinite().all();
  }

  /// Goes on from the end of the last step, which becomes the start of the next one.
  void accept() {
    start_ = end_;
    stages_[0] = stages_[table_.stages];
  }

  [[nodiscard]] const Vector& start() const { return start_; }
  [[nodiscard]] const Vector& end() const { return end_; }
  /// The end may be moved onto a constraint by as little as the local error.
  [[nodiscard]] Vector& end() { return end_; }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] const Vector& start_derivative() const { return stages_[0]; }
  [[nodiscard]] const Vector& end_derivative() const { return stages_[table_.stages]; }

  /// Estimate of the local error, from the differences to the embedded solutions in the given norm (a
  /// functional from vectors to numbers).
  template <class Norm>
  [[nodiscard]] double error_estimate(Norm norm) const {
    std::array<double, Tableau::kMostErrors> norms{};
    for (std::size_t i = 0; i < table_.errors.size(); ++i)
      norms[i] = norm(Vector(size_ * weighted_sum(table_.errors[i])));
    return table_.estimate(norms);
  }
  [[nodiscard]] const Tableau& table() const { return table_; }

  /// Evaluates the further stages of dense output for the step last tried, once.
  template <class System>
  bool make_dense(System& system) {
    if (dense_ready_) return true;
    for (std::size_t row = table_.stages + 1; row < table_.stage.size(); ++row) {
      if (!evaluate_stage(system, row)) return false;
    }
    const Vector difference = end_ - start_;
    dense_[0] = difference;
    dense_[1] = size_ * stages_[0] - difference;
    dense_[2] = 2.0 * difference - size_ * (stages_[0] + stages_[table_.stages]);
    for (std::size_t i = 0; i < table_.upper.size(); ++i)
      dense_[3 + i] = size_ * weighted_sum(table_.upper[i]);
    dense_ready_ = true;
    return true;
  }

  [[nodiscard]] bool is_dense() const { return dense_ready_; }

  /// State at the fraction θ in [0, 1] of the step; needs `make_dense`. Coefficients are nested with factors
  /// θ and 1 − θ in turn, the first three being those of the cubic that the ends and their slopes give.
  [[nodiscard]] Vector interpolate(double fraction) const {
    Vector value = dense_[last_coefficient()];
    for (std::size_t i = last_coefficient(); i-- > 0;) value = dense_[i] + factor(i, fraction) * value;
    return start_ + fraction * value;
  }

  /// Derivative of one component by θ.
  [[nodiscard]] double slope(double fraction, int component) const {
    double value = dense_[last_coefficient()][component];
    double slope = 0.0;
    for (std::size_t i = last_coefficient(); i-- > 0;) {
      slope = i % 2 != 0 ? value + fraction * slope : factor(i, fraction) * slope - value;
      value = dense_[i][component] + factor(i, fraction) * value;
    }
    return value + fraction * slope;
  }

  /// Moves one component of the step by a constant (a time whose origin moves).
  void shift(int component, double amount) {
    start_[component] += amount;
    end_[component] += amount;
  }

 private:
  [[nodiscard]] static Vector zero() { return Vector::Zero(kSize == Eigen::Dynamic ? 0 : kSize); }

  [[nodiscard]] std::size_t last_coefficient() const { return 2 + table_.upper.size(); }

  /// Between the coefficients i and i + 1 of dense output.
  [[nodiscard]] static double factor(std::size_t i, double fraction) {
    return i % 2 != 0 ? fraction : 1.0 - fraction;
  }

  /// Stages of weight zero are left out: they need not be there. One at least counts.
  [[nodiscard]] Vector weighted_sum(std::span<const double> weights) const {
    std::size_t j = 0;
    while (weights[j] == 0.0) ++j;
    Vector sum = weights[j] * stages_[j];
    for (++j; j < weights.size(); ++j) {
      if (weights[j] != 0.0) sum += weights[j] * stages_[j];
    }
    return sum;
  }
  template <class System>
  bool evaluate_stage(System& system, std::size_t row) {
    const Vector state = start_ + size_ * weighted_sum(table_.stage[row]);
    return system(state, stages_[row]);
  }

  Tableau table_;
  Vector start_ = zero();
  Vector end_ = zero();
  double size_ = 0.0;
  bool dense_ready_ = false;
  std::array<Vector, Tableau::kMostStages> stages_;
  std::array<Vector, 3 + Tableau::kMostUpper> dense_;
};

/// Of one table.
template <class Table, int kSize>
class RungeKutta : public RungeKuttaStep<kSize> {
 public:
  RungeKutta() : RungeKuttaStep<kSize>(tableau<Table>()) {}
};

}  // namespace rubatlas::integrate
