// Layers, divisions and local sizes (MeshOptions) as constraints of the quantization, and whether the mesh has them.
#pragma once

#include <functional>
#include <optional>

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

/// Where the CAD faces and edges that demands name are among the blocks.
struct DemandPlaces {
  std::vector<std::array<std::vector<int>, 6>> side_faces;  ///< per block and side the CAD faces there, ascending
  std::vector<std::vector<int>> edge_chains;                ///< per CAD edge its tet mesh points, in order; the first again at the end of a closed one
  std::vector<int> block_solid;                             ///< of several solids: per block; walls end where it changes. Empty: one solid
  std::vector<double> block_size;                           ///< per block the size where no face asks for another, 0: as elsewhere; may be empty
};

DemandPlaces find_places(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks);

/// CAD faces of the boundary triangles at the sides of the blocks; `chart_at`: chart and CAD face of a triangle (points ascending) as the solid of the block
/// sees it, or none. `block_solid` as in DemandPlaces.
using TriangleChart = std::function<std::optional<std::pair<int, int>>(const Triangle& triangle, int block)>;
std::vector<std::array<std::vector<int>, 6>> find_side_faces(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                                                             const std::vector<int>& block_solid, const TriangleChart& chart_at);

/// Side of a block behind which there is nothing of its solid.
bool is_wall(const BlockComplex& blocks, const std::vector<int>& block_solid, int block, int side);

/// `options` in the pose of the map; `scale`: cells per unit of the map. Throws StageFailed("quantize", ...) naming the entities when these
/// blocks cannot keep a demand: faces that are nowhere opposite each other, an edge that does not run along the axes.
QuantizeOptions quantize_options(const DemandPlaces& places, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                                 const MeshOptions& options, double scale);

/// Puts the cells along the edges of `bias` into geometric series; `chains` as DemandPlaces::edge_chains. Throws StageFailed("quantize", ...) where the grid
/// does not follow one.
void bias_edges(const std::vector<std::vector<int>>& chains, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                const EdgeBiases& biases, const std::vector<int>& value, Spacing& spacing);

/// Fewer divisions where padding made more of them than were asked for, so that they come out right the next time; the same where nothing can
/// be done about it.
Divisions allow_for_padding(const HexMesh& mesh, const Association& association, const Divisions& divisions);

/// One line per division that the mesh does not have (padding adds cells where it must).
std::vector<std::string> unmet_divisions(const HexMesh& mesh, const Association& association, const Divisions& divisions);

}  // namespace polycube
