/// How a point ended, and what ended it: one list for the motions, the atlas and its readers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace rubatlas::ending {

/// How a point ended (MODEL 5); the numbers are those of the atlas' `/status`.
enum class PointStatus : std::uint8_t { pending = 0, done = 1, left_validity = 2, integrator_failed = 3 };

/// What ended a point; the numbers are those of the atlas' `/status_detail`, which never change.
enum class StatusDetail : std::uint8_t {
  none = 0,
  no_equilibrium = 1,
  shortening_limit = 2,
  shaft_at_ring = 3,
  slip_undecided = 4,
  ring_unbalanced = 5,
  worn_out = 6,
  contact_work = 16,
  flight_work = 17,
  event_work = 18,
  beyond_precision = 19,
  step_too_short = 20,
  given_up = 255  ///< asked to stop: the point is pending, and never written
};

struct StatusDetailText {
  StatusDetail detail;
  PointStatus status;     ///< of a point that ends so
  std::string_view name;  ///< in `flag_meanings`
  std::string_view text;  ///< what ended the motion, as part of a sentence
};

/// All details that the atlas may hold, `none` first.
inline constexpr std::array kStatusDetails{
    StatusDetailText{StatusDetail::none, PointStatus::done, "none", "nothing ended it"},
    StatusDetailText{StatusDetail::no_equilibrium, PointStatus::left_validity, "no_equilibrium",
                     "a blade in contact has no equilibrium"},
    StatusDetailText{StatusDetail::shortening_limit, PointStatus::left_validity, "shortening_limit",
                     "a blade is shortened by more than /validity/max_shortening"},
    StatusDetailText{StatusDetail::shaft_at_ring, PointStatus::left_validity, "shaft_at_ring",
                     "the shaft's centre reaches the ring"},
    StatusDetailText{StatusDetail::slip_undecided, PointStatus::left_validity, "slip_undecided",
                     "friction leaves a blade tip neither rest nor a direction of slip"},
    StatusDetailText{StatusDetail::ring_unbalanced, PointStatus::left_validity, "ring_unbalanced",
                     "the ring without mass has no place where its spring balances the blades"},
    StatusDetailText{StatusDetail::worn_out, PointStatus::left_validity, "worn_out",
                     "a blade has lost more than /wear/max_loss of its length"},
    StatusDetailText{StatusDetail::contact_work, PointStatus::integrator_failed, "contact_work",
                     "the revolution needs more work than is allowed, most of it steps in contact"},
    StatusDetailText{
        StatusDetail::flight_work, PointStatus::integrator_failed, "flight_work",
        "the revolution needs more work than is allowed, most of it the search for touch-downs in flight"},
    StatusDetailText{
        StatusDetail::event_work, PointStatus::integrator_failed, "event_work",
        "the revolution needs more work than is allowed, most of it contacts that open, close and reverse"},
    StatusDetailText{StatusDetail::beyond_precision, PointStatus::integrator_failed, "beyond_precision",
                     "double precision does not hold the motion"},
    StatusDetailText{StatusDetail::step_too_short, PointStatus::integrator_failed, "step_too_short",
                     "no step, however short, keeps the tolerance"},
};

inline constexpr const StatusDetailText* find_status_detail(StatusDetail detail) {
  const auto* const found = std::find_if(kStatusDetails.begin(), kStatusDetails.end(),
                                         [&](const auto& entry) { return entry.detail == detail; });
  return found == kStatusDetails.end() ? nullptr : found;
}

inline constexpr PointStatus status_of(StatusDetail detail) {
  const auto* const entry = find_status_detail(detail);
  return entry == nullptr ? PointStatus::pending : entry->status;
}
/// What ended the motion, as part of a sentence.
inline constexpr std::string_view text_of(StatusDetail detail) {
  const auto* const entry = find_status_detail(detail);
  return entry == nullptr ? "it was given up" : entry->text;
}

}  // namespace rubatlas::ending
