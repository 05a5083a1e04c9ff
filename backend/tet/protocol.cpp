#include "tet/worker/protocol.h"

#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace polycube {
namespace {

constexpr std::uint64_t kMagic = 0x32746574636c6f70;  // distinguishes a whole file from any other
constexpr std::uint64_t kEnd = ~kMagic;

/// The classification is two ints, the coordinates doubles: every element is written as it lies in memory. Both ends are the same machine.
template <class T>
void put(std::ofstream& out, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

template <class T>
void get(std::ifstream& in, std::vector<T>& values) {
  std::uint64_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  if (!in || count > std::numeric_limits<std::int32_t>::max()) throw std::runtime_error("the worker's mesh is cut short");
  values.resize(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
  if (!in) throw std::runtime_error("the worker's mesh is cut short");
}

static_assert(std::is_trivially_copyable_v<CadRef> && sizeof(Vec3) == 3 * sizeof(double));

template <class Mesh, class Visit>
void visit_members(Mesh& mesh, Visit visit) {
  visit(mesh.points), visit(mesh.point_entity), visit(mesh.segments), visit(mesh.segment_tag);
  visit(mesh.triangles), visit(mesh.triangle_tag), visit(mesh.tets), visit(mesh.tet_tag);
}

}  // namespace

void write_setting(const WorkerSetting& setting, const std::string& path) {
  std::ofstream out(path);
  out.precision(17);
  out << setting.surface_algorithm << ' ' << setting.volume_algorithm << ' ' << setting.heal << ' ' << setting.size << ' ' << setting.min_size;
  for (const std::vector<double>* sizes : {&setting.edge_size, &setting.face_size}) {
    out << '\n' << sizes->size();
    for (const double size : *sizes) out << ' ' << size;
  }
  out << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

WorkerSetting read_setting(const std::string& path) {
  std::ifstream in(path);
  WorkerSetting setting;
  in >> setting.surface_algorithm >> setting.volume_algorithm >> setting.heal >> setting.size >> setting.min_size;
  for (std::vector<double>* sizes : {&setting.edge_size, &setting.face_size}) {
    std::size_t count = 0;
    in >> count;
    if (!in) break;
    sizes->resize(count);
    for (double& size : *sizes) in >> size;
  }
  if (!in) throw std::runtime_error("cannot read the setting " + path);
  return setting;
}

void write_raw(const RawMesh& mesh, const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&kMagic), sizeof kMagic);
  visit_members(mesh, [&](const auto& values) { put(out, values); });
  out.write(reinterpret_cast<const char*>(&kEnd), sizeof kEnd);
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

RawMesh read_raw(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::uint64_t mark = 0;
  in.read(reinterpret_cast<char*>(&mark), sizeof mark);
  if (!in || mark != kMagic) throw std::runtime_error("the worker wrote no mesh");
  RawMesh mesh;
  visit_members(mesh, [&](auto& values) { get(in, values); });
  in.read(reinterpret_cast<char*>(&mark), sizeof mark);
  if (!in || mark != kEnd) throw std::runtime_error("the worker's mesh is cut short");
  return mesh;
}

}  // namespace polycube
