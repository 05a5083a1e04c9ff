// The boundary cut into regions that are labelled as a whole, with the arcs between them and the junctions where arcs meet.
#pragma once

#include "core/mesh.h"

namespace polycube {

/// A connected set of triangles of one CAD face that keep one label.
struct Region {
  int face = 0;                  ///< CAD face
  double area = 0;               ///< mm^2
  std::array<double, 6> data{};  ///< cost of each label
  Vec3 normal = Vec3::Zero();    ///< where it faces on the whole, in the frame of the labels, unit; zero: not known
  std::vector<int> triangles;
};

/// A maximal chain of mesh edges between two regions, `left` on its left seen from outside.
struct Arc {
  int left = 0, right = 0;
  std::vector<int> nodes;     ///< mesh points in order; first == last for a closed chain
  std::vector<char> cad_dim;  ///< per node: 0 at a CAD vertex, 1 on a CAD edge, 2 inside a face
  double length = 0;          ///< mm
  double angle = 0;           ///< mean interior dihedral angle, radians
  double weight = 0;          ///< cost per mm of a label change here
  int start = -1, end = -1;   ///< junctions; -1 for a closed chain
};

/// A mesh point where three or more regions meet.
struct Junction {
  int node = 0;
  /// Outgoing darts, counter-clockwise seen from outside: 2 * arc (leaving at its start) or 2 * arc + 1 (leaving backwards at its end).
  std::vector<int> darts;
};

struct RegionGraph {
  std::vector<Region> regions;
  std::vector<int> triangle_region;
  std::vector<Arc> arcs;
  std::vector<Junction> junctions;
};

/// Left and right region of a dart.
inline int dart_left(const RegionGraph& g, int d) { return d % 2 == 0 ? g.arcs[d / 2].left : g.arcs[d / 2].right; }
inline int dart_right(const RegionGraph& g, int d) { return d % 2 == 0 ? g.arcs[d / 2].right : g.arcs[d / 2].left; }

/// `triangle_region`: region number of each triangle, connected sets, 0-based without gaps. Fills everything but Region::data, Region::normal and Arc::weight.
RegionGraph build_region_graph(const TetMesh& mesh, const std::vector<int>& triangle_region);

}  // namespace polycube
