#include "pad/pad.h"

#include <algorithm>

#include "core/error.h"
#include "pad/rings.h"
#include "pad/sheet.h"
#include "pad/surface.h"

namespace polycube {

namespace {

int pad_surface(const CadModel& model, PaddedMesh& padded, const Monitor& monitor) {
  const HexTopology topology = build_topology(padded.mesh, padded.association.quads);
  const auto edges = boundary_edges(padded.mesh, padded.association.quads, topology);
  const auto angles = dihedral_angles(model, padded.mesh, padded.association, edges);
  SheetCut cut{std::vector<char>(padded.mesh.hexes.size(), 1), choose_surface(padded.mesh, padded.association, edges, angles, monitor)};
  const int quads = static_cast<int>(std::count(cut.surface.begin(), cut.surface.end(), 1));
  if (quads > 0) insert_sheet(padded.mesh, padded.association, cut);
  return quads;
}

}  // namespace

PaddedMesh pad(const CadModel& model, const HexMesh& mesh, const Association& association, const Monitor& monitor, PadReport* report) {
  const auto faults_before = check(mesh, association);
  if (!faults_before.empty()) throw StageFailed("pad", "the mesh handed to padding is not sound: " + faults_before[0]);
  PaddedMesh padded{mesh, association};
  monitor.progress("pad", 0.1);
  PadReport counts;
  counts.surface_quads = pad_surface(model, padded, monitor);
  monitor.progress("pad", 0.4);
  counts.rings = insert_rings(model, padded, monitor);
  monitor.progress("pad", 0.9);
  counts.added_hexes = static_cast<int>(padded.mesh.hexes.size() - mesh.hexes.size());
  const auto faults = check(padded.mesh, padded.association);
  if (!faults.empty()) throw StageFailed("pad", "padding broke the mesh: " + faults[0]);
  if (report) *report = counts;
  monitor.progress("pad", 1);
  return padded;
}

}  // namespace polycube
