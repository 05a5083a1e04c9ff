// Bounds from below that the part itself asks for, as constraints of the quantization: cells enough through walls and round circles, none too long.
#pragma once

#include "blocks/blocks.h"
#include "cad/cad.h"
#include "core/options.h"
#include "pipeline/circles.h"
#include "quantize/quantize.h"

namespace polycube {

/// All of them may yield to what is demanded by name. `options` in the pose of the map; `edge_chains`: tet mesh points along every CAD edge, empty for those
/// that the map does not follow; `more`: per round edge, elements above those that its turning asks for, where the grid gave it fewer; `levels`: edges at which
/// cells are divided later.
std::vector<DistanceConstraint> part_bounds(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                                            const std::vector<std::vector<int>>& edge_chains, const MeshOptions& options, const std::map<int, int>& more = {},
                                            const EdgeLevels& levels = {});

/// More bounds, by what the integers give: cells of a block that grow from smaller ones beside it by `growth` at most, and none longer than 10 times its width.
/// Cells far thinner than `size` (units of the map) count as no thinner than a share of it; a smaller share where places are refined locally (`local`): the
/// cells there are divided again, and have to be as small across as along. Empty where the bounds hold.
std::vector<DistanceConstraint> neighbour_bounds(const PolycuboidMap& map, const BlockComplex& blocks, const std::vector<int>& value, double growth,
                                                 double size, bool local = false);

/// Names of the constraints that the integers just meet and that ask for more than `scale` (cells per unit of the map) would give, each once.
std::vector<std::string> deciding(const std::vector<DistanceConstraint>& constraints, const PolycuboidMap& map, const std::vector<int>& value, double scale);

}  // namespace polycube
