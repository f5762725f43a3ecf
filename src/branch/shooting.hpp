/// Periodic orbits by shooting: the zeros of P^k(z) − z, P the map from one passing of a blade to the next,
/// over one or more of a scene's quantities.
///
/// Everything that shooting works with is scaled: states by the clearance, quantities by their own size. The
/// derivative by the state is the linearised flow's (`variation/tangent_flow.hpp`), that by a quantity comes
/// from differences of order 4. The motion is the program's own, with every touch-down proven.
///
/// An orbit is cut open at phase 0, or at a touch-down whose time is then an unknown (`touchdown_chart.hpp`).
/// On the receding side of the ring the section map has a square root at a grazing
/// (`tests/observables/grazing.md`); between touch-downs with unknown times the motion is smooth there, since
/// the flight that leads to the touch-down is followed to that time whether or not a tip touches before.
/// Sources: Seydel, Practical Bifurcation and Stability Analysis, chapters 4 and 7; Dankowicz and Schilder,
/// Recipes for Continuation, chapter 9 (multi-segment orbits).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "assembly/make_line_solver.hpp"
#include "branch/branch.hpp"
#include "branch/touchdown_chart.hpp"
#include "plan/grid.hpp"
#include "point/line_solver.hpp"
#include "settings/scene.hpp"

namespace rubatlas::branch {

/// Largest number of quantities that vary together.
inline constexpr Eigen::Index kMostQuantities = 2;
/// A state, or the coordinates of a touch-down, and the quantities that vary, scaled.
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4 + kMostQuantities, 1>;

/// A quantity that varies.
struct Varied {
  std::size_t axis;  ///< place in `settings::axes_of`
  double scale;      ///< what a change of 1 means, in its unit
  double lowest;     ///< where it may go
  double highest;
};

/// An orbit may be cut open at a touch-down of this blade, in this revolution of its period. Where blades
/// that are alike touch one after the other, the motion repeats itself after fewer passings of blades than
/// the period has, each blade in the place of another. All of them graze at once then, and are one touch-down
/// with one unknown time.
struct TouchdownCut {
  int blade;       ///< from 0
  int revolution;  ///< from 0
  int passings;    ///< of blades, to the next cut
};

class Shooting {
 public:
  /// `parameters`: the values of all axes of the scene, one after the other as `plan::values_of`.
  Shooting(settings::Scene scene, std::vector<double> parameters, std::vector<Varied> varied);

  [[nodiscard]] Eigen::Index size() const { return 4 + static_cast<Eigen::Index>(varied_.size()); }
  [[nodiscard]] const std::vector<Varied>& varied() const { return varied_; }
  [[nodiscard]] const settings::Scene& scene() const { return scene_; }
  /// Passings of blades after which the motion repeats itself, each blade in the place of another.
  void set_passings(int passings) { passings_ = passings; }
  [[nodiscard]] int passings() const { return passings_; }
  void set_period(int revolutions) { passings_ = revolutions * scene_.blades.count; }
  /// In revolutions, until the motion repeats itself with each blade in its own place.
  [[nodiscard]] int period() const;
  /// Half of the passings, where a motion can repeat itself after them.
  [[nodiscard]] std::optional<int> half_of_passings() const;
  /// Where orbits are cut open from now on: at phase 0, or at a touch-down.
  void cut_at_section() { cut_.reset(); }
  void cut_at(const TouchdownCut& cut) { cut_ = cut; }
  [[nodiscard]] const std::optional<TouchdownCut>& cut() const { return cut_; }
  /// Numbers of passings of blades after which a motion with this period can repeat itself, ascending: that
  /// of the whole period alone, unless the blades are alike and nothing else turns with the rotor.
  [[nodiscard]] std::vector<int> passings_of_periods() const;

  /// Unknowns of an orbit that is cut at phase 0.
  [[nodiscard]] Unknowns scaled(const motion::SectionState& section,
                                const std::vector<double>& quantities) const;
  [[nodiscard]] motion::SectionState section(const Unknowns& at) const;
  /// Unknowns of an orbit that is cut where the tip of `place` is.
  [[nodiscard]] Unknowns scaled(const point::TipAtRing& place, const std::vector<double>& quantities);
  /// Length of a scaled state of 1 [m].
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double quantity(const Unknowns& at, std::size_t number) const;
  /// All quantities lie where they may go.
  [[nodiscard]] bool in_range(const Unknowns& at) const;

  /// The motion from there to the next cut; nothing where it leaves the model's validity or has no
  /// linearisation, or where a tip that should touch down comes from beyond the ring.
  [[nodiscard]] std::optional<Orbit> orbit(const Unknowns& at);
  /// An orbit closes to 1e-12 of the clearance, but for the rounding of its start: which grows along an
  /// unstable orbit, and, where a tip touches down slowly, is a time in contact.
  [[nodiscard]] bool closes(const Unknowns& at, const Orbit& orbit) const;
  /// The derivative of `Orbit::mismatch` by the unknowns; nothing where a motion nearby has none.
  [[nodiscard]] std::optional<Eigen::Matrix<double, 4, Eigen::Dynamic>> derivative(const Unknowns& at,
                                                                                   const Orbit& orbit);

  /// The motion from a section over so many passings of blades, at the given quantities: starts so late in a
  /// revolution, with another blade in the place of the first, that it ends with a revolution.
  [[nodiscard]] point::SectionMap follow(const Unknowns& at, int passings);

 private:
  /// A motion from a cut to the next.
  struct Passage {
    point::TouchdownMap map;  ///< of a motion from phase 0 the end and the section map alone
    Eigen::Vector4d start;    ///< scaled
    Eigen::Matrix4d start_by_unknowns = Eigen::Matrix4d::Identity();
    int revolution;  ///< of the period, in which it starts
    int passings;    ///< of blades, to its end
    [[nodiscard]] Eigen::Vector4d mismatch(double length) const {
      return Eigen::Map<const Eigen::Vector4d>(map.end.data()) / length - start;
    }
  };
  [[nodiscard]] std::optional<Passage> passage(const Unknowns& at);
  /// A slope from differences, which is smooth where all motions have the same events.
  struct Slope {
    Eigen::Vector4d value;
    bool is_smooth;
  };
  [[nodiscard]] std::optional<Slope> slope_of_mismatch(const Unknowns& at, Eigen::Index column, double step,
                                                       const std::vector<std::int32_t>& events);
  /// The blades are alike, and nothing else turns with the rotor.
  [[nodiscard]] bool blades_follow_alike() const;
  [[nodiscard]] TouchdownChart chart(const Unknowns& at, int blade);
  point::LineSolver& solver_at(const Unknowns& at);

  settings::Scene scene_;
  std::vector<double> parameters_;
  std::vector<Varied> varied_;
  double length_;  ///< of a scaled state of 1 [m]
  int passings_ = 1;
  std::optional<TouchdownCut> cut_;
  std::shared_ptr<assembly::BladeTables> tables_;
  std::unique_ptr<point::LineSolver> solver_;
  std::vector<double> solver_parameters_;  ///< of the line that `solver_` is for; its speed ratio is not read
  double speed_ratio_ = 0.0;
};

}  // namespace rubatlas::branch
