#include "analysis/rules/contact.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/rules/free_shaft.hpp"
#include "analysis/rules/gaps.hpp"
#include "analysis/rules/parameter.hpp"

namespace rubatlas::analysis {
namespace {

/// Whether every section follows from the one before by free motion.
bool is_free(const FreeShaft& shaft, std::span<const double> sections, const ClosingTolerance& tolerance) {
  const double equal = std::max(tolerance.relative * orbit_size(sections), tolerance.floor);
  for (std::size_t next = kStateSize; next < sections.size(); next += kStateSize) {
    const auto free = shaft.later(shaft.vibration(sections.subspan(next - kStateSize, kStateSize)));
    const auto found = shaft.vibration(sections.subspan(next, kStateSize));
    if (!(std::hypot(std::abs(found.position - free.position), std::abs(found.velocity - free.velocity)) <=
          equal))
      return false;
  }
  return true;
}

/// Between the ring and the longest blade [m].
double clearance_of_longest(const settings::Scene& line) {
  if (!line.unequal_blades) return line.clearance();
  const auto errors = line.unequal_blades->errors(line.blades.count);
  return line.clearance() - std::ranges::max_element(errors, {}, &effects::BladeError::length)->length;
}

}  // namespace

PointContact contact_at(const settings::Scene& line, double speed_ratio, const ContactEvidence& evidence,
                        const ClosingTolerance& tolerance) {
  using effects::Effects;
  if (evidence.figure > 0.0) return {Contact::touches};
  // A ring that is a body comes towards the blades.
  const bool reach_no_farther = !effects::acts<&Effects::ring_body>(line);
  const bool are_as_long = reach_no_farther && !effects::acts<&Effects::wear>(line);
  bool is_pushed = false;        // by a ring, between two sections
  double kept = kNotANumber;     // [m] distance from the ring within which no tip comes
  double reached = kNotANumber;  // [m] distance within which a tip comes once per revolution
  if (evidence.sections.size() > kStateSize && FreeShaft::describes(line, speed_ratio)) {
    const FreeShaft shaft(line, speed_ratio);
    const auto vibration = shaft.vibration(evidence.sections.first(kStateSize));
    is_pushed = !is_free(shaft, evidence.sections, tolerance);
    if (reach_no_farther) kept = shaft.distance(vibration);
    if (are_as_long) reached = shaft.distance() + vibration.bound();
  }
  const bool stays_inside =
      kept > 0.0 || (reach_no_farther && evidence.max_displacement <
                                             clearance_of_longest(line) - std::abs(line.rotor.misalignment));
  PointContact result{Contact::none, evidence.nearest_miss};
  if (!std::isfinite(evidence.figure)) {
    if (is_pushed || reached < 0.0) return {Contact::touches};
    if (!stays_inside) return {};
  }
  if (std::isnan(result.distance) && are_as_long && kept > 0.0) result.distance = kept;
  if (result.distance <= 0.0) result.distance = kNotANumber;  // a bound that says nothing
  return result;
}

bool may_touch(const Line& line, std::size_t point) {
  return point >= line.contact.size() || line.contact[point].contact != Contact::none;
}

ContactSummary summarise_contact(const Line& line) {
  ContactSummary found;
  std::vector<std::size_t> known;
  std::size_t not_done = 0;
  for (std::size_t i = 0; i < line.contact.size(); ++i) {
    if (!is_done(line, i)) {
      ++not_done;
      continue;
    }
    const auto& [contact, distance] = line.contact[i];
    const double speed = line.speed_ratio[i];
    if (contact == Contact::not_known) {
      ++found.not_known;
      continue;
    }
    known.push_back(i);
    if (contact == Contact::touches) {
      if (found.touching++ == 0) found.first = speed;
      found.last = speed;
      continue;
    }
    ++found.free;
    if (std::isfinite(distance) && !(distance >= found.closest_distance)) {
      found.closest_distance = distance;
      found.closest_speed = speed;
    }
  }
  std::vector<std::string> parts;
  if (found.touching == 0) {
    if (found.free > 0) parts.emplace_back("no contact");
  } else if (found.free == 0) {
    parts.emplace_back("contact at every speed");
  } else if (found.touching == 1) {
    parts.push_back(fmt::format("contact at Ω = {:.6g} only", found.first));
  } else {
    const bool from_lowest = found.first == line.speed_ratio[known.front()];
    std::string text = from_lowest ? "contact from the lowest speed on"
                                   : fmt::format("first contact at Ω = {:.6g}", found.first);
    if (found.last < line.speed_ratio[known.back()])
      text += fmt::format(", last contact at Ω = {:.6g}", found.last);
    const auto between = std::ranges::count_if(known, [&](std::size_t i) {
      return line.speed_ratio[i] > found.first && line.speed_ratio[i] < found.last && !may_touch(line, i);
    });
    if (between > 0) text += fmt::format(", none at {} of the speeds in between", between);
    parts.push_back(text);
  }
  if (std::isfinite(found.closest_distance)) {
    parts.push_back(fmt::format("{}closest {} at Ω = {:.6g}", found.touching > 0 ? "elsewhere " : "",
                                millimetres(found.closest_distance), found.closest_speed));
  }
  if (found.not_known > 0) {
    parts.push_back(
        fmt::format("whether blades touch is not known{}: the observable `contact_fraction` tells",
                    known.empty() ? "" : fmt::format(" at {} speeds", found.not_known)));
  }
  // A motion that has left the model may have touched there.
  if (!known.empty() && not_done > 0)
    parts.push_back(
        fmt::format("{} not done", not_done == 1 ? "1 speed is" : fmt::format("{} speeds are", not_done)));
  found.text = fmt::format("{}", fmt::join(parts, "; "));
  return found;
}

}  // namespace rubatlas::analysis
