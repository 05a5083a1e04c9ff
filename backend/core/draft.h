// Files that appear complete or not at all.
#pragma once

#include <string>
#include <vector>

namespace polycube {

/// A file beside the target that takes its name with publish(); without that it is removed. Of a link the file that it leads to is replaced.
class Draft {
 public:
  explicit Draft(const std::string& target);
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft();
  /// Where to write.
  const std::string& path() const { return draft_; }
  /// Throws std::filesystem::filesystem_error.
  void publish();
  /// Removes what a process that was killed left of its draft for the target.
  static void discard(const std::string& target, int process);

 private:
  std::string target_, draft_;
};

/// Writes the text by way of a Draft. Throws InvalidInput naming the target.
void write_text(const std::string& target, const std::string& text);

/// Throws InvalidInput where the target's folder is missing or not writable, or the target is a folder, a device or the like. For a check before the work.
void check_writable(const std::string& target);

/// Throws InvalidInput where two targets are one file, or a target is a file that is read.
void check_apart(const std::vector<std::string>& targets, const std::vector<std::string>& inputs);

}  // namespace polycube
