#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <filesystem>

#include "core/draft.h"
#include "core/error.h"
#include "fem/formats.h"

namespace polycube {
namespace {

enum class Format { kInp, kUnv, kVtu, kMed, kMedit };

Format format_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == ".inp") return Format::kInp;
  if (suffix == ".unv") return Format::kUnv;
  if (suffix == ".vtu") return Format::kVtu;
  if (suffix == ".med") return Format::kMed;
  if (suffix == ".mesh") return Format::kMedit;
  throw InvalidInput(path + ": the suffix of a mesh file must be .inp, .unv, .vtu, .med or .mesh");
}

}  // namespace

std::string node_group_name(const FemGroup& group) { return group_name(group) + "_Nodes"; }

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
  check_writable(path);
}

void write(const FemMesh& mesh, const std::string& path, const std::string& element_type, const Monitor& monitor) {
  check_output(path);
  monitor.progress("write", 0);
  switch (format_of(path)) {
    case Format::kInp:
      write_text(path, inp_text(mesh, element_type));
      break;
    case Format::kUnv:
      write_text(path, unv_text(mesh));
      break;
    case Format::kVtu:
      write_text(path, vtu_text(mesh));
      break;
    case Format::kMedit:
      write_text(path, medit_text(mesh));
      break;
    case Format::kMed:
      try {
        Draft draft(path);
        write_med(mesh, draft.path(), std::filesystem::path(path).stem().string());
        draft.publish();
      } catch (const std::exception& e) {
        throw InvalidInput(path + " cannot be written: " + e.what());
      }
      break;
  }
  if (monitor.on_progress) monitor.on_progress("write", 1);
}

}  // namespace polycube
