#include "branch/touchdown_chart.hpp"

#include <cmath>

#include "variation/parts_of_scene.hpp"

namespace rubatlas::branch {
namespace {

Eigen::Vector2d turned_by_quarter(const Eigen::Vector2d& vector) {
  return {-vector[1], vector[0]};
}

}  // namespace

TouchdownChart::TouchdownChart(const settings::Scene& line, double speed_ratio, int blade)
    : geometry_(variation::geometry_of(line.ring, line.blades)),
      misalignment_(line.rotor.misalignment),
      speed_ratio_(speed_ratio),
      blade_(blade),
      blades_(line.blades.count, speed_ratio) {}

TouchdownChart::Frame TouchdownChart::frame(const TouchdownCoordinates& at) const {
  const auto er = blades_.direction(blade_, blades_.first(at[0] / speed_ratio_));
  const double angle = at[1] / geometry_.ring_radius;  // ψ
  Frame frame;
  frame.er = {er.cosine, er.sine};
  frame.et = turned_by_quarter(frame.er);
  frame.n = std::cos(angle) * frame.er + std::sin(angle) * frame.et;
  frame.t = turned_by_quarter(frame.n);
  frame.along_n = at[2] - speed_ratio_ * geometry_.reach * std::sin(angle);
  return frame;
}

Eigen::Vector4d TouchdownChart::state(const TouchdownCoordinates& at) const {
  const Frame frame = this->frame(at);
  Eigen::Vector4d state;
  // R n − ρ er, without the difference of two long vectors: n − er is the chord of ψ.
  const double half = 0.5 * at[1] / geometry_.ring_radius;
  const Eigen::Vector2d chord =
      2.0 * std::sin(half) * (std::cos(half) * frame.et - std::sin(half) * frame.er);
  state << (geometry_.ring_radius - geometry_.reach) * frame.n + geometry_.reach * chord,
      frame.along_n * frame.n + at[3] * frame.t;
  state[1] -= misalignment_;
  return state;
}

Eigen::Matrix4d TouchdownChart::derivative(const TouchdownCoordinates& at) const {
  const Frame frame = this->frame(at);
  const double radius = geometry_.ring_radius;
  const double reach = geometry_.reach;
  // n turns with the time and with ψ, er with the time alone.
  const Eigen::Vector2d velocity_turns = frame.along_n * frame.t - at[3] * frame.n;
  Eigen::Matrix4d result = Eigen::Matrix4d::Zero();
  result.col(0) << radius * frame.t - reach * frame.et, velocity_turns;
  result.col(1) << frame.t,
      (velocity_turns - speed_ratio_ * reach * std::cos(at[1] / radius) * frame.n) / radius;
  result.col(2).tail<2>() = frame.n;
  result.col(3).tail<2>() = frame.t;
  return result;
}

TouchdownCoordinates TouchdownChart::coordinates(double time, const std::array<double, 4>& state) const {
  const auto direction = blades_.direction(blade_, blades_.first(time));
  const Eigen::Vector2d er(direction.cosine, direction.sine);
  const Eigen::Vector2d et = turned_by_quarter(er);
  const Eigen::Vector2d tip = Eigen::Vector2d(state[0], state[1] + misalignment_) + geometry_.reach * er;
  const Eigen::Vector2d velocity(state[2], state[3]);
  const Eigen::Vector2d n = tip.normalized();
  return {speed_ratio_ * time, geometry_.ring_radius * std::atan2(tip.dot(et), tip.dot(er)),
          n.dot(velocity + speed_ratio_ * geometry_.reach * et), velocity.dot(turned_by_quarter(n))};
}

}  // namespace rubatlas::branch
