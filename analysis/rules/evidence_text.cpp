#include "analysis/rules/evidence_text.hpp"

#include <fmt/format.h>

#include "analysis/rules/parameter.hpp"

namespace rubatlas::analysis {
namespace {

std::string_view absence_text(Presence presence) {
  switch (presence) {
    case Presence::absent:
      return "absent";
    case Presence::merged:
      return "merged with region 2";
    default:
      return "not covered";
  }
}

}  // namespace

std::string extent_text(const Region& region) {
  const auto end = [](double speed, bool at_gap) {
    return at_gap ? fmt::format("({:.3f})", speed) : fmt::format("{:.3f}", speed);
  };
  return fmt::format("{}-{}", end(region.from, region.begins_at_gap), end(region.to, region.ends_at_gap));
}

std::string region_text(int number, const Region& region) {
  if (!region.present()) return fmt::format("region {}: {}", number, absence_text(region.presence));
  return fmt::format("region {}: {}, {:.0f} % aperiodic, peak {}", number, extent_text(region),
                     100.0 * region.aperiodic_share, millimetres(region.peak_displacement));
}

std::string trigger_text(int number, const Trigger& trigger) {
  if (trigger.presence != Presence::present) {
    return fmt::format("trigger {}: {}", number, absence_text(trigger.presence));
  }
  return fmt::format("trigger {}: at {:.3f}, {} to {} (×{:.3g})", number, trigger.speed_ratio,
                     millimetres(trigger.displacement_below), millimetres(trigger.displacement_above),
                     trigger.ratio());
}

}  // namespace rubatlas::analysis
