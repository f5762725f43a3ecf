/// Periodic orbits by shooting: the zeros of P^k(z) − z, P the map from section to section, over one or more
/// of a scene's quantities.
///
/// Everything that shooting works with is scaled: states by the clearance, quantities by their own size. The
/// derivative by the state is the linearised flow's (`variation/tangent_flow.hpp`), that by a quantity comes
/// from differences of order 4. The motion is the program's own, with every touch-down proven, so that an
/// orbit that is found is one that the rotor has. Source: Seydel, Practical Bifurcation and Stability
/// Analysis, chapters 4 and 7.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "branch/branch.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::branch {

/// Largest number of quantities that vary together.
inline constexpr Eigen::Index kMostQuantities = 2;
/// A state and the quantities that vary, scaled.
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4 + kMostQuantities, 1>;

/// A quantity that varies.
struct Varied {
  std::size_t axis;  ///< place in `settings::axes_of`
  double scale;      ///< what a change of 1 means, in its unit
  double lowest;     ///< where it may go
  double highest;
};

class Shooting {
 public:
  /// `parameters`: the values of all axes of the scene, one after the other as `plan::values_of`.
  Shooting(settings::Scene scene, std::vector<double> parameters, std::vector<Varied> varied);

  [[nodiscard]] Eigen::Index size() const { return 4 + static_cast<Eigen::Index>(varied_.size()); }
  [[nodiscard]] const std::vector<Varied>& varied() const { return varied_; }
  [[nodiscard]] const settings::Scene& scene() const { return scene_; }
  void set_period(int revolutions) { period_ = revolutions; }
  [[nodiscard]] int period() const { return period_; }

  [[nodiscard]] Unknowns scaled(const motion::SectionState& section,
                                const std::vector<double>& quantities) const;
  [[nodiscard]] motion::SectionState section(const Unknowns& at) const;
  [[nodiscard]] double quantity(const Unknowns& at, std::size_t number) const;
  /// All quantities lie where they may go.
  [[nodiscard]] bool in_range(const Unknowns& at) const;

  /// The motion over the period from there; nothing where it leaves the model's validity or has no
  /// linearisation.
  [[nodiscard]] std::optional<Orbit> orbit(const Unknowns& at);
  /// P^k(z) − z of an orbit, scaled.
  [[nodiscard]] Eigen::Vector4d mismatch(const Unknowns& at, const Orbit& orbit) const;
  /// Its derivative by the unknowns; nothing where a motion nearby has none.
  [[nodiscard]] std::optional<Eigen::Matrix<double, 4, Eigen::Dynamic>> derivative(const Unknowns& at,
                                                                                   const Orbit& orbit);

  /// Sections of the motion from a state, at the given quantities.
  [[nodiscard]] point::SectionMap follow(const Unknowns& at, int revolutions);

 private:
  point::LineSolver& solver_at(const Unknowns& at);

  settings::Scene scene_;
  std::vector<double> parameters_;
  std::vector<Varied> varied_;
  double length_;  ///< of a scaled state of 1 [m]
  int period_ = 1;
  std::shared_ptr<assembly::BladeTables> tables_;
  std::unique_ptr<point::LineSolver> solver_;
  std::vector<double> solver_parameters_;  ///< of the line that `solver_` is for; its speed ratio is not read
  double speed_ratio_ = 0.0;
};

}  // namespace rubatlas::branch
