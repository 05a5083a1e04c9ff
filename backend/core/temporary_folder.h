// Folders for files that only one run needs.
#pragma once

#include <filesystem>
#include <string>

namespace polycube {

/// A folder of its own under the system's temporary one, removed at the end.
class TemporaryFolder {
 public:
  /// Throws std::runtime_error where the folder cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path() const { return path_.string(); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace polycube
