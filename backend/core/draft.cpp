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

// The file itself, where the target is a link to one.
fs::path resolved(const std::string& target) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(target), error);
  return error ? fs::absolute(target) : real;
}

}  // namespace

Draft::Draft(const std::string& target) : target_(resolved(target).string()), draft_(draft_path(target_, getpid())) {}

Draft::~Draft() {
  std::error_code ignored;
  fs::remove(draft_, ignored);
}

void Draft::discard(const std::string& target, int process) {
  std::error_code ignored;
  fs::remove(draft_path(resolved(target), process), ignored);
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
  const fs::path folder = resolved(target).parent_path();
  if (!fs::is_directory(folder)) throw InvalidInput(target + ": the folder does not exist");
  if (fs::is_directory(target)) throw InvalidInput(target + " is a folder");
  if (fs::exists(target) && !fs::is_regular_file(target)) throw InvalidInput(target + " is no regular file");
  if (access(folder.c_str(), W_OK) != 0) throw InvalidInput(target + ": the folder is not writable");
}

void check_apart(const std::vector<std::string>& targets, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (const std::string& input : inputs) {
      if (resolved(targets[i]) == resolved(input)) throw InvalidInput(targets[i] + " would be written over: it is read too");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (resolved(targets[i]) == resolved(targets[k])) throw InvalidInput(targets[i] + " is to be written twice");
    }
  }
}

}  // namespace polycube
