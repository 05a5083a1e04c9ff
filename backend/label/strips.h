// Room beside edges on barrels: where an edge comes close to the line at 45 degrees, or goes beyond it, the line is no place for a border of charts.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "label/regions.h"

namespace polycube {

/// A part of a barrel between the line at 45 degrees and a generator that leaves room beside an edge: it shall have the label of the side that the edge is on.
struct Strip {
  int face = 0;
  std::array<Vec3, 2> generator;  ///< directions from the axis: at 45 degrees, beside the edge
  int label = 0;                  ///< of the side that the edge is on
};

/// The strips of a cylinder or cone: one for each place where edges of the face turn back round its axis (the widest place of an arm or a bore of not much
/// less than the barrel's own radius), two for each vertex close to the line, one in the gap beside the side of a claw, an edge along a generator near the line
/// that the barrel goes round at its end; two at the ends of an arc that with one other edge bounds a plane, and is too short to have more labels than one: a
/// chart has four corners. `frame` rows are the axes, `size` is the length of a triangle's side.
std::vector<Strip> find_strips(const CadModel& model, const Mat3& frame, int face, double size);

/// The strips of a part.
struct Room {
  std::vector<Strip> strips;
  TetMesh mesh;             ///< cut along their generators: narrow strips would fall to pieces otherwise
  bool on(int face) const;  ///< are there any on this face?
};
/// `divided`: per CAD face, whether it may have more labels than one.
Room make_room(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const std::vector<char>& divided, const Monitor& monitor);

/// Makes the labels of the triangles change on the line at 45 degrees exactly, beside strips. `label` per triangle.
void settle_lines(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const Room& room, std::vector<int>& label);

/// Gives all strips to the side of their edge, at what the label they had costs there: the search shall not take them back for their normals' sake. Regions
/// that may not have the label of that side keep theirs.
void give_strips(const CadModel& model, const TetMesh& mesh, const Room& room, RegionGraph& graph, std::vector<int>& label);

}  // namespace polycube
