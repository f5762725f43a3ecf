// How an arc begins, and begins anew: who leads, and what is known where it takes the lead.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "collocation/contact_arc.hpp"

namespace rubatlas::collocation {

/// g of a straight tip in contact [m²]. One that touches down stands on the ring.
double ContactArc::gap_at(const Touch& touch, const Point& point) const {
  if (law_->is_rigid() || law_->may_stand_straight(touch.blade) || !touch.touches_down())
    return pose(touch.blade, point).gap;
  return touch.yielding * (2.0 * machine().ring_radius + touch.yielding);
}

void ContactArc::begin(double time, const rotor::ShaftAndRing& bodies, std::span<const Touch> touching) {
  // Who touches down now is not the next to lift off. But the load of a blade with next to no friction all
  // but jumps there, which takes a time that only an arc over its bending resolves.
  const auto all_but_jumps = [this](const Touch& touch) {
    constexpr double kLongest = 10.0;  // p of the largest bend
    const blade::BendingTable* const table = numbers(touch.blade).table;
    return touch.touches_down() && table != nullptr && table->knots().back().argument > kLongest;
  };
  auto leads = std::ranges::find_if(touching, all_but_jumps);
  if (leads == touching.end()) leads = std::ranges::find_if_not(touching, &Touch::touches_down);
  if (leads == touching.end()) leads = touching.begin();
  lead_changes_ = 0;
  lead(time, bodies, touching, static_cast<std::size_t>(leads - touching.begin()));
}

void ContactArc::lead(double time, const rotor::ShaftAndRing& bodies, std::span<const Touch> touching,
                      std::size_t leader) {
  blade_ = touching[leader].blade;
  contact_.blade = &numbers(blade_);
  contact_.slip = touching[leader].slip;
  contact_.straight = touching[leader].straight;
  contact_.skims = touching[leader].skims;
  begins_ = true;
  ending_ = {};
  start_ = {.time = time, .bodies = bodies, .bending = {}};
  std::vector<Touch> held;
  if (std::ranges::count(touching, true, &Touch::skims) > 0) {
    held.assign(touching.begin(), touching.end());
    skim(held, start_);
    touching = held;
  }
  start_.bending = law_->lead(touching[leader], touching.size() == 1);
  if (law_->is_rigid() && std::ranges::count(touching, 0.0, &Touch::slip) > 0) {
    held.assign(touching.begin(), touching.end());
    hold(held, start_);
    touching = held;
  }
  er_ = direction(blade_, time);
  const contact::BladeDirection& from = from_first_[static_cast<std::size_t>(blade_)];
  std::ranges::transform(from_first_, offsets_.begin(),
                         [&from](const auto& to) { return offset_between(from, to); });
  offsets_[static_cast<std::size_t>(blade_)] = {1.0, 0.0};
  further_.clear();
  for (const Touch& touch : touching) {
    if (touch.blade == blade_) continue;
    FurtherStart& start =
        further_.emplace_back(law_->further(touch, pose(touch.blade, start_), blades_->angular_speed(time)));
    start.offset = offset_of(touch.blade);
    start.tip.start_gap = gap_at(touch, start_);
    start_.further.push_back({start.square.value, start.lean.value, start.tip.start_yielding, touch.share});
  }
  end_ = start_;
  others_.clear();
  for (int blade = 0; blade < blades_->count(); ++blade) {
    if (std::ranges::find(touching, blade, &Touch::blade) == touching.end()) others_.push_back(blade);
  }
  predict(touching[leader]);
  found_ = {};
  number_ = 0;
  if (further_.empty() && !contact_.skims) look_for_earlier();
}

double ContactArc::shortening_at_start() const {
  double largest = at_end_.start_shortening;
  for (const FurtherStart& further : further_) largest = std::max(largest, further.tip.start_shortening);
  return largest;
}
bool ContactArc::starts_within_ring() const {
  const rotor::State seen = rotor::from_ring(start_.bodies);
  return std::hypot(seen[0], seen[1] + rotor_->misalignment) < machine().ring_radius;
}

void ContactArc::look_for_earlier() {
  const auto seen = [this](double x, double y) {
    return std::array{x * er_.cosine + y * er_.sine, y * er_.cosine - x * er_.sine};
  };
  const auto motion = [&](Eigen::Index body, double above) {
    const auto [x, y] = seen(end_.bodies[body], end_.bodies[body + 1] + above);
    const auto [vx, vy] = seen(end_.bodies[body + 2], end_.bodies[body + 3]);
    return std::array{x, y, vx, vy};
  };
  const std::complex<double> forcing = machine_.forcing(end_.time);
  found_ = earlier_.find({.shaft = motion(0, machine().misalignment),
                          .ring = motion(4, 0.0),
                          .angular_speed = blades_->angular_speed(end_.time),
                          .forcing = seen(forcing.real(), forcing.imag()),
                          .argument = end_.bending.argument,
                          .slip = contact_.slip,
                          .straight = contact_.straight});
}

/// What is known where the leading blade takes the lead.
void ContactArc::predict(const Touch& touch) {
  const double angular_speed = blades_->angular_speed(end_.time);
  const contact::Pose there = pose(blade_, end_);
  const ArcLaw::Start starts = law_->start(touch, there, angular_speed);
  at_end_ = starts.tip;
  at_end_.start_gap = gap_at(touch, start_);
  std::complex<double> force = contact::on_rotor(starts.force, er_);
  for (const FurtherStart& further : further_) {
    const contact::BladeDirection er{er_.cosine * further.offset[0] - er_.sine * further.offset[1],
                                     er_.sine * further.offset[0] + er_.cosine * further.offset[1]};
    force += contact::on_rotor(further.force, er);
  }
  const rotor::Acceleration acceleration =
      whole_->acceleration(rotor::full_state(end_.bodies, end_.time, 0.0), force);
  const std::complex<double> closing = acceleration.shaft - acceleration.ring;
  set_out(blade_, contact_.slip, closing, at_end_.start_slip_velocity);
  for (FurtherStart& further : further_)
    set_out(further.blade, further.slip, closing, further.tip.start_slip_velocity);
  predictor_.begin({.touch = touch,
                    .blade = contact_.blade,
                    .ring_radius = machine().ring_radius,
                    .angular_speed = angular_speed,
                    .bodies = end_.bodies,
                    .pose = there,
                    .direction = er_,
                    .bending = end_.bending,
                    .gap_measure = at_end_.start_gap_measure,
                    .ring_opens = starts.ring_opens,
                    .acceleration = acceleration});
}

/// The leading blade, then the others.
std::vector<Touch> ContactArc::touching_at(const Point& point) const {
  std::vector<Touch> touching{law_->touch(blade_, contact_.slip, point.bending)};
  for (const FurtherStart& further : further_)
    touching.push_back(law_->touch(further.blade, further.slip, bending_of(further.blade, point)));
  return touching;
}

/// Begins anew where the last interval has ended: what sweeps have left of the leader's equation there would
/// be a jump at the start of the next one. `leader`: as in `touching_at`. False where it cannot be found
/// anew.
///
/// Gaps stay those by how far the tips have come: those of places would lose digits, or be nothing but
/// rounding.
bool ContactArc::begin_anew(std::size_t leader) {
  std::vector<double> gaps{at_end_.start_gap};
  for (const FurtherStart& further : further_) gaps.push_back(further.tip.start_gap);
  std::vector<Touch> touching = touching_at(end_);
  Touch& leads = touching[leader];
  contact::Pose there = pose(leads.blade, end_);
  there.gap = gaps[leader];
  std::optional<Touch> found;
  if (std::abs(there.gap) > contact::gap_rounding(law_->geometry(leads.blade), there))
    found = law_->found_anew(leads, there, blades_->angular_speed(end_.time));
  leads = found.value_or(leads);
  lead(end_.time, rotor::ShaftAndRing(end_.bodies), touching, leader);
  at_end_.start_gap = gaps[leader];
  gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(leader));
  for (std::size_t k = 0; k < further_.size(); ++k) further_[k].tip.start_gap = gaps[k];
  predictor_.begin_interval();
  return found.has_value();
}

}  // namespace rubatlas::collocation
