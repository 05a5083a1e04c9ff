#include "job/npz.h"

#include <zip.h>

#include <bit>
#include <cstdint>
#include <memory>

#include "core/error.h"

namespace polycube {
namespace {

// The header of NumPy's file format 1.0 ends at a multiple of this, so that the data can be mapped into memory.
constexpr std::size_t kAlignment = 64;

/// One array in NumPy's file format, https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
template <typename Element>
std::string npy(const char* kind, const std::vector<Element>& flat, const std::vector<std::size_t>& shape) {
  std::string tuple;
  for (std::size_t length : shape) tuple += std::to_string(length) + ",";
  const char* order = std::endian::native == std::endian::little ? "<" : ">";
  std::string header = std::string("{'descr': '") + order + kind + "', 'fortran_order': False, 'shape': (" + tuple + "), }";
  std::string file("\x93NUMPY\x01\x00", 8);
  const std::size_t start = file.size() + 2;  // the header's length is two bytes
  header.append(kAlignment - 1 - (start + header.size()) % kAlignment, ' ').push_back('\n');
  const auto length = static_cast<std::uint16_t>(header.size());
  file.push_back(static_cast<char>(length & 0xff));
  file.push_back(static_cast<char>(length >> 8));
  file += header;
  return file.append(reinterpret_cast<const char*>(flat.data()), flat.size() * sizeof(Element));
}

}  // namespace

static_assert(sizeof(int) == 4 && sizeof(double) == 8);

void Npz::add(const std::string& name, const std::vector<int>& flat, const std::vector<std::size_t>& shape) {
  files_.emplace_back(name + ".npy", npy("i4", flat, shape));
}

void Npz::add(const std::string& name, const std::vector<double>& flat, const std::vector<std::size_t>& shape) {
  files_.emplace_back(name + ".npy", npy("f8", flat, shape));
}

void Npz::write(const std::string& path) const {
  int code = 0;
  zip_t* opened = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  if (!opened) throw InvalidInput(path + " cannot be written");
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive(opened, zip_discard);
  const auto fail = [&] { return InvalidInput(path + " cannot be written: " + zip_strerror(archive.get())); };
  for (const auto& [name, content] : files_) {
    zip_source_t* source = zip_source_buffer(archive.get(), content.data(), content.size(), 0);
    if (!source) throw fail();
    const zip_int64_t index = zip_file_add(archive.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      throw fail();
    }
    // Numbers hardly shrink, and the file is read once.
    if (zip_set_file_compression(archive.get(), static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0) != 0) throw fail();
  }
  if (zip_close(archive.get()) != 0) throw fail();
  static_cast<void>(archive.release());  // zip_close has freed it
}

}  // namespace polycube
