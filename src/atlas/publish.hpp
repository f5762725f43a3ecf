/// A file appears under its name when it is complete, or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "atlas/output.hpp"

namespace rubatlas::atlas {

/// A file under a temporary name of its own, in the directory where it is to appear, since a rename must not
/// cross file systems. The file is created exclusively, so that two commands with the same output do not
/// write the same file, and a link of that name is not followed. A file that is not published is removed.
class Publication {
 public:
  /// Creates the empty file. Throws EnvironmentError.
  explicit Publication(Output output);
  ~Publication();
  Publication(const Publication&) = delete;
  Publication& operator=(const Publication&) = delete;

  /// The temporary name.
  [[nodiscard]] const std::filesystem::path& name() const { return name_; }

  /// Forces the file, which has to be closed, to the disk and renames it. Throws OutputRefusal where another
  /// file has taken that name in the meantime and must not be replaced, EnvironmentError where the file
  /// system refuses.
  void publish();

 private:
  void rename_over() const;
  void rename_to_free_name() const;

  Output output_;
  std::filesystem::path name_;
  int descriptor_ = -1;
};

/// Publishes a text.
void publish_text(const Output& output, const std::string& text);

}  // namespace rubatlas::atlas
