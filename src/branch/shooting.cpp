#include "branch/shooting.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "point/solver_of_motions.hpp"
#include "settings/quantity.hpp"

namespace rubatlas::branch {

Shooting::Shooting(settings::Scene scene, std::vector<double> parameters, std::vector<Varied> varied)
    : scene_(std::move(scene)),
      parameters_(std::move(parameters)),
      varied_(std::move(varied)),
      length_(point::constants_of(scene_, 1.0).length_scale),
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

point::SectionMap Shooting::follow(const Unknowns& at, int revolutions) {
  point::LineSolver& solver = solver_at(at);
  return solver.section_map(speed_ratio_, section(at), revolutions);
}

std::optional<Orbit> Shooting::orbit(const Unknowns& at) {
  Orbit result;
  result.map = follow(at, period_);
  if (result.map.status != point::PointStatus::done || !result.map.differentiable) return std::nullopt;
  if (!result.map.jacobian.allFinite()) return std::nullopt;
  result.section = section(at);
  for (std::size_t i = 0; i < varied_.size(); ++i) result.quantities.push_back(quantity(at, i));
  result.period = period_;
  const Eigen::EigenSolver<Eigen::Matrix4d> eigenvalues(result.map.jacobian, false);
  result.multipliers = eigenvalues.eigenvalues();
  std::sort(result.multipliers.begin(), result.multipliers.end(), [](const auto& a, const auto& b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
  });
  return result;
}

Eigen::Vector4d Shooting::mismatch(const Unknowns& at, const Orbit& orbit) const {
  const motion::SectionState& end = orbit.map.sections.back();
  return Eigen::Vector4d(end[0], end[1], end[2], end[3]) / length_ - at.head<4>();
}

std::optional<Eigen::Matrix<double, 4, Eigen::Dynamic>> Shooting::derivative(const Unknowns& at,
                                                                             const Orbit& orbit) {
  constexpr double kStep =
      1e-5;  // differences of order 4 leave 1e-20 of the scale, and 1e-16/1e-5 of rounding
  Eigen::Matrix<double, 4, Eigen::Dynamic> result(4, size());
  result.leftCols<4>() = orbit.map.jacobian - Eigen::Matrix4d::Identity();
  for (Eigen::Index column = 4; column < size(); ++column) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (const auto& [steps, weight] : {std::pair{-2.0, 1.0}, {-1.0, -8.0}, {1.0, 8.0}, {2.0, -1.0}}) {
      Unknowns moved = at;
      moved[column] += steps * kStep;
      const point::SectionMap map = follow(moved, period_);
      if (map.status != point::PointStatus::done) return std::nullopt;
      const motion::SectionState& end = map.sections.back();
      sum += weight * Eigen::Vector4d(end[0], end[1], end[2], end[3]);
    }
    result.col(column) = sum / (12.0 * kStep * length_);
  }
  return result;
}

}  // namespace rubatlas::branch
