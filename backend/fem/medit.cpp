// Medit ASCII mesh, corners only (the format has no 20-node hexahedron). References are CAD numbers.
#include "fem/formats.h"

namespace polycube {

std::string medit_text(const FemMesh& mesh) {
  std::string text = "MeshVersionFormatted 2\nDimension 3\n";
  std::vector<int> corners;
  for (const FemGroup& group : mesh.groups)
    if (group.entity.dim == 0)
      for (int node : group.nodes) corners.push_back(node);
  append(text, "Vertices\n%d\n", mesh.corner_count);
  for (int p = 0; p < mesh.corner_count; ++p) append(text, "%.17g %.17g %.17g 0\n", mesh.points[p][0], mesh.points[p][1], mesh.points[p][2]);
  if (!corners.empty()) {
    append(text, "Corners\n%zu\n", corners.size());
    for (int corner : corners) append(text, "%d\n", corner + 1);
  }
  if (!mesh.segments.empty()) {
    append(text, "Edges\n%zu\n", mesh.segments.size());
    for (std::size_t s = 0; s < mesh.segments.size(); ++s) append(text, "%d %d %d\n", mesh.segments[s][0] + 1, mesh.segments[s][1] + 1, mesh.segment_edge[s]);
  }
  append(text, "Quadrilaterals\n%zu\n", mesh.quads.size());
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    for (int i = 0; i < 4; ++i) append(text, "%d ", mesh.quads[q][i] + 1);
    append(text, "%d\n", mesh.quad_face[q]);
  }
  append(text, "Hexahedra\n%zu\n", mesh.hexes.size());
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    for (int i = 0; i < 8; ++i) append(text, "%d ", mesh.hexes[h][i] + 1);
    append(text, "%d\n", mesh.hex_solid.empty() ? 1 : mesh.hex_solid[h]);
  }
  text += "End\n";
  return text;
}

}  // namespace polycube
