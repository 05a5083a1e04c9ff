#include "pipeline/gate.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/quality.h"
#include "fem/fem.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

// Corners of the first edge of the hex that has no length; equal where there is none.
std::array<int, 2> edge_without_length(const CadModel& model, const HexMesh& mesh, const Hex& hex) {
  for (const auto& [c, d] : kHexEdges) {
    if ((mesh.points[hex[c]] - mesh.points[hex[d]]).norm() <= kPipelineTuning.shortest_edge * model.diagonal()) return {c, d};
  }
  return {0, 0};
}

}  // namespace

bool is_faulty(const CadModel& model, const HexMesh& mesh, const Hex& hex) {
  const auto [c, d] = edge_without_length(model, mesh, hex);
  return c != d || !(scaled_jacobian(mesh.points, hex) > 0);
}

void gate(const CadModel& model, const PaddedMesh& padded, int threads, const Monitor& monitor) {
  const QualitySummary q = summarise(padded.mesh);
  if (padded.mesh.hexes.empty() || q.inverted > 0 || !(q.min_scaled_jacobian > 0)) throw StageFailed("fit", "cells without positive Jacobian");
  if (q.min_scaled_jacobian < kPipelineTuning.flattest) throw StageFailed("fit", "cells stay flat");
  // CAD vertices that all but coincide cannot each have a node of its own.
  for (const Hex& h : padded.mesh.hexes) {
    const auto [c, d] = edge_without_length(model, padded.mesh, h);
    if (c == d) continue;
    const CadRef at = padded.association.point_cad[h[c]];
    throw StageFailed("fit", "a cell without size", at.dim < 2 ? std::vector{at} : std::vector<CadRef>{});
  }
  const std::vector<std::string> faults = check(padded.mesh, padded.association);
  if (!faults.empty()) throw StageFailed("pad", "the mesh does not conform: " + faults.front());
  std::set<int> nodes;
  std::set<std::pair<int, int>> edges;
  for (const Quad& quad : padded.association.quads) {
    for (int k = 0; k < 4; ++k) {
      nodes.insert(quad[k]);
      edges.insert(std::minmax(quad[k], quad[(k + 1) % 4]));
    }
  }
  const int euler = static_cast<int>(nodes.size()) - static_cast<int>(edges.size()) + static_cast<int>(padded.association.quads.size());
  if (euler != model.euler_characteristic()) throw StageFailed("hex", "the mesh has another topology than the solid");
  // Solvers look at integration points too; an element that cannot be made there is no better than an inverted one. Where the straight one can, so can that of
  // second order.
  build_fem_mesh(model, padded.mesh, padded.association, {.order = 1, .threads = threads}, monitor);
}

}  // namespace polycube
