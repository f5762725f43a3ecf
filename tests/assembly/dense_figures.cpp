#include "dense_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <numbers>

#include "variation/parts_of_scene.hpp"

namespace rubatlas::test {
namespace {

using trajectory::MotionPiece;
using trajectory::State;
using trajectory::Tip;

constexpr int kInContact = 24;      ///< samples of a step in contact
constexpr double kInFlight = 16.0;  ///< samples for each stretch in which a distance has one maximum
constexpr int kStretches = 6;       ///< of a step in contact, for integrals over it

/// Denser at both ends, where forces may start or end like a root of the time.
double share_of(double part) {
  return part * part * (3.0 - 2.0 * part);
}

std::vector<double> times_in(const MotionPiece& piece, double speed_ratio) {
  const double length = piece.end() - piece.begin();
  const bool flies = piece.contact_count() == 0;
  const int count =
      flies ? 16 + static_cast<int>(kInFlight * length / trajectory::spacing_of_distances(speed_ratio))
            : kInContact;
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / count;
    times.push_back(piece.begin() + length * (flies ? part : share_of(part)));
  }
  times.push_back(piece.end());
  return times;
}

/// The largest value of a function, from samples and, about each that is no less than its neighbours and may
/// belong to a larger one, a search between these; or `known`, where it is not larger than that.
template <class Function>
double largest_of(const Function& function, const std::vector<double>& times, double known) {
  constexpr int kBits = 30;
  std::vector<double> values;
  for (const double time : times) values.push_back(function(time));
  double largest = std::max(known, *std::ranges::max_element(values));
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = std::min(i + 1, times.size() - 1);
    const double least = std::min(values[before], values[after]);
    if (values[i] < std::max(values[before], values[after]) || 2.0 * values[i] - least < largest) continue;
    // Over the share between these times: bits of a late time would be few of a short contact.
    const double between = times[after] - times[before];
    const auto top = boost::math::tools::brent_find_minima(
        [&](double share) { return -function(times[before] + share * between); }, 0.0, 1.0, kBits);
    largest = std::max(largest, -top.second);
  }
  return largest;
}

/// Calls `visit(weight, time)` at places of a piece, so that the sum of weight × f is ∫ f dτ.
template <class Visit>
void for_places(const MotionPiece& piece, int stretches, bool graded, const Visit& visit) {
  using Gauss = boost::math::quadrature::gauss<double, 10>;
  const double length = piece.end() - piece.begin();
  for (int i = 0; i < stretches; ++i) {
    for (std::size_t j = 0; j < Gauss::abscissa().size(); ++j) {
      for (const double side : {-1.0, 1.0}) {
        const double part = (i + 0.5 + 0.5 * side * Gauss::abscissa()[j]) / stretches;
        const double rate = graded ? 6.0 * part * (1.0 - part) : 1.0;
        const double weight = 0.5 * Gauss::weights()[j] / stretches * rate * length;
        visit(weight, piece.begin() + length * (graded ? share_of(part) : part));
      }
    }
  }
}

double product(const std::complex<double>& vector, const State& state) {
  return vector.real() * state[2] + vector.imag() * state[3];
}

}  // namespace

DenseFigures::DenseFigures(const settings::Scene& scene, double speed_ratio)
    : scene_(scene),
      speed_ratio_(speed_ratio),
      period_(2.0 * std::numbers::pi / speed_ratio),
      blades_(static_cast<std::size_t>(scene.blades.count)),
      growth_(blades_.size(), 0.0) {}

void DenseFigures::speed_changes(double speed_ratio) {
  speed_ratio_ = speed_ratio;
  period_ = 2.0 * std::numbers::pi / std::abs(speed_ratio);
}

void DenseFigures::piece(MotionPiece& piece) {
  if (!revolution_began_) revolution_began_ = piece.state(piece.begin());
  const double length = piece.end() - piece.begin();
  time_ += length;
  if (piece.contact_count() > 0) in_contact_ += length;
  const auto times = times_in(piece, speed_ratio_);
  std::vector<bool> touches(blades_.size(), false);
  for (std::size_t i = 0; i < piece.contact_count(); ++i)
    touches[static_cast<std::size_t>(piece.blade(i))] = true;
  for (std::size_t k = 0; k < blades_.size(); ++k) {
    Blade& blade = blades_[k];
    const int number = static_cast<int>(k);
    if (!touches[k]) ends_contact(blade);
    if (touches[k] && !blade.in_contact) {
      blade.in_contact = true;
      blade.begun = time_ > length;  // one that is open from the start on is no touch-down
      if (blade.begun) {
        blade.touchdowns += 1.0;
        approach_ = std::max(approach_, piece.tip(number, piece.begin()).rate);
      }
    }
    if (touches[k]) blade.time += length;
    follow_tip(piece, times, number, touches[k]);
  }
  follow_displacement(piece, times);
  follow_loads(piece, times);
  follow_powers(piece);
  for (; sample_ < scene_.protocol.samples_per_revolution; ++sample_) {
    const double time = period_ * sample_ / scene_.protocol.samples_per_revolution;
    if (time >= piece.end()) break;
    const State state = piece.state(time);
    samples_.emplace_back(state[0], state[1]);
  }
  for (; passing_ < scene_.blades.count; ++passing_) {
    const double time = period_ * passing_ / scene_.blades.count;
    if (time > piece.end()) break;
    const State state = piece.state(time);
    passings_.insert(passings_.end(), state.begin(), state.end());
  }
}

