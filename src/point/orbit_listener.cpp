#include "point/orbit_listener.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace rubatlas::point {
namespace {

/// Samples in a piece of motion in contact. A piece is at most one step, and a step is about a tenth of a
/// contact.
constexpr int kParts = 8;

}  // namespace

OrbitListener::OrbitListener(double period, int samples_per_revolution, int blade_count)
    : period_(period),
      samples_per_revolution_(samples_per_revolution),
      open_(static_cast<std::size_t>(blade_count)) {}

void OrbitListener::piece(trajectory::MotionPiece& piece) {
  sample_orbit(piece);
  std::vector<bool> touches(open_.size(), false);
  for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
    touches[static_cast<std::size_t>(piece.blade(contact))] = true;
    sample_contact(piece, contact);
  }
  for (std::size_t blade = 0; blade < open_.size(); ++blade) {
    if (!touches[blade]) open_[blade].reset();
  }
  may_jump_ = false;
}

void OrbitListener::event(const modes::Event& event) {
  may_jump_ = true;
  if (event.kind == modes::Guard::lift_off) open_[static_cast<std::size_t>(event.blade)].reset();
}

void OrbitListener::speed_changes(double speed_ratio) {
  begin_ += period_ * (revolution_ - since_);
  since_ = revolution_;
  period_ = 2.0 * std::numbers::pi / std::abs(speed_ratio);
  may_jump_ = true;
}

void OrbitListener::revolution_ends(const motion::SectionState& section) {
  orbit_.sections.push_back(section);
  sample_ = 0;
  ++revolution_;
}

double OrbitListener::since_start(double time) const {
  return begin_ + (period_ * (revolution_ - since_) + time);
}

void OrbitListener::sample_orbit(trajectory::MotionPiece& piece) {
  for (; sample_ < samples_per_revolution_; ++sample_) {
    const double time = period_ * sample_ / samples_per_revolution_;
    if (time >= piece.end()) return;
    orbit_.time.push_back(since_start(time));
    orbit_.state.push_back(piece.state(time));
    const std::size_t first = orbit_.force.size();
    orbit_.force.resize(first + open_.size(), 0.0);
    for (std::size_t contact = 0; contact < piece.contact_count(); ++contact) {
      orbit_.force[first + static_cast<std::size_t>(piece.blade(contact))] =
          piece.normal_force(contact, time);
    }
  }
}

/// Samples a contact at both ends of the piece, between these at equal distances, and at the peak of the
/// force where there is one.
void OrbitListener::sample_contact(trajectory::MotionPiece& piece, std::size_t contact) {
  const int blade = piece.blade(contact);
  auto& open = open_[static_cast<std::size_t>(blade)];
  const bool goes_on = open.has_value();
  if (!goes_on) {
    open = contacts_.size();
    contacts_.push_back({blade, {}});
  }
  auto& samples = contacts_[*open].samples;
  const auto add = [&](double time, double force) {
    samples.push_back({since_start(time), force, piece.state(time)});
  };
  const double begin = piece.begin();
  const double end = piece.end();
  // Without an event since then, the last piece has ended with the same force.
  if (!goes_on || may_jump_) add(begin, piece.normal_force(contact, begin));
  if (!(end > begin)) return;

  trajectory::MotionPiece::LargestLoad peak{end, 0.0};
  if (piece.load_peaks(contact)) peak = piece.largest(trajectory::Load::normal_force, contact, 0.0);
  double before = begin;
  for (int part = 1; part <= kParts; ++part) {
    const double time = part == kParts ? end : begin + (end - begin) * part / kParts;
    if (peak.time > before && peak.time < time) add(peak.time, peak.value);
    add(time, peak.time == time && time < end ? peak.value : piece.normal_force(contact, time));
    before = time;
  }
}

Orbit OrbitListener::take() {
  auto& kept = orbit_.contacts;
  for (std::size_t number = 0; number < contacts_.size(); ++number) {
    for (const auto& sample : contacts_[number].samples) {
      kept.number.push_back(static_cast<std::int32_t>(number));
      kept.blade.push_back(contacts_[number].blade);
      kept.time.push_back(sample.time);
      kept.force.push_back(sample.force);
      kept.state.push_back(sample.state);
    }
  }
  contacts_.clear();
  return std::move(orbit_);
}

}  // namespace rubatlas::point
