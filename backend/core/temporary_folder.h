// Folders for files that only one run needs.
#pragma once

#include <filesystem>
#include <string>

namespace polycube {

/// A folder of its own under the system's temporary one, removed at the end. Of a process that was killed the next one removes it: while its process lives
/// a folder holds a file, kOwner, under a lock of flock(2), and one whose lock is free belongs to nobody.
class TemporaryFolder {
 public:
  static constexpr const char* kOwner = "polycube.owner";

  /// Throws InvalidInput where the folder cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path() const { return path_.string(); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
  int owner_ = -1;  ///< descriptor of the locked file
};

}  // namespace polycube
