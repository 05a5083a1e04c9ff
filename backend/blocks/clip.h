// Cutting one tetrahedron's image by axis-aligned planes.
#pragma once

#include <vector>

#include "core/types.h"

namespace polycube {

/// Convex polyhedron as outward face loops into a shared pool of points.
/// A point with coordinate <= c counts as below the plane at c, so a plane stands for "just above c": no case is degenerate, pieces of
/// no volume take the place of coincidences, and two tets cut their common face into the same pieces.
struct Polyhedron {
  std::vector<int> loops;   ///< vertex indices of all faces, one after the other
  std::vector<int> starts;  ///< per face its first entry in loops; one more at the end
  std::vector<int> tags;    ///< per face: 0..3 facet of the tet, 4 + 2 * axis + (0 low, 1 high) a cut

  void clear() {
    loops.clear();
    starts.assign(1, 0);
    tags.clear();
  }
  void close_face(int tag) {
    starts.push_back(static_cast<int>(loops.size()));
    tags.push_back(tag);
  }
};

/// Reuses its memory from tet to tet.
class TetClipper {
 public:
  /// Loads the image of a tet. Facets are outward when the tet is positive; else every volume and area comes out negative.
  void load(const std::array<Vec3, 4>& corners);
  const Polyhedron& whole() const { return whole_; }
  /// Splits `in`; either result may be empty.
  void split(const Polyhedron& in, int axis, double value, Polyhedron& below, Polyhedron& above);
  /// Six times the signed volume.
  double volume6(const Polyhedron& p) const;
  /// Twice the signed area of a face seen along +axis.
  double area2(const Polyhedron& p, int face, int axis) const;

 private:
  int crossing(int below, int above, int axis, double value);

  std::vector<Vec3> points_;
  Polyhedron whole_;
  std::vector<std::array<int, 3>> cuts_;  ///< below, above, point on the plane
  std::vector<std::array<int, 2>> next_;  ///< edges of the cut's outline
};

}  // namespace polycube