void DenseFigures::revolution_ends(const State& section) {
  sections_.insert(sections_.end(), section.begin(), section.end());
  passings_.insert(passings_.end(), section.begin(), section.end());
  sample_ = 0;
  passing_ = 1;
  if (scene_.unbalance) {
    const std::complex<double> across =
        std::polar(scene_.unbalance->moment * std::pow(scene_.rotor.natural_frequency, 2),
                   scene_.unbalance->phase + std::numbers::pi / 2);
    torque_.add(product(across, section));
    torque_.add(-product(across, *revolution_began_));
  }
  revolution_began_.reset();
  for (std::size_t k = 0; k < blades_.size(); ++k) {
    if (scene_.wear) growth_[k] += scene_.wear->rate * blades_[k].friction;
    blades_[k].friction = 0.0;
    // Blades may have become shorter, and the rotor faster.
    blades_[k].before.reset();
  }
}

void DenseFigures::follow_displacement(MotionPiece& piece, const std::vector<double>& times) {
  const auto distance = [&](double time) {
    const State state = piece.state(time);
    return std::hypot(state[0], state[1]);
  };
  displacement_ = largest_of(distance, times, displacement_);
}

void DenseFigures::follow_loads(MotionPiece& piece, const std::vector<double>& times) {
  for (std::size_t i = 0; i < piece.contact_count(); ++i) {
    Blade& blade = blades_[static_cast<std::size_t>(piece.blade(i))];
    blade.force = largest_of([&](double time) { return piece.normal_force(i, time); }, times, blade.force);
    blade.strain = largest_of([&](double time) { return piece.contact_force(i, time).root_strain; }, times,
                              blade.strain);
  }
}

void DenseFigures::follow_tip(MotionPiece& piece, const std::vector<double>& times, int number,
                              bool in_contact) {
  Blade& blade = blades_[static_cast<std::size_t>(number)];
  const bool lasts_outside = scene_.release || scene_.contact_damping;
  const auto take = [&](const Tip& top) {
    if (in_contact) {
      deepest_ = std::max(deepest_, top.overlap);
      if (!blade.deepest || top.overlap > blade.deepest->overlap) blade.deepest = Top{top.overlap, top.side};
    } else if (top.overlap < 0.0 && (!nearest_miss_ || top.overlap > nearest_miss_->overlap)) {
      nearest_miss_ = Top{top.overlap, top.side};
    }
  };
  const double closeness = closeness_of_tips();
  std::optional<Tip> before = blade.before;
  double time_before = piece.begin();
  for (const double time : times) {
    const Tip at = piece.tip(number, time);
    if (in_contact && time > piece.begin()) take(at);
    if (before && before->rate > 0.0 && at.rate <= 0.0) {
      if (time_before == time) {
        take(at);
      } else {
        // By the share, as in `largest_of`; the piece before may have ended with another last digit.
        const double between = time - time_before;
        const auto rate = [&](double share) { return piece.tip(number, time_before + share * between).rate; };
        double top = rate(0.0) > 0.0 ? 1.0 : 0.0;
        if (top > 0.0 && rate(0.0) * rate(1.0) < 0.0) {  // which rates too small for their product are not
          const boost::math::tools::eps_tolerance<double> closeness_of_share(40);
          const auto [low, high] = boost::math::tools::bisect(rate, 0.0, 1.0, closeness_of_share);
          top = 0.5 * (low + high);
        }
        take(piece.tip(number, time_before + top * between));
      }
    }
    const bool wrong = !lasts_outside && (in_contact ? at.overlap < -closeness : at.overlap > closeness);
    if (wrong && contradictions_.size() < 3) {
      contradictions_.push_back(fmt::format("blade {} is {} contact at τ = {} with an overlap of {} m",
                                            number, in_contact ? "in" : "in no", time, at.overlap));
    }
    before = at;
    time_before = time;
  }
  blade.before = before;
}

