#include "settings/identifier.hpp"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/string_generator.hpp>
#include <boost/uuid/uuid_io.hpp>

#include "settings/reader.hpp"

namespace rubatlas::settings {

std::string identifier_of(const Scene& scene) {
  // Of names that are scenes of this program. Another namespace would give every scene another identifier.
  static const auto kScenes = boost::uuids::string_generator()("ae902552-a7df-4316-84ce-174aab5fdaec");
  return "urn:uuid:" +
         boost::uuids::to_string(boost::uuids::name_generator_sha1(kScenes)(motion_json(scene)));
}

}  // namespace rubatlas::settings
