// Layers of hexahedra where the CAD is smooth but the polycube has an edge, and round CAD edges that cross the grid.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"

namespace polycube {

struct PaddedMesh {
  HexMesh mesh;
  Association association;
  std::vector<int> fixed_faces{};  ///< CAD faces whose quads stay as they are, ascending: another mesh has them too
  std::vector<int> origin{};       ///< per hex: one of the grid from which or beside which it came; empty: the grid's hexes come first, none is missing
};

struct PadReport {
  int surface_quads = 0;  ///< boundary quads that got a layer
  int rings = 0;          ///< patches that got a ring of quads inside their border
  int added_hexes = 0;
};

/// Several ways to pad, the most promising first, at least one: layers under whole smooth regions or pillows round the edges at fault.
/// Which is best shows only in the fitted geometry. Each is as pad() describes. `fixed_faces` as in PaddedMesh;
/// `threads` as in core/parallel.h, of which the meshes do not depend.
std::vector<PaddedMesh> pad_choices(const CadModel& model, const HexMesh& mesh, const Association& association, const Monitor& monitor,
                                    std::vector<PadReport>* reports = nullptr, const std::vector<int>& fixed_faces = {}, int threads = 1);

/// The first of pad_choices. Inserts sheets and carries the association along. Geometry of new nodes is a rough first guess (a third of a
/// cell inside); fit follows.
PaddedMesh pad(const CadModel& model, const HexMesh& mesh, const Association& association, const Monitor& monitor, PadReport* report = nullptr);

/// Recomputes nothing: the list of what is wrong with the pair (non-manifold boundary, quads and point classes that contradict, ...).
std::vector<std::string> check(const HexMesh& mesh, const Association& association);

}  // namespace polycube
