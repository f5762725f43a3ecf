#include "settings/observable_names.hpp"

#include <array>

namespace rubatlas::settings {
namespace {

constexpr std::array<std::string_view, 24> kNames{
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
    "full_spectrum",
    "friction_power",
    "viscous_power",
    "deformation_power",
    "drive_torque",
    "touchdowns_of_blades",
    "contact_fraction_of_blades",
    "impulse_of_blades",
    "max_contact_force_of_blades",
    "approach_speed",
    "max_root_stress",
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