/// A hop may be so short that no piece of motion is between two contacts.
void DenseFigures::event(const modes::Event& event) {
  if (event.kind == modes::Guard::lift_off) ends_contact(blades_[static_cast<std::size_t>(event.blade)]);
}

void DenseFigures::ends_contact(Blade& blade) {
  if (blade.in_contact && blade.begun && blade.deepest) {
    blade.deepest->overlap = std::max(blade.deepest->overlap, 0.0);
    if (!lightest_touch_ || blade.deepest->overlap < lightest_touch_->overlap)
      lightest_touch_ = blade.deepest;
  }
  blade.in_contact = false;
  blade.deepest.reset();
}

void DenseFigures::follow_powers(MotionPiece& piece) {
  const double length = piece.end() - piece.begin();
  const bool flies = piece.contact_count() == 0;
  const double fastest = 2.0 * std::max({1.0, std::abs(speed_ratio_), 2.0 * scene_.rotor.damping_ratio});
  const int stretches = flies ? 1 + static_cast<int>(length * fastest) : kStretches;
  const std::complex<double> unbalance =
      scene_.unbalance ? std::polar(scene_.unbalance->moment * std::pow(scene_.rotor.natural_frequency, 2),
                                    scene_.unbalance->phase)
                       : 0.0;
  for_places(piece, stretches, !flies, [&](double weight, double time) {
    const State state = piece.state(time);
    viscous_.add(weight * (state[2] * state[2] + state[3] * state[3]));
    fastest_ = std::max(fastest_, std::hypot(state[2], state[3]));
    torque_.add(weight * speed_ratio_ * product(unbalance * std::polar(1.0, speed_ratio_ * time), state));
    for (std::size_t i = 0; i < piece.contact_count(); ++i) {
      Blade& blade = blades_[static_cast<std::size_t>(piece.blade(i))];
      const trajectory::ContactForce force = piece.contact_force(i, time);
      blade.impulse += weight * force.normal;
      blade.friction += weight * std::abs(force.friction_power());
      friction_.add(weight * force.friction_power());
      torque_.add(-weight * force.torque);
      deformation_.add(-weight * product(force.on_rotor, state));
      deformation_.add(-weight * speed_ratio_ * force.torque);
      deformation_.add(-weight * force.friction_power());
    }
  });
}

/// How well it is known where the tips are [m]: rounding of the time, and the errors of steps.
double DenseFigures::closeness_of_tips() const {
  constexpr double kRounding = 1e-13;
  constexpr double kTolerances = 100.0;  // as observables may err by
  return kRounding * scene_.ring.radius * (1.0 + period_) +
         kTolerances * scene_.accuracy.tolerance * variation::constants_of(scene_, speed_ratio_).length_scale;
}

bool DenseFigures::only_brushes() const {
  return deepest_ >= 0.0 && deepest_ < 1e-9 * scene_.ring.radius;
}

bool DenseFigures::hardly_moves() const {
  return fastest_ <
         100.0 * scene_.accuracy.tolerance * variation::constants_of(scene_, speed_ratio_).length_scale;
}

DenseFigures::Figure DenseFigures::of_blades(double Blade::*value, double unit) const {
  Figure figure{{}, 0.0};
  for (const Blade& blade : blades_) {
    figure.values.push_back(unit * (blade.*value));
    figure.size = std::max(figure.size, std::abs(figure.values.back()));
  }
  return figure;
}

DenseFigures::Figure DenseFigures::mean(const Mean& quantity, double unit) const {
  return {{unit * quantity.sum / time_}, std::abs(unit) * quantity.absolute / time_};
}

DenseFigures::Figure DenseFigures::spectrum(bool of_whirl) const {
  const auto count = static_cast<int>(samples_.size());
  const int highest = scene_.spectrum.max_order * scene_.protocol.sampled_revolutions;
  double size = 0.0;
  for (const auto& sample : samples_) size = std::max(size, std::abs(sample));
  Figure figure{{}, size};
  for (int order = of_whirl ? -highest : 0; order <= highest; ++order) {
    std::complex<double> sum;
    for (int i = 0; i < count; ++i) {
      const auto turn = static_cast<double>((static_cast<long>(order) * i) % count) / count;
      const auto& sample = samples_[static_cast<std::size_t>(i)];
      sum += (of_whirl ? sample : sample.real()) * std::polar(1.0, -2.0 * std::numbers::pi * turn);
    }
    const bool nyquist = 2 * std::abs(order) == count;
    const double share = of_whirl ? (nyquist ? 0.5 : 1.0) : (order == 0 || nyquist ? 1.0 : 2.0);
    figure.values.push_back(share * std::abs(sum) / count);
  }
  return figure;
}

