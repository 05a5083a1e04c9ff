#include "core/temporary_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

#include "core/error.h"

namespace polycube {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "polycube-";

/// Removes the folders of processes that were killed.
void clear_abandoned(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator it(parent, fs::directory_options::skip_permission_denied, error); !error && it != fs::directory_iterator(); it.increment(error)) {
    if (it->path().filename().string().rfind(kPrefix, 0) != 0) continue;
    const int owner = open((it->path() / TemporaryFolder::kOwner).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (owner < 0) continue;  // somebody else's, or none of ours
    std::error_code ignored;
    struct stat own {};
    if (fstat(owner, &own) == 0 && own.st_uid == geteuid() && flock(owner, LOCK_EX | LOCK_NB) == 0) fs::remove_all(it->path(), ignored);
    close(owner);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) throw InvalidInput("the folder for temporary files, TMPDIR, does not exist");
  clear_abandoned(parent);
  std::string pattern = (parent / (std::string(kPrefix) + "XXXXXX")).string();
  if (!mkdtemp(pattern.data())) throw InvalidInput("no folder can be made in that for temporary files, " + parent.string() + "; TMPDIR names another");
  path_ = pattern;
  // Under its name only once it is locked: others take a free lock for that of a dead process.
  const fs::path draft = path_ / (std::string(kOwner) + ".new");
  owner_ = open(draft.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (owner_ >= 0 && flock(owner_, LOCK_EX | LOCK_NB) == 0) fs::rename(draft, path_ / kOwner, error);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (owner_ >= 0) close(owner_);
}

}  // namespace polycube
