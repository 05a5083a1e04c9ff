// Meshes of several solids in one.
#pragma once

#include "cad/assembly.h"
#include "fem/fem.h"

namespace polycube {

/// One mesh of all: each part keeps nodes of its own and the order of its nodes, cells, quads and segments. Part i is of the solid numbers[i], where it is of
/// one solid. Groups of an entity that several parts share hold what each has there; what each has there is in groups of its own too, and so are the two sides
/// of every interface between parts.
FemMesh join(const std::vector<FemMesh>& parts, const std::vector<int>& numbers, const std::vector<Interface>& interfaces);

}  // namespace polycube
