// Mesh value types. Plain vectors; indices are 0-based, CAD numbers 1-based as in FreeCAD.
#pragma once

#include <string>
#include <utility>

#include "core/types.h"

namespace polycube {

using Tet = std::array<int, 4>;
using Triangle = std::array<int, 3>;
using Quad = std::array<int, 4>;
using Hex = std::array<int, 8>;
using Segment = std::array<int, 2>;

/// Tetrahedra of a solid with their classification on the CAD model.
/// A tet is positive: (p1-p0) x (p2-p0) . (p3-p0) > 0. A triangle's normal points out of the solid.
struct TetMesh {
  std::vector<Vec3> points;
  std::vector<CadRef> point_cad;  ///< per point: the lowest-dimensional CAD entity it stands on
  std::vector<Tet> tets;
  std::vector<Triangle> triangles;  ///< all boundary facets of the tets
  std::vector<int> triangle_face;   ///< per triangle: CAD face
  std::vector<Segment> segments;    ///< mesh edges that lie on CAD edges
  std::vector<int> segment_edge;    ///< per segment: CAD edge

  // Of several solids in one mesh also what lies between them; the members above know their outer boundary only, and points between solids count as inside.
  std::vector<int> tet_solid{};                       ///< per tet: index of its solid; empty for one solid
  std::vector<Triangle> inner_triangles{};            ///< facets between two solids; the normal points out of the one with the lower index
  std::vector<int> inner_face{};                      ///< per inner triangle: CAD face
  std::vector<Segment> inner_segments{};              ///< mesh edges that lie on CAD edges and not on the outer boundary
  std::vector<int> inner_segment_edge{};              ///< per inner segment: CAD edge
  std::vector<std::pair<int, int>> inner_vertices{};  ///< points at CAD vertices that are not on the outer boundary, and these
};

/// A connected set of boundary triangles with one label, or (sign 0) a feature: nodes that share one coordinate.
struct Chart {
  int axis = 0;                ///< 0, 1, 2: the coordinate of the map that is constant on it
  int sign = 0;                ///< +1 / -1: which way it faces; 0: a feature inside other charts
  std::vector<int> triangles;  ///< indices into TetMesh::triangles; empty for a feature
  std::vector<int> nodes;      ///< sorted point indices
  double value = 0;            ///< the constant coordinate, in units of the map
};

/// A polycuboid map: tets, their images, and the charts (features included) that are axis-aligned planes of the image.
struct PolycuboidMap {
  std::vector<Vec3> image;  ///< per point of the tet mesh; the coordinate chart.axis of every chart.nodes is exactly chart.value
  std::vector<Chart> charts;
};

/// Hexahedra with their boundary.
/// Corner order of a hex is VTK's (see core/hexahedron.h); a quad's normal points out of the solid.
struct HexMesh {
  std::vector<Vec3> points;
  std::vector<Hex> hexes;
};

/// What the boundary of a HexMesh stands for on the CAD model.
/// A patch is a set of CAD faces that the mesh does not tell apart: one face where all its edges are captured, several where an edge
/// between them is not. Together the patches hold every CAD face once.
struct Association {
  std::vector<std::vector<int>> patches;  ///< CAD faces of each patch, ascending
  std::vector<Quad> quads;                ///< all boundary quads of the mesh, outward
  std::vector<int> quad_patch;            ///< per quad: index into patches
  std::vector<Segment> segments;          ///< mesh edges that stand for a piece of a CAD edge
  std::vector<int> segment_edge;          ///< per segment: CAD edge
  std::vector<CadRef> point_cad;          ///< per mesh point: {0, vertex}, {1, edge}, {2, index into patches}, or {3, 1} inside
  std::vector<int> lost_edges;            ///< CAD edges without a chain of mesh edges (seams, degenerate and ignored edges not counted)
  std::vector<int> lost_vertices;         ///< CAD vertices without a node, ignored ones not counted
  std::vector<int> ignored_edges;         ///< CAD edges that were to be left out
  std::vector<int> ignored_vertices;      ///< CAD vertices on ignored edges only
  std::vector<int> ignored_faces;         ///< CAD faces in patches of several that ignored edges alone join
};

}  // namespace polycube
