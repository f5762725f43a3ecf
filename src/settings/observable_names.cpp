#include "settings/observable_names.hpp"

#include <array>

namespace rubatlas::settings {
namespace {

constexpr std::array<std::string_view, 13> kNames{
    "poincare",
    "poincare_blade_passing",
    "max_displacement",
    "spectrum",
    "touchdowns_per_revolution",
    "max_contact_force",
    "contact_fraction",
    "max_root_strain",
    "clearance_growth",
    "nearest_miss",
    "lightest_touch",
    "grazing_side",
    "lyapunov",
};

constexpr std::array<std::string_view, 3> kDefaults{"poincare", "max_displacement", "spectrum"};

}  // namespace

std::span<const std::string_view> observable_names() {
  return kNames;
}

std::span<const std::string_view> default_observable_names() {
  return kDefaults;
}

}  // namespace rubatlas::settings
