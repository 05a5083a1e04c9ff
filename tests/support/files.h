// Files that tests read, and what is said of those that are refused.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "core/error.h"

namespace polycube::files {

/// The message of the InvalidInput that the call throws, or "accepted".
inline std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

/// A file that goes with the test.
class TestFile {
 public:
  explicit TestFile(const std::string& name) : path_(std::filesystem::path(::testing::TempDir()) / (std::to_string(getpid()) + "-" + name)) {}
  TestFile(const std::string& name, const std::string& content) : TestFile(name) { write(content); }
  ~TestFile() { std::filesystem::remove(path_); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
  std::string path() const { return path_.string(); }
  void write(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }
  std::string read() const {
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace polycube::files
