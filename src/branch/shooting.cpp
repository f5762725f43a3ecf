#include "branch/shooting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "integrate/decompositions.hpp"
#include "plan/scene_of_line.hpp"
#include "settings/quantity.hpp"
#include "variation/parts_of_scene.hpp"

namespace rubatlas::branch {

Shooting::Shooting(settings::Scene scene, std::vector<double> parameters, std::vector<Varied> varied)
    : scene_(std::move(scene)),
      parameters_(std::move(parameters)),
      varied_(std::move(varied)),
      length_(variation::constants_of(scene_, 1.0).length_scale),
      tables_(assembly::make_blade_tables()) {}

Unknowns Shooting::scaled(const motion::SectionState& section, const std::vector<double>& quantities) const {
  Unknowns result(size());
  for (Eigen::Index i = 0; i < 4; ++i) result[i] = section[static_cast<std::size_t>(i)] / length_;
  for (std::size_t i = 0; i < varied_.size(); ++i)
    result[4 + static_cast<Eigen::Index>(i)] = quantities[i] / varied_[i].scale;
  return result;
}

motion::SectionState Shooting::section(const Unknowns& at) const {
  return {at[0] * length_, at[1] * length_, at[2] * length_, at[3] * length_};
}
double Shooting::quantity(const Unknowns& at, std::size_t number) const {
  return at[4 + static_cast<Eigen::Index>(number)] * varied_[number].scale;
}
bool Shooting::in_range(const Unknowns& at) const {
  for (std::size_t i = 0; i < varied_.size(); ++i) {
    const double value = quantity(at, i);
    if (!(value >= varied_[i].lowest && value <= varied_[i].highest)) return false;
  }
  return true;
}

Unknowns Shooting::scaled(const point::TipAtRing& place, const std::vector<double>& quantities) {
  Unknowns result = scaled(motion::SectionState{}, quantities);
  const TouchdownCoordinates at = chart(result, place.blade).coordinates(place.time, place.state);
  result.head<4>() << at[0], at.tail<3>() / length_;
  return result;
}

int Shooting::period() const {
  return std::lcm(passings_, scene_.blades.count) / scene_.blades.count;
}

bool Shooting::blades_follow_alike() const {
  const auto varies = [&](const Varied& varied) {
    return settings::axes_of(scene_)[varied.axis].name == "unbalance";
  };
  return !scene_.unbalance && std::ranges::none_of(varied_, varies);
}

std::optional<int> Shooting::half_of_passings() const {
  const int least = blades_follow_alike() ? 1 : scene_.blades.count;
  if (passings_ % (2 * least) != 0) return std::nullopt;
  return passings_ / 2;
}

std::vector<int> Shooting::passings_of_periods() const {
  const int blades = scene_.blades.count;
  const int whole = period() * blades;
  if (!blades_follow_alike()) return {whole};
  std::vector<int> result;
  for (int passings = 1; passings <= whole; ++passings) {
    if (std::lcm(passings, blades) == whole) result.push_back(passings);
  }
  return result;
}

point::LineSolver& Shooting::solver_at(const Unknowns& at) {
  std::vector<double> parameters = parameters_;
  for (std::size_t i = 0; i < varied_.size(); ++i) parameters[varied_[i].axis] = quantity(at, i);
  // The speed ratio comes last, and varies along a line.
  speed_ratio_ = parameters.back();
  parameters.back() = 0.0;
  if (!solver_ || parameters != solver_parameters_) {
    // A table for each friction coefficient would pile up along a branch over friction.
    const auto friction_varies = [&](const Varied& varied) {
      return settings::axes_of(scene_)[varied.axis].name == "friction";
    };
    if (std::ranges::any_of(varied_, friction_varies)) tables_ = assembly::make_blade_tables();
    solver_ = assembly::make_line_solver(scene_, plan::parameters_at(parameters), tables_);
    solver_parameters_ = std::move(parameters);
  }
  return *solver_;
}

TouchdownChart Shooting::chart(const Unknowns& at, int blade) {
  solver_at(at);  // sets the line
  return {plan::scene_of_line(scene_, plan::parameters_at(solver_parameters_)), speed_ratio_, blade};
}

point::SectionMap Shooting::follow(const Unknowns& at, int passings) {
  point::LineSolver& solver = solver_at(at);
  const int count = scene_.blades.count;
  const int revolutions = (passings + count - 1) / count;
  motion::PointStart start = section(at);
  const double before = revolutions - static_cast<double>(passings) / count;  // revolutions
  start.time = before * 2.0 * std::numbers::pi / std::abs(speed_ratio_);
  return solver.section_map(speed_ratio_, start, revolutions);
}

std::optional<Shooting::Passage> Shooting::passage(const Unknowns& at) {
  Passage result;
  if (!cut_) {
    result.start = at.head<4>();
    result.map.map = follow(at, passings_);
    result.map.admissible = true;
    if (result.map.map.status != ending::PointStatus::done) return std::nullopt;
    result.map.end = result.map.map.sections.back();
    result.revolution = period() - static_cast<int>(result.map.map.sections.size());
    result.passings = passings_;
    return result;
  }
  if (!(at[kApproachSpeed] > 0.0)) return std::nullopt;
  const TouchdownChart chart = this->chart(at, cut_->blade);
  Eigen::Vector4d units;
  units << 1.0, Eigen::Vector3d::Constant(length_);
  const TouchdownCoordinates coordinates = units.cwiseProduct(at.head<4>());
  const Eigen::Vector4d state = chart.state(coordinates);
  result.start = state / length_;
  result.start_by_unknowns = chart.derivative(coordinates) * units.asDiagonal() / length_;

  // Of the touch-downs that follow each other the one before phase 0 of the period: the section is behind it.
  const int count = scene_.blades.count;
  const double turn = std::copysign(2.0 * std::numbers::pi, speed_ratio_);
  const double whole = period() * count;  // passings
  const double passing = count * (coordinates[0] / turn + cut_->revolution);
  const double later = std::floor((whole - passing) / cut_->passings);
  const double last = passing + later * cut_->passings;
  result.revolution = std::min(static_cast<int>(last / count), period() - 1);
  result.passings = cut_->passings;
  motion::PointStart start;
  start.state = {state[0], state[1], state[2], state[3]};
  start.time = (last / count - result.revolution) * turn / speed_ratio_;
  start.blade =
      point::in_place_of(cut_->blade, static_cast<int>(later) * cut_->passings, count, speed_ratio_);
  result.map = solver_at(at).touchdown_map(speed_ratio_, start, cut_->passings);
  if (!result.map.complete) return std::nullopt;
  return result;
}

std::optional<Orbit> Shooting::orbit(const Unknowns& at) {
  const auto passage = this->passage(at);
  if (!passage || !passage->map.map.differentiable || !passage->map.map.jacobian.allFinite())
    return std::nullopt;
  Orbit result;
  result.map = passage->map.map;
  result.mismatch = passage->mismatch(length_);
  result.admissible = passage->map.admissible;
  for (std::size_t i = 0; i < varied_.size(); ++i) result.quantities.push_back(quantity(at, i));
  result.period = period();
  result.passings = passings_;
  result.cuts = result.period * scene_.blades.count / passage->passings;
  for (auto* place : {&result.map.nearest_place, &result.map.lightest_place}) {
    if (*place) (*place)->revolution += passage->revolution;
  }
  if (!cut_) {
    result.section = section(at);
    result.forward = result.map.jacobian;
  } else {
    // Where the touch-down comes later by δτ the contact begins, and the flight ends, later.
    const Eigen::RowVector4d time = Eigen::RowVector4d::Unit(0) / speed_ratio_;
    const auto rate = [&](const std::array<double, 4>& of) -> Eigen::Vector4d {
      return Eigen::Map<const Eigen::Vector4d>(of.data()) / length_;
    };
    result.forward =
        result.map.jacobian * (passage->start_by_unknowns - rate(passage->map.rate_at_start) * time);
    result.backward = passage->start_by_unknowns - rate(passage->map.rate_at_end) * time;
    const auto behind = static_cast<std::size_t>(result.period - 1 - passage->revolution);
    if (behind >= result.map.sections.size()) return std::nullopt;
    result.section = result.map.sections[behind];
  }
  result.multipliers =
      integrate::generalised_eigenvalues(result.forward, result.backward).array().pow(result.cuts);
  std::sort(result.multipliers.begin(), result.multipliers.end(), [](const auto& a, const auto& b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
  });
  return result;
}

bool Shooting::closes(const Unknowns& at, const Orbit& orbit) const {
  constexpr double kClosed = 1e-12;
  constexpr double kSlow = 0.1;     // in clearances per unit τ
  constexpr double kGrowth = 1e-2;  // of the largest growth of a difference
  const double slowness = cut_ ? kSlow / at[kApproachSpeed] : 0.0;
  return orbit.mismatch.norm() <= kClosed * std::max({1.0, slowness, kGrowth * orbit.map.jacobian.norm()});
}

std::optional<Eigen::Matrix<double, 4, Eigen::Dynamic>> Shooting::derivative(const Unknowns& at,
                                                                             const Orbit& orbit) {
  Eigen::Matrix<double, 4, Eigen::Dynamic> result(4, size());
  result.leftCols<4>() = orbit.forward - orbit.backward;
  // Differences of order 4 leave 1e-20 of the scale, and 1e-16/1e-5 of rounding. Right before a grazing
  // shorter ones stay on this side of it.
  constexpr std::array kSteps{1e-5, 1e-7};
  for (Eigen::Index column = 4; column < size(); ++column) {
    std::optional<Slope> slope;
    for (const double step : kSteps) {
      slope = slope_of_mismatch(at, column, step, orbit.map.events);
      if (slope && slope->is_smooth) break;
    }
    if (!slope) return std::nullopt;
    result.col(column) = slope->value;
  }
  return result;
}

std::optional<Shooting::Slope> Shooting::slope_of_mismatch(const Unknowns& at, Eigen::Index column,
                                                           double step,
                                                           const std::vector<std::int32_t>& events) {
  Slope slope{Eigen::Vector4d::Zero(), true};
  for (const auto& [steps, weight] : {std::pair{-2.0, 1.0}, {-1.0, -8.0}, {1.0, 8.0}, {2.0, -1.0}}) {
    Unknowns moved = at;
    moved[column] += steps * step;
    const auto there = passage(moved);
    if (!there) return std::nullopt;
    if (there->map.map.events != events) slope.is_smooth = false;
    slope.value += weight / (12.0 * step) * there->mismatch(length_);
  }
  return slope;
}

}  // namespace rubatlas::branch
