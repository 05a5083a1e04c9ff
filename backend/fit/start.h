// First places: every boundary node on its CAD entity, chains in order along their curve, the rest carried along.
#pragma once

#include <memory>

#include "core/monitor.h"
#include "fit/energy.h"

namespace polycube {

/// The mesh nodes along each CAD edge, in order from vertex to vertex, and arc length along the curves.
class Chains {
 public:
  Chains(const CadModel& model, const Association& association);

  /// Lays every chain along its curve: projections kept where they are in order and nowhere bunched, else spaced as the nodes are.
  void place(std::vector<Vec3>& points, Entities& entities) const;
  /// Moves nodes along their curve where they have left the order or come closer than a tenth of even spacing.
  void keep_order(std::vector<Vec3>& points, Entities& entities) const;
  /// The mesh edges on curved CAD edges, for nodes that stand where `entities` projected them.
  std::vector<Turn> turns(const std::vector<Vec3>& points, const Entities& entities) const;

 private:
  struct Chain;
  bool forward(const Chain& chain, const std::vector<double>& lengths, const Entities& entities) const;
  const CadModel& model_;
  std::vector<std::shared_ptr<const Chain>> chains_;
};

/// Puts vertices on vertices, lays the chains, lets the nodes of patches follow their border and projects them, then lets inner nodes
/// follow the boundary.
void place_on_cad(const CadModel& model, HexMesh& mesh, const Association& association, const Chains& chains, Entities& entities, const Monitor& monitor);

}  // namespace polycube
