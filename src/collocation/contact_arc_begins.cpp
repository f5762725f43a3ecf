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

void ContactArc::begin(double time, const rotor::ShaftAndRing& bodies, std::span<Touch> touching) {
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
  const rotor::State seen = rotor::from_ring(bodies);
  if (!(std::hypot(seen[0], seen[1] + whole_->constants.misalignment) < machine().ring_radius))
    ending_.guard = Guard::shaft_at_ring;
  else if (std::ranges::any_of(tips_, [](const BladeStart& tip) {
             return tip.at_start.shortening > tip.blade->valid_shortening;
           }))
    ending_.guard = Guard::shortening_limit;
}

void ContactArc::lead(double time, const rotor::ShaftAndRing& bodies, std::span<Touch> touching,
                      std::size_t leader) {
  begins_ = true;
  ending_ = {};
  start_ = {.time = time, .bodies = bodies, .bending = {}};
  if (const auto skims = std::ranges::find(touching, true, &Touch::skims); skims != touching.end()) {
    if (!skims->touches_down()) {
      put_on_ring(skims->blade, start_);
      if (const auto found = law_->in_equilibrium(*skims, tip_place(skims->blade, start_))) *skims = *found;
    }
    skim(touching, start_);
  }
  const int leads = touching[leader].blade;
  law_->take(touching[leader]);
  start_.bending = law_->lead(touching[leader]);
  if (law_->is_rigid() && std::ranges::count(touching, 0.0, &Touch::slip) > 0)
    straight_tips_.hold(state_at(start_), touching);
  er_ = direction(leads, time);
  tips_.clear();
  const auto start = [&](const Touch& touch, const TipPlace& at) -> BladeStart& {
    BladeStart& tip = tips_.emplace_back(law_->start(touch, at));
    tip.blade = &numbers(touch.blade);
    const bool may_be_deep = law_->is_rigid() || law_->may_stand_straight(touch.blade);
    const bool stands_on_ring = touch.touches_down() && !may_be_deep;
    tip.start_gap = stands_on_ring ? contact::widening(touch.yielding, machine().ring_radius) : at.pose.gap;
    return tip;
  };
  const TipPlace there = tip_place(leads, start_);
  start(touching[leader], there);
  for (const Touch& touch : touching) {
    if (touch.blade == leads) continue;
    law_->take(touch);
    const TipPlace at = tip_place(touch.blade, start_);
    BladeStart& tip = start(touch, at);
    tip.offset = offset_of(touch.blade);
    law_->set_course(touch, at, tip);
    tip.start_square = tip.square.value;
    start_.further.push_back({tip.start_square, tip.lean.value, tip.start_yielding, touch.share});
  }
  end_ = start_;
  others_.clear();
  for (int blade = 0; blade < whole_->blades.count(); ++blade) {
    if (std::ranges::find(touching, blade, &Touch::blade) == touching.end()) others_.push_back(blade);
  }
  predict(touching[leader], there);
  found_ = {};
  number_ = 0;
  if (tips_.size() == 1 && !leading().skims) look_for_earlier();
}

void ContactArc::look_for_earlier() {
  const auto seen = [this](double x, double y) {
    return Eigen::Array2d{x * er_.cosine + y * er_.sine, y * er_.cosine - x * er_.sine};
  };
  const auto motion = [&](Eigen::Index body, double above) {
    Eigen::Array4d result;
    result << seen(end_.bodies[body], end_.bodies[body + 1] + above),
        seen(end_.bodies[body + 2], end_.bodies[body + 3]);
    return result;
  };
  const std::complex<double> forcing = machine_.forcing(end_.time);
  found_ = earlier_.find({.shaft = motion(0, machine().misalignment),
                          .ring = motion(4, 0.0),
                          .angular_speed = whole_->blades.angular_speed(end_.time),
                          .forcing = seen(forcing.real(), forcing.imag()),
                          .argument = end_.bending.argument,
                          .slip = leading().slip,
                          .straight = leading().straight});
}

/// What is known where the leading blade takes the lead.
void ContactArc::predict(const Touch& touch, const TipPlace& at) {
  std::complex<double> force;
  for (const BladeStart& tip : tips_)
    force += contact::on_rotor(tip.at_start, tip.direction(er_.cosine, er_.sine));
  const rotor::Acceleration acceleration = whole_->acceleration(state_at(end_), force);
  const std::complex<double> closing = acceleration.shaft - acceleration.ring;
  for (BladeStart& tip : tips_) set_out(tip, closing);
  predictor_.begin({.touch = touch,
                    .blade = leading(),
                    .bodies = end_.bodies,
                    .at = at,
                    .direction = er_,
                    .bending = end_.bending,
                    .acceleration = acceleration,
                    .is_lone = is_lone()});
}

/// The leading blade, then the others.
std::vector<Touch> ContactArc::touching_at(const Point& point) const {
  std::vector<Touch> touching;
  for (const BladeStart& tip : tips_) touching.push_back(law_->touch(tip, bending_of(tip.number, point)));
  return touching;
}

/// Begins anew where the last interval has ended: what sweeps have left of the leader's equation there would
/// be a jump at the start of the next one. `leader`: as in `touching_at`. False where it cannot be found
/// anew.
///
/// Gaps stay those by how far the tips have come: those of places would lose digits, or be nothing but
/// rounding.
bool ContactArc::begin_anew(std::size_t leader) {
  const std::vector<BladeStart> before = tips_;
  std::vector<Touch> touching = touching_at(end_);
  Touch& leads = touching[leader];
  TipPlace there = tip_place(leads.blade, end_);
  there.pose.gap = before[leader].start_gap;
  std::optional<Touch> found;
  if (std::abs(there.pose.gap) > contact::gap_rounding(law_->geometry(leads.blade), there.pose))
    found = law_->in_equilibrium(leads, there);
  leads = found.value_or(leads);
  lead(end_.time, rotor::ShaftAndRing(end_.bodies), touching, leader);
  for (BladeStart& tip : tips_)
    tip.start_gap = std::ranges::find(before, tip.number, &TipStart::number)->start_gap;
  predictor_.begin_interval();
  return found.has_value();
}

}  // namespace rubatlas::collocation
