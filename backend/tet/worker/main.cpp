// polycube-tet PART.brep SETTING MESH: one attempt of Gmsh in a process of its own, so that a hang or a crash of Gmsh or OCCT ends here.
// Exit status 0: MESH was written. 1: not; one line on standard error says why.
#include <gmsh.h>
#include <signal.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <unordered_map>

#include "tet/worker/protocol.h"

namespace polycube {
namespace {

/// Gmsh's state is global; this is its one owner.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize();
    set("General.Terminal", 0);
    set("General.NumThreads", 1);
    // Errors are kept for the report; whether the mesh can be used all the same is for the stage to judge.
    set("General.AbortOnError", 0);
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
  void set(const std::string& option, double value) { gmsh::option::setNumber(option, value); }
};

/// Sizes by CAD entity; Gmsh's tags equal the CAD's unless healing renumbers, and then only the sizes suffer:
/// the stage itself finds out by geometry which entity is which.
double size_at(const WorkerSetting& setting, int dim, int tag) {
  const std::vector<double>* sizes = dim == 1 ? &setting.edge_size : dim == 2 ? &setting.face_size : nullptr;
  if (!sizes || tag < 1 || static_cast<std::size_t>(tag) > sizes->size()) return setting.size;
  return (*sizes)[static_cast<std::size_t>(tag - 1)];
}

RawMesh collect() {
  RawMesh mesh;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  std::unordered_map<std::size_t, int> index;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dim, tag] : entities) {
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, dim, tag, false, false);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      if (!index.emplace(tags[i], static_cast<int>(mesh.points.size())).second) continue;
      mesh.points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
      mesh.point_entity.push_back({dim, tag});
    }
  }
  const auto collect_elements = [&](int dim, int type, auto& elements, std::vector<int>& element_tags) {
    for (const auto& [entity_dim, tag] : entities) {
      if (entity_dim != dim) continue;
      std::vector<std::size_t> element_ids, nodes;
      gmsh::model::mesh::getElementsByType(type, element_ids, nodes, tag);
      const std::size_t corners = static_cast<std::size_t>(dim) + 1;
      for (std::size_t i = 0; i + corners <= nodes.size(); i += corners) {
        auto& element = elements.emplace_back();
        for (std::size_t k = 0; k < corners; ++k) element[k] = index.at(nodes[i + k]);
        element_tags.push_back(tag);
      }
    }
  };
  collect_elements(1, 1, mesh.segments, mesh.segment_tag);
  collect_elements(2, 2, mesh.triangles, mesh.triangle_tag);
  collect_elements(3, 4, mesh.tets, mesh.tet_tag);
  return mesh;
}

void run(const std::string& part, const WorkerSetting& setting, const std::string& output) {
  GmshSession session;
  gmsh::vectorpair shapes;
  if (setting.heal)
    for (const char* option :
         {"Geometry.OCCFixDegenerated", "Geometry.OCCFixSmallEdges", "Geometry.OCCFixSmallFaces", "Geometry.OCCSewFaces", "Geometry.OCCMakeSolids"})
      session.set(option, 1);
  gmsh::model::occ::importShapes(part, shapes, true, "brep");
  gmsh::model::occ::synchronize();
  session.set("Mesh.Algorithm", setting.surface_algorithm);
  session.set("Mesh.Algorithm3D", setting.volume_algorithm);
  session.set("Mesh.MeshSizeMin", setting.min_size);
  session.set("Mesh.MeshSizeMax", setting.size);
  session.set("Mesh.MeshSizeFromPoints", 0);
  // Newer versions of Gmsh add the size so far to the place; both are left to Gmsh.
  gmsh::model::mesh::setSizeCallback([&](int dim, int tag, auto...) { return size_at(setting, dim, tag); });
  gmsh::model::mesh::generate(3);
  const RawMesh mesh = collect();
  if (mesh.tets.empty()) {
    std::string error;
    gmsh::logger::getLastError(error);
    throw std::runtime_error(error.empty() ? "Gmsh made no tetrahedra" : "Gmsh: " + error);
  }
  try {
    write_raw(mesh, output);
  } catch (const std::runtime_error&) {
    std::_Exit(kCannotWrite);
  }
}

}  // namespace
}  // namespace polycube

int main(int argc, char** argv) {
  // Nobody else could stop a hanging attempt once the parent is gone.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is one that cannot be written
  try {
    if (argc != 4) throw std::runtime_error("usage: polycube-tet PART.brep SETTING MESH");
    polycube::run(argv[1], polycube::read_setting(argv[2]), argv[3]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "polycube-tet: " << error.what() << '\n';
  } catch (const std::string& error) {
    std::cerr << "polycube-tet: " << error << '\n';
  } catch (...) {
    std::cerr << "polycube-tet: unknown error\n";
  }
  return 1;
}
