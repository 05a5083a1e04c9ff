// Local refinement of a mesh that stands on the CAD: divided, and fitted again, level by level.
#pragma once

#include <limits>
#include <map>

#include "cad/cad.h"
#include "core/demands.h"
#include "fit/fit.h"
#include "pad/pad.h"
#include "pipeline/circles.h"

namespace polycube {

/// What is to be refined of a mesh.
struct RefinePlan {
  LocalRefinements everywhere{};  ///< along every edge
  LocalRefinements round{};       ///< of bores: round them and away from them, not along them; `edges` are their rims
  std::vector<int> edges{};
  std::map<CadRef, std::vector<CadRef>> pieces{};  ///< of solids that were joined: what their faces, edges and vertices are in the association
  std::vector<int> hex_solid{};                    ///< and per hex of the mesh before all levels the number of its solid
  bool empty() const { return everywhere.empty() && round.empty(); }
};

/// What brings the bores among `edges` (with `levels`) to the elements that they need, where the mesh has fewer.
RefinePlan plan_for_bores(const std::vector<RoundEdge>& edges, const EdgeLevels& levels, const Association& association, int edge_count);

inline constexpr int kAllLevels = std::numeric_limits<int>::max();
/// Cells after the first `levels` of the plan; it does not move nodes.
std::size_t count_refined(const HexMesh& mesh, const Association& association, const RefinePlan& plan, int levels, const Monitor& monitor);

struct LocallyRefined {
  PaddedMesh padded;
  FitReport fitted;
  std::vector<int> parent;  ///< per hex: that of the mesh before all levels; ascending
  std::vector<std::string> warnings;
};

/// `padded` has been fitted. Throws InvalidInput where the levels would take more than kMostHexes cells, before anything is done about them.
LocallyRefined refine_locally(const CadModel& model, const PaddedMesh& padded, const RefinePlan& plan, const FitOptions& options, const Monitor& monitor);

}  // namespace polycube
