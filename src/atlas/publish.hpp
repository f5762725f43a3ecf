/// A file appears under its name when it is complete, or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "atlas/output.hpp"

namespace rubatlas::atlas {

/// A file under a temporary name of its own, in the directory where it is to appear, since a rename must not
/// cross file systems. The name is made exclusively: two commands with one output do not meet, and a link
/// that somebody has laid there is not followed. What is not published is removed.
class Publication {
 public:
  /// Creates the empty file. Throws EnvironmentError.
  explicit Publication(Output output);
  ~Publication();
  Publication(const Publication&) = delete;
  Publication& operator=(const Publication&) = delete;

  /// The temporary name.
  [[nodiscard]] const std::filesystem::path& name() const { return name_; }

  /// Brings the file, closed by whoever wrote it, to the disk and gives it its name. Throws OutputRefusal
  /// where another file has come to that name in the meantime and must not be replaced, EnvironmentError
  /// where the file system refuses.
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
