#include "atlas/software.hpp"

namespace rubatlas::atlas {

void write_provenance(Object root, const Software& software, FileKind kind, const settings::Scene& scene) {
  const std::string not_stated = "not stated in the scene";
  root.set_text("Conventions", "CF-1.8");
  const bool of_maps = kind == FileKind::maps || kind == FileKind::edges;
  root.set_text("schema_version", of_maps ? kMapsSchemaVersion : kSchemaVersion);
  root.set_text("kind", word_of(kind));
  root.set_text("title", scene.title);
  root.set_text("creator", scene.creator.value_or(not_stated));
  root.set_text("license", scene.license.value_or(not_stated));
  root.set_text("software", software.software);
  root.set_text("software_version", software.software_version);
  root.set_text("git_commit", software.git_commit);
  root.set_text("compiler", software.compiler);
}

Software software_of(const File& file) {
  const Object root = file.root();
  return {root.text("software"), root.text("software_version"), root.text("git_commit"),
          root.text("compiler")};
}

}  // namespace rubatlas::atlas
