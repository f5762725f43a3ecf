/// Observable `lyapunov`: the Lyapunov exponents of a point, with `lyapunov_error` and `lyapunov_residual`
/// beside it.
///
/// Four tangents, or eight where the ring is a body, follow the motion (`variation/tangent_flow.hpp`) and are
/// made orthogonal again and again; the logarithms of what their lengths lose are the exponents' sums. On a
/// cycle they begin as the Schur vectors of its return map, each of which the period takes into the space of
/// itself and those before it: the exponents are the logarithms of the multipliers. Source: Benettin,
/// Galgani, Giorgilli and Strelcyn, Meccanica 15 (1980); for motions with events Müller, Chaos, Solitons &
/// Fractals 5 (1995).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "integrate/decompositions.hpp"
#include "observables/observable.hpp"
#include "settings/scene.hpp"
#include "variation/tangent_flow.hpp"

namespace rubatlas::observables {

class Lyapunov final : public Observable {
 public:
  explicit Lyapunov(const settings::Scene& scene)
      : aligning_before_(scene.protocol.sampled_revolutions / kPartToAlign), flow_(scene) {}
  static std::unique_ptr<Observable> make(const settings::Scene& scene) {
    return std::make_unique<Lyapunov>(scene);
  }

  void begin(const trajectory::PointConstants& point) override {
    period_ = point.period;
    flow_.begin(point.speed_ratio);
    growth_.setZero(flow_.tangents().rows());
    growths_.clear();
    aligning_ = aligning_before_;
    cycle_.reset();
  }
  void on_cycle(const variation::Tangents& return_map) override {
    if (return_map.size() == 0) return flow_.loses_track();
    cycle_ = integrate::schur_form(return_map);
    flow_.set_tangents(cycle_->vectors);
    aligning_ = 0;
  }
  void piece(trajectory::MotionPiece& piece) override {
    flow_.piece(piece, [this] { make_orthogonal(); });
  }
  void touch_down(int blade) override {
    make_orthogonal();
    flow_.passes_ring(blade);
  }
  void lift_off(int blade) override { flow_.passes_ring(blade); }
  void slip_reverses(int blade) override { flow_.slip_reverses(blade); }
  void changes_otherwise() override { flow_.loses_track(); }
  void revolution_ends(const trajectory::State& /*section*/) override {
    make_orthogonal();
    growths_.push_back(growth_);
    growth_.setZero();
  }

  /// The exponents, per unit τ, descending; NaN where the flow has no linearisation.
  void write(std::span<double> row) override {
    const Growth mean = exponents();
    std::copy(mean.begin(), mean.end(), row.begin());
  }
  void write_beside(int number, std::span<double> row) override {
    number == 0 ? write_errors(row) : write_residual(row);
  }

 private:
  using Growth = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * variation::kMostCoordinates, 1>;
  /// One part in this many of the sampled revolutions turns the tangents into their directions.
  static constexpr int kPartToAlign = 4;
  static constexpr std::size_t kBatches = 10;

  void make_orthogonal() {
    const auto factors = integrate::orthogonal_factors(flow_.tangents());
    // A tangent that has died in a long contact has lost its direction.
    if ((factors.diagonal.array() == 0.0).any()) return flow_.loses_track();
    growth_ += factors.diagonal.array().abs().log();
    flow_.set_tangents(factors.orthogonal);
  }
  [[nodiscard]] std::span<const Growth> counted() const {
    return std::span(growths_).subspan(static_cast<std::size_t>(aligning_));
  }
  [[nodiscard]] static Growth sum(std::span<const Growth> growths) {
    Growth total = Growth::Zero(growths.front().size());
    for (const Growth& growth : growths) total += growth;
    return total;
  }
  [[nodiscard]] Growth exponents() const {
    if (!flow_.known()) return Growth::Constant(growth_.size(), std::numeric_limits<double>::quiet_NaN());
    Growth mean = sum(counted()) / (static_cast<double>(counted().size()) * period_);
    // A pair of complex multipliers turns round the plane of its two directions.
    for (Eigen::Index i = 0; cycle_ && i + 1 < mean.size(); ++i)
      if (cycle_->form(i + 1, i) != 0.0) mean.segment<2>(i).setConstant(mean.segment<2>(i).mean());
    std::sort(mean.begin(), mean.end(), std::greater<>());
    return mean;
  }
  /// Standard error of the mean over batches of revolutions.
  void write_errors(std::span<double> row) const {
    if (cycle_ && flow_.known()) {  // each period is like the other
      std::ranges::fill(row, 0.0);
      return;
    }
    const std::span<const Growth> all = counted();
    const std::size_t batches = std::min(kBatches, all.size());
    if (!flow_.known() || batches < 2) {
      std::ranges::fill(row, std::numeric_limits<double>::quiet_NaN());
      return;
    }
    std::vector<Growth> means;
    for (std::size_t i = 0; i < batches; ++i) {
      const std::size_t first = i * all.size() / batches;
      const std::size_t last = (i + 1) * all.size() / batches;
      means.emplace_back(sum(all.subspan(first, last - first)) /
                         (static_cast<double>(last - first) * period_));
    }
    const auto count = static_cast<double>(batches);
    const Growth mean = sum(means) / count;
    Growth squares = Growth::Zero(mean.size());
    for (const Growth& of_batch : means) squares += (of_batch - mean).square();
    const Growth errors = (squares / (count * (count - 1.0))).sqrt();
    std::copy(errors.begin(), errors.end(), row.begin());
  }
  /// Over all sampled revolutions, those in which the tangents turn included.
  void write_residual(std::span<double> row) const {
    const double duration = static_cast<double>(growths_.size()) * period_;
    row[0] = flow_.known() ? (sum(growths_).sum() - flow_.log_volume()) / duration - flow_.phase_volume_rate()
                           : std::numeric_limits<double>::quiet_NaN();
  }

  int aligning_before_;  ///< revolutions, where the motion is on no cycle
  int aligning_ = 0;     ///< revolutions
  variation::TangentFlow flow_;
  std::optional<integrate::SchurForm> cycle_;  ///< of the return map
  double period_ = 0.0;
  Growth growth_;                ///< ln of the lengths, in this revolution
  std::vector<Growth> growths_;  ///< in each revolution
};

}  // namespace rubatlas::observables
