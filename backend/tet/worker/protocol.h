// What tet and its worker process tell each other, through files in a private folder:
// the worker is called `polycube-tet PART.brep SETTING MESH`, reads the first two and writes the third.
#pragma once

#include <string>
#include <vector>

#include "core/mesh.h"

namespace polycube {

/// Exit status of the worker where its mesh could not be written: no other setting would help.
constexpr int kCannotWrite = 3;

/// One rung of the ladder with its sizes.
struct WorkerSetting {
  int surface_algorithm = 6;      ///< Gmsh's Mesh.Algorithm
  int volume_algorithm = 1;       ///< Gmsh's Mesh.Algorithm3D
  bool heal = false;              ///< OCCT's shape healing by Gmsh before meshing; may change the numbering
  double size = 0, min_size = 0;  ///< mm
  std::vector<double> edge_size;  ///< mm, per CAD edge
  std::vector<double> face_size;  ///< mm, per CAD face
};

/// Gmsh's mesh with Gmsh's own entity tags.
struct RawMesh {
  std::vector<Vec3> points;
  std::vector<CadRef> point_entity;  ///< Gmsh dimension and tag
  std::vector<Segment> segments;
  std::vector<int> segment_tag;
  std::vector<Triangle> triangles;
  std::vector<int> triangle_tag;
  std::vector<Tet> tets;
  std::vector<int> tet_tag;
};

/// Both pairs throw std::runtime_error when a file cannot be written or does not hold what it should.
void write_setting(const WorkerSetting& setting, const std::string& path);
WorkerSetting read_setting(const std::string& path);
void write_raw(const RawMesh& mesh, const std::string& path);
RawMesh read_raw(const std::string& path);

}  // namespace polycube
