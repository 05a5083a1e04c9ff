// Layers, divisions and local sizes (MeshOptions) as constraints of the quantization, and whether the mesh has them.
#pragma once

#include "blocks/blocks.h"
#include "cad/cad.h"
#include "core/options.h"
#include "hex/spacing.h"
#include "quantize/quantize.h"

namespace polycube {

/// Throws InvalidInput where the mesh cannot have a division: the edge is a seam or a point, the two faces are one.
void check_divisions(const CadModel& model, const Divisions& divisions);
void check_biases(const CadModel& model, const EdgeBiases& biases);
void check_refinements(const CadModel& model, const LocalRefinements& refinements);

/// `options` in the pose of the map; `scale`: cells per unit of the map. Throws StageFailed("quantize", ...) naming the entities when these
/// blocks cannot keep a demand: faces that are nowhere opposite each other, an edge that does not run along the axes.
QuantizeOptions quantize_options(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, const MeshOptions& options,
                                 double scale);

/// Puts the cells along the edges of `bias` into geometric series. Throws StageFailed("quantize", ...) where the grid does not follow one.
void bias_edges(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, const EdgeBiases& biases,
                const std::vector<int>& value, Spacing& spacing);

/// Fewer divisions where padding made more of them than were asked for, so that they come out right the next time; the same where nothing can
/// be done about it.
Divisions allow_for_padding(const HexMesh& mesh, const Association& association, const Divisions& divisions);

/// One line per division that the mesh does not have (padding adds cells where it must).
std::vector<std::string> unmet_divisions(const HexMesh& mesh, const Association& association, const Divisions& divisions);

}  // namespace polycube
