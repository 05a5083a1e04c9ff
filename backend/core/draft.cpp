#include "core/draft.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/error.h"

namespace polycube {

namespace fs = std::filesystem;

namespace {

std::string draft_path(const fs::path& target, int process) {
  return (target.parent_path() / ("." + target.filename().string() + "." + std::to_string(process) + ".part")).string();
}

}  // namespace

Draft::Draft(const std::string& target) : target_(fs::absolute(target).string()), draft_(draft_path(target_, getpid())) {}

Draft::~Draft() {
  std::error_code ignored;
  fs::remove(draft_, ignored);
}

void Draft::discard(const std::string& target, int process) {
  std::error_code ignored;
  fs::remove(draft_path(fs::absolute(target), process), ignored);
}

void Draft::publish() { fs::rename(draft_, target_); }

void write_text(const std::string& target, const std::string& text) {
  try {
    Draft draft(target);
    std::ofstream file(draft.path(), std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("disk full or folder not writable");
    draft.publish();
  } catch (const std::exception& e) {
    throw InvalidInput(target + " cannot be written: " + e.what());
  }
}

void check_writable(const std::string& target) {
  const fs::path folder = fs::absolute(target).parent_path();
  if (!fs::is_directory(folder)) throw InvalidInput(target + ": the folder does not exist");
  if (fs::is_directory(target)) throw InvalidInput(target + " is a folder");
  if (access(folder.c_str(), W_OK) != 0) throw InvalidInput(target + ": the folder is not writable");
}

}  // namespace polycube
