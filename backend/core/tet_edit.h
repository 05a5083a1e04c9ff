// Local changes of a tet mesh that keep it conforming and classified.
#pragma once

#include <map>

#include "core/mesh.h"

namespace polycube {

/// Splits edges of a tet mesh. Holds a reference; the mesh must not be changed by others meanwhile.
class TetEditor {
 public:
  explicit TetEditor(TetMesh& mesh);

  /// Splits edge (a, b) at `point`; all tets, triangles and segments on it become two, those between solids too. Returns the new node. The new triangles are
  /// appended; triangle_parent() tells where they come from. The classification of the new node is the segment's, the triangles' face, or the solid's.
  int split_edge(int a, int b, const Vec3& point);

  /// Would all tets round (a, b) keep a positive volume?
  bool keeps_volumes(int a, int b, const Vec3& point) const;

  /// Moves a node unless a tet at it would lose nine tenths of its volume or more. Returns whether it did.
  bool move(int node, const Vec3& to);

  /// Is (a, b) a segment on a CAD edge?
  bool is_segment(int a, int b) const;

  const std::vector<int>& triangles_at(int node) const { return triangles_at_[node]; }

  /// Per triangle: the one it was split from, always before it; itself for those of the mesh as it was given.
  const std::vector<int>& triangle_parent() const { return parent_; }

 private:
  std::vector<int> around(const std::vector<std::vector<int>>& at, int a, int b) const;

  TetMesh& mesh_;
  std::vector<std::vector<int>> tets_at_, triangles_at_, inner_at_;  // per node
  std::map<Segment, int> segment_, inner_segment_;                   // sorted nodes -> index
  std::vector<int> parent_;
};

}  // namespace polycube
