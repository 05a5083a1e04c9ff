#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "fem/formats.h"

namespace polycube {
namespace {

namespace fs = std::filesystem;

enum class Format { kInp, kUnv, kVtu, kMed, kMedit };

Format format_of(const std::string& path) {
  const std::string suffix = fs::path(path).extension().string();
  if (suffix == ".inp") return Format::kInp;
  if (suffix == ".unv") return Format::kUnv;
  if (suffix == ".vtu") return Format::kVtu;
  if (suffix == ".med") return Format::kMed;
  if (suffix == ".mesh") return Format::kMedit;
  throw InvalidInput(path + ": the suffix of a mesh file must be .inp, .unv, .vtu, .med or .mesh");
}

std::string text_of(const FemMesh& mesh, Format format, const std::string& element_type) {
  switch (format) {
    case Format::kInp:
      return inp_text(mesh, element_type);
    case Format::kUnv:
      return unv_text(mesh);
    case Format::kVtu:
      return vtu_text(mesh);
    default:
      return medit_text(mesh);
  }
}

/// A file beside the target that takes its name only when complete.
class Draft {
 public:
  explicit Draft(const fs::path& target)
      : target_(target), draft_(target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) + ".part")) {}
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft() {
    std::error_code ignored;
    fs::remove(draft_, ignored);
  }
  std::string path() const { return draft_.string(); }
  void publish() { fs::rename(draft_, target_); }

 private:
  fs::path target_, draft_;
};

}  // namespace

std::string group_name(const FemGroup& group) { return name(group.entity); }
std::string node_group_name(const FemGroup& group) { return name(group.entity) + "_Nodes"; }

void append(std::string& text, const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text.append(line, static_cast<std::size_t>(std::min<int>(length, sizeof line - 1)));
}

void check_output(const std::string& path) {
  format_of(path);
  const fs::path folder = fs::absolute(path).parent_path();
  if (!fs::is_directory(folder)) throw InvalidInput(path + ": the folder does not exist");
  if (fs::is_directory(path)) throw InvalidInput(path + " is a folder");
  if (access(folder.c_str(), W_OK) != 0) throw InvalidInput(path + ": the folder is not writable");
}

void write(const FemMesh& mesh, const std::string& path, const std::string& element_type, const Monitor& monitor) {
  check_output(path);
  monitor.progress("write", 0);
  const Format format = format_of(path);
  Draft draft(fs::absolute(path));
  try {
    if (format == Format::kMed) {
      write_med(mesh, draft.path());
    } else {
      std::ofstream file(draft.path(), std::ios::binary);
      file << text_of(mesh, format, element_type);
      file.close();
      if (!file) throw std::runtime_error("disk full or not writable");
    }
    monitor.check();
    draft.publish();
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& e) {
    throw InvalidInput(path + " cannot be written: " + e.what());
  }
  monitor.progress("write", 1);
}

}  // namespace polycube
