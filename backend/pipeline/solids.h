// Several solids, each meshed by itself.
#pragma once

#include "cad/assembly.h"
#include "core/options.h"

namespace polycube {

/// What the options ask of one solid (from 1) of an assembly: its share of the cells, no size larger than itself, and of faces, edges and solids only its own.
MeshOptions options_of_solid(const MeshOptions& options, const Assembly& assembly, int solid);

/// Sizes and layers that are asked for by solid, as those of the only solid there is.
MeshOptions without_solids(const MeshOptions& options);

/// Solids that go into one mesh with common nodes: those that touch, directly or through others; else each by itself.
std::vector<std::vector<int>> units_of(const Assembly& assembly, const MeshOptions& options);

/// Throws InvalidInput where a demand is on faces of two solids.
void check_by_solid(const MeshOptions& options, const Assembly& assembly);

}  // namespace polycube
