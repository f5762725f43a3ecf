#include <array>

#include "scene/quantity.hpp"

namespace rubatlas::scene {
namespace {

constexpr std::array kSections{
    Section{.pointer = "/rotor", .meaning = "point mass on a massless isotropic shaft"},
    Section{.pointer = "/blades", .meaning = "equal, massless blades clamped on a hub"},
    Section{.pointer = "/ring", .meaning = "the ring that surrounds the blades"},
    Section{.pointer = "/contact", .meaning = "what happens between a blade tip and the ring"},
    Section{.pointer = "/unbalance",
            .meaning = "an effect: absent without this section or a grid axis of this name",
            .open =
                [](Scene& scene) {
                  if (!scene.unbalance) scene.unbalance.emplace();
                }},
    Section{.pointer = "/grid", .meaning = "the values along the axes of the atlas"},
    Section{.pointer = "/initial", .meaning = "state of the shaft centre at phase 0"},
    Section{.pointer = "/protocol", .meaning = "how long a point runs and what of it is kept"},
    Section{.pointer = "/spectrum", .meaning = "extent of the amplitude spectrum"},
    Section{.pointer = "/validity", .meaning = "where the model ends"},
    Section{.pointer = "/accuracy", .meaning = "method of integration and its error control"},
};

constexpr std::array kGridAxes{
    GridAxis{.name = "thickness", .quantity = "/blades/thickness", .values = &Grid::thickness},
    GridAxis{.name = "unbalance", .quantity = "/unbalance/moment", .values = &Grid::unbalance},
    GridAxis{.name = "friction", .quantity = "/contact/friction", .values = &Grid::friction},
    GridAxis{.name = "damping_ratio", .quantity = "/rotor/damping_ratio", .values = &Grid::damping_ratio},
    GridAxis{.name = "speed_ratio", .quantity = "/grid/speed_ratio", .values = &Grid::speed_ratio},
};

}  // namespace

std::span<const Section> sections() {
  return kSections;
}

std::span<const GridAxis> grid_axes() {
  return kGridAxes;
}

}  // namespace rubatlas::scene
