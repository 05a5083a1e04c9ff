// What is asked of faces and edges of solids that touch: by the numbers of the assembly, on what these became when the solids were joined.
#pragma once

#include <map>

#include "cad/conformal.h"
#include "core/error.h"
#include "pipeline/demands.h"

namespace polycube {

/// What of the options is of the joined solids: all of the assembly without what names faces and edges of others.
MeshOptions options_of_unit(const MeshOptions& options, const ConformalModel& model, const Assembly& assembly);

/// Throws InvalidInput where a demand cannot be met on any grid (a seam, a point, more cells than kMostHexes). `size`: where a solid has none of its own.
void check_demands(const MeshOptions& options, const ConformalModel& model, const Assembly& assembly, double size);

/// Per solid the labels of its joined faces, each as seen from there; an interface has its label, or the opposite one, in both of its solids. Throws
/// InvalidInput where its two sides are given labels that contradict each other, or where a face cannot have its label. `tets`: of all solids.
std::vector<FaceLabels> labels_by_solid(const FaceLabels& labels, const ConformalModel& model, const TetMesh& tets, const Mat3& frame);

/// Per joined edge whether the user does without it: smooth by feature_angle in every solid that has it, on no face to keep, and on no interface.
std::vector<char> ignored_edges(const MeshOptions& options, const ConformalModel& model);

/// Tet mesh points along every joined edge, on the outside or not; as edge_chains().
std::vector<std::vector<int>> all_edge_chains(const ConformalModel& model, const TetMesh& tets);

/// Faces and edges by the numbers of the assembly. `inner_chart`: per inner triangle of `tets` its chart among the last ones of the map.
DemandPlaces find_places(const ConformalModel& model, const Assembly& assembly, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                         const std::vector<int>& block_solid, const std::vector<int>& inner_chart);

/// What the faces, edges and vertices of the assembly became.
std::map<CadRef, std::vector<CadRef>> pieces_of(const ConformalModel& model);

/// The association of a solid's mesh by the numbers of the assembly; 0 for edges that joining made.
Association by_origin(const Association& association, const Origin& origin);

/// The same failure with the entities' numbers of the joined model, and back.
StageFailed as_joined(const StageFailed& failure, const ConformalModel& model);
StageFailed by_origin(const StageFailed& failure, const ConformalModel& model);

}  // namespace polycube
