// Room beside edges on barrels: where an edge comes close to the line at 45 degrees, or goes beyond it, the line is no place for a border of charts.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "label/regions.h"

namespace polycube {

/// A part of a barrel between the line at 45 degrees and a generator that leaves room beside an edge: it may take the label of the side that the edge is on.
struct Strip {
  int face = 0;
  std::array<Vec3, 2> generator;  ///< directions from the axis: at 45 degrees, beside the edge
  int label = 0;                  ///< of the side that the edge is on
};

/// The strips of a cylinder or cone: one for each place where edges of the face turn back round its axis (the widest place of an arm or a bore of not much
/// less than the barrel's own radius). `frame` rows are the axes, `size` is the length of a triangle's side.
std::vector<Strip> find_strips(const CadModel& model, const Mat3& frame, int face, double size);

/// Gives all strips to the side of their edge, at what the label they had costs there: the search shall not take them back for their normals' sake. Regions
/// that may not have the label of that side keep theirs.
void give_room(const CadModel& model, const TetMesh& mesh, const std::vector<Strip>& strips, RegionGraph& graph, std::vector<int>& label);

}  // namespace polycube
