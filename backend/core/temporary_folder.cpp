#include "core/temporary_folder.h"

#include <stdlib.h>

#include <system_error>

#include "core/error.h"

namespace polycube {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw InvalidInput("the folder for temporary files, TMPDIR, does not exist");
  std::string pattern = (parent / "polycube-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw InvalidInput("no folder can be made in that for temporary files, " + parent.string() + "; TMPDIR names another");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace polycube