std::optional<DenseFigures::Figure> DenseFigures::grazing_side() const {
  if (!nearest_miss_ && !lightest_touch_) return Figure{{0.0}, 1.0};
  const double miss = nearest_miss_ ? -nearest_miss_->overlap : std::numeric_limits<double>::infinity();
  const double touch = lightest_touch_ ? lightest_touch_->overlap : std::numeric_limits<double>::infinity();
  const double side = touch < miss ? lightest_touch_->side : nearest_miss_->side;
  // Where a tip is farthest out is known to the root of the rounding of its radius. A pass or a contact that
  // is nearer than its error may be another one's.
  const double doubt = 1e-6 * scene_.ring.radius;
  const double closeness = closeness_of_tips();
  if (std::abs(side) < doubt || std::abs(miss - touch) < closeness || std::min(miss, touch) < closeness)
    return std::nullopt;
  return Figure{{side > 0.0 ? 1.0 : 3.0}, 1.0};
}

std::optional<DenseFigures::Figure> DenseFigures::figure(std::string_view observable) const {
  const double frequency = scene_.rotor.natural_frequency;
  const double revolutions = scene_.protocol.sampled_revolutions;
  const auto all = [](const std::vector<double>& values) {
    double size = 0.0;
    for (const double value : values) size = std::max(size, std::abs(value));
    return Figure{values, size};
  };
  const auto one = [](double value) { return Figure{{value}, std::abs(value)}; };
  const auto largest = [&](double Blade::*value) {
    double found = 0.0;
    for (const Blade& blade : blades_) found = std::max(found, blade.*value);
    return found;
  };
  const auto of_tip = [&](const std::optional<Top>& top) {
    const double value = top ? std::abs(top->overlap) : std::numeric_limits<double>::quiet_NaN();
    return Figure{{value}, std::max(value, 1e5 * closeness_of_tips())};
  };
  if (observable == "poincare") return all(sections_);
  if (observable == "poincare_blade_passing") return all(passings_);
  if (observable == "max_displacement") return one(displacement_);
  if (observable == "spectrum") return spectrum(false);
  if (observable == "full_spectrum") return spectrum(true);
  if (observable == "touchdowns_of_blades") return of_blades(&Blade::touchdowns, 1.0 / revolutions);
  if (observable == "touchdowns_per_revolution") {
    double sum = 0.0;
    for (const Blade& blade : blades_) sum += blade.touchdowns;
    return one(sum / revolutions);
  }
  if (observable == "max_contact_force") return one(largest(&Blade::force));
  if (observable == "max_contact_force_of_blades") return of_blades(&Blade::force, 1.0);
  if (observable == "max_root_strain") return one(largest(&Blade::strain));
  if (observable == "max_root_stress") return one(scene_.blades.youngs_modulus * largest(&Blade::strain));
  if (observable == "yielded") {
    const double strain = largest(&Blade::strain);
    const double limit = scene_.validity.yield_strain.value();
    if (std::abs(strain - limit) < 1e-6 * limit) return std::nullopt;
    return Figure{{strain > limit ? 1.0 : 0.0}, 1.0};
  }
  if (observable == "contact_fraction") return Figure{{in_contact_ / time_}, 1.0};
  if (observable == "contact_fraction_of_blades") {
    Figure figure = of_blades(&Blade::time, 1.0 / time_);
    figure.size = 1.0;
    return figure;
  }
  if (observable == "impulse_of_blades") return of_blades(&Blade::impulse, 1.0 / frequency / revolutions);
  if (observable == "clearance_growth") return one(*std::ranges::max_element(growth_));
  if (observable == "nearest_miss") return of_tip(nearest_miss_);
  if (observable == "lightest_touch") return of_tip(lightest_touch_);
  if (observable == "grazing_side") return grazing_side();
  if (observable == "approach_speed") return one(frequency * approach_);
  if (observable == "friction_power") return mean(friction_, frequency);
  if (observable == "viscous_power") {
    return mean(viscous_, 2.0 * scene_.rotor.damping_ratio * scene_.rotor.mass * std::pow(frequency, 3));
  }
  if (observable == "deformation_power") return mean(deformation_, frequency);
  if (observable == "drive_torque") return mean(torque_, 1.0);
  return std::nullopt;
}

}  // namespace rubatlas::test
