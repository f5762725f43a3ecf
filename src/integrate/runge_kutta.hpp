/// One step of an explicit Runge–Kutta pair, with its error estimate and dense output on demand.
///
/// Knows no rotor: a system is anything that writes the derivative of a state and says whether it could
/// (`bool system(const Vector& state, Vector& derivative)`; false rejects the step). The independent variable
/// does not appear: systems that need the time carry it as a component.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rubatlas::integrate {

/// `kSize` components, or as many as the state has at run time, up to `kMostSize` (Eigen::Dynamic).
template <class Table, int kSize, int kMostSize = kSize>
class RungeKutta {
 public:
  using Vector = Eigen::Array<double, kSize, 1, 0, kMostSize, 1>;
  using Coefficients = Table;

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
    if (!evaluate_stages(system, std::make_index_sequence<Table::kStages - 1>{})) return false;
    end_ = start_ + size * weighted_sum([] { return Table::kWeight; });
    if (!system(end_, stages_[Table::kStages])) return false;
    return end_.isFinite().all();
  }

  /// Goes on from the end of the last step, which becomes the start of the next one.
  void accept() {
    start_ = end_;
    stages_[0] = stages_[Table::kStages];
  }

  [[nodiscard]] const Vector& start() const { return start_; }
  [[nodiscard]] const Vector& end() const { return end_; }
  /// The end may be moved onto a constraint by as little as the local error.
  [[nodiscard]] Vector& end() { return end_; }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] const Vector& start_derivative() const { return stages_[0]; }
  [[nodiscard]] const Vector& end_derivative() const { return stages_[Table::kStages]; }

  /// Estimate of the local error, from the differences to the embedded solutions in the given norm (a
  /// functional from vectors to numbers).
  template <class Norm>
  [[nodiscard]] double error_estimate(Norm norm) const {
    return Table::estimate([&](auto weights) { return norm(size_ * weighted_sum(weights)); });
  }

  /// Evaluates the further stages of dense output for the step last tried, once.
  template <class System>
  bool make_dense(System& system) {
    if (dense_ready_) return true;
    if (!evaluate_dense_stages(system,
                               std::make_index_sequence<Table::kDenseStages - Table::kStages - 1>{})) {
      return false;
    }
    const Vector difference = end_ - start_;
    dense_[0] = difference;
    dense_[1] = size_ * stages_[0] - difference;
    dense_[2] = 2.0 * difference - size_ * (stages_[0] + stages_[Table::kStages]);
    set_upper_coefficients(std::make_index_sequence<Table::kDense.size()>{});
    dense_ready_ = true;
    return true;
  }

  [[nodiscard]] bool is_dense() const { return dense_ready_; }

  /// State at the fraction θ in [0, 1] of the step; needs `make_dense`. Coefficients are nested with factors
  /// θ and 1 − θ in turn, the first three being those of the cubic that the ends and their slopes give.
  [[nodiscard]] Vector interpolate(double fraction) const {
    Vector value = dense_[kCoefficients - 1];
    for (std::size_t i = kCoefficients - 1; i-- > 0;) value = dense_[i] + factor(i, fraction) * value;
    return start_ + fraction * value;
  }

  /// One component of it.
  [[nodiscard]] double interpolate(double fraction, int component) const {
    return start_[component] + fraction * mean_slope(fraction, component);
  }

  /// One component and its derivative by θ.
  struct ValueAndSlope {
    double value;
    double slope;
  };
  [[nodiscard]] ValueAndSlope interpolate_with_slope(double fraction, int component) const {
    double value = dense_[kCoefficients - 1][component];
    double slope = 0.0;
    for (std::size_t i = kCoefficients - 1; i-- > 0;) {
      slope = i % 2 != 0 ? value + fraction * slope : factor(i, fraction) * slope - value;
      value = dense_[i][component] + factor(i, fraction) * value;
    }
    return {start_[component] + fraction * value, value + fraction * slope};
  }

  /// (component at θ − component at 0) / θ, finite at θ = 0.
  [[nodiscard]] double mean_slope(double fraction, int component) const {
    double value = dense_[kCoefficients - 1][component];
    for (std::size_t i = kCoefficients - 1; i-- > 0;) {
      value = dense_[i][component] + factor(i, fraction) * value;
    }
    return value;
  }

  /// Moves one component of the step by a constant (a time whose origin moves).
  void shift(int component, double amount) {
    start_[component] += amount;
    end_[component] += amount;
  }

 private:
  [[nodiscard]] static Vector zero() { return Vector::Zero(kSize == Eigen::Dynamic ? 0 : kSize); }

  static constexpr std::size_t kCoefficients = 3 + Table::kDense.size();

  /// Between the coefficients i and i + 1 of dense output.
  [[nodiscard]] static double factor(std::size_t i, double fraction) {
    return i % 2 != 0 ? fraction : 1.0 - fraction;
  }

  template <std::size_t... kI>
  void set_upper_coefficients(std::index_sequence<kI...>) {
    ((dense_[3 + kI] = size_ * weighted_sum([] { return Table::kDense[kI]; })), ...);
  }

  // Weights come as a captureless function, so that each is a constant and zero ones leave no instruction
  // behind.
  template <class Weights>
  [[nodiscard]] Vector weighted_sum(Weights) const {
    return [&]<std::size_t... kJ>(std::index_sequence<kJ...>)->Vector {
      return (... + (Weights{}()[kNonZero<Weights>[kJ]] * stages_[kNonZero<Weights>[kJ]]));
    }
    (std::make_index_sequence<kNonZero<Weights>.size()>{});
  }

  /// The stages that count in a sum, so that the others leave no instruction behind.
  template <class Weights>
  static constexpr auto kNonZero = [] {
    constexpr auto kWeights = Weights{}();
    constexpr auto kCount = static_cast<std::size_t>(
        std::count_if(kWeights.begin(), kWeights.end(), [](double weight) { return weight != 0.0; }));
    std::array<std::size_t, kCount> stages{};
    std::size_t next = 0;
    for (std::size_t j = 0; j < kWeights.size(); ++j) {
      if (kWeights[j] != 0.0) stages[next++] = j;
    }
    return stages;
  }();

  template <class System, std::size_t... kI>
  bool evaluate_stages(System& system, std::index_sequence<kI...>) {
    return (evaluate_stage<kI + 1>(system) && ...);
  }
  template <class System, std::size_t... kI>
  bool evaluate_dense_stages(System& system, std::index_sequence<kI...>) {
    return (evaluate_stage<Table::kStages + 1 + kI>(system) && ...);
  }
  template <std::size_t kRow, class System>
  bool evaluate_stage(System& system) {
    const Vector state = start_ + size_ * weighted_sum([] { return Table::kStage[kRow]; });
    return system(state, stages_[kRow]);
  }

  Vector start_ = zero();
  Vector end_ = zero();
  double size_ = 0.0;
  bool dense_ready_ = false;
  std::array<Vector, Table::kDenseStages> stages_;
  std::array<Vector, kCoefficients> dense_;
};

}  // namespace rubatlas::integrate
