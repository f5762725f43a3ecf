/// The identifier of a scene's atlas, as data repositories ask for it: the same for the same motions, whoever
/// computes them.
#pragma once

#include <string>

#include "settings/scene.hpp"

namespace rubatlas::settings {

/// `urn:uuid:` and a UUID of version 5 (RFC 9562: SHA-1 of a name) of the scene's canonical text without
/// title, reference, creator and license.
std::string identifier_of(const Scene& scene);

}  // namespace rubatlas::settings
