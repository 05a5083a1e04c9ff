// Where a finished mesh has fewer cells than the part asks for.
#pragma once

#include <string>

#include "cad/cad.h"
#include "core/demands.h"
#include "core/mesh.h"
#include "core/report.h"

namespace polycube {

/// Walls with fewer cells through them, and circles with fewer mesh edges round them; one line each, such as "Face3-Face7: 1 element through the wall, not 2".
struct Shortfalls {
  std::vector<std::string> thin_walls;      ///< pairs of patches whose quads look away from each other at the two ends of a column of cells
  std::vector<std::string> coarse_circles;  ///< CAD edges; lost ones are told as lost
};

/// Mesh edges on each CAD edge, by its number.
std::vector<int> elements_on_edges(const Association& association, int edge_count);

Shortfalls find_shortfalls(const CadModel& model, const HexMesh& mesh, const Association& association, int min_layers, int per_circle);

/// One line for every size of a CAD face, or of the solid, that the cells there do not have, such as "size Face3=0.5: the cells there are 1.3 mm long": a sheet
/// of cells goes on through what may want others.
std::vector<std::string> unmet_sizes(const HexMesh& mesh, const Association& association, const LocalSizes& sizes);

/// One line for every patch whose faces edges that are ignored on demand join.
std::vector<std::string> merged_faces(const CadCapture& capture, const Association& association);

}  // namespace polycube
