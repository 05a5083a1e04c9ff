// From Gmsh's mesh and tags to a TetMesh with FreeCAD's numbers.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "core/mesh.h"
#include "tet/worker/protocol.h"

namespace polycube {

/// A mesh that cannot be used; the next setting may do better.
class Unusable : public std::runtime_error {
 public:
  explicit Unusable(const std::string& reason, std::vector<CadRef> at_fault = {}) : std::runtime_error(reason), entities(std::move(at_fault)) {}
  std::vector<CadRef> entities;
};

/// Finds by geometry which CAD entity each Gmsh entity is, orients the tets, takes the boundary from them and classifies it.
/// Throws Unusable: an entity is missing or doubled, a boundary facet is not classified, a tet has no volume.
TetMesh classify(const RawMesh& raw, const CadModel& model);

/// The same of several solids in one mesh: `whole` has the entities of all, `solids` are in the order of TetMesh::tet_solid.
TetMesh classify(const RawMesh& raw, const CadModel& whole, const std::vector<CadModel>& solids);

/// The tets of one solid with all of their boundary; `points`, if not null, gets the point of `mesh` that each of its points is.
TetMesh tets_of_solid(const TetMesh& mesh, int solid, std::vector<int>* points = nullptr);

/// Throws Unusable unless every CAD vertex has its node, every edge with a length its segments, every face its triangles, and the boundary the
/// Euler characteristic of the CAD's.
void check_complete(const TetMesh& mesh, const CadModel& model);

/// Facets that belong to one tet only, outward, in the order of the tets. Throws Unusable where more than two tets share one.
std::vector<Triangle> boundary_facets(const std::vector<Tet>& tets);

double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace polycube
