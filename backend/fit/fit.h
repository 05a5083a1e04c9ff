// Geometry of the hexahedral mesh on the exact CAD: untangle, then raise the worst cells.
#pragma once

#include <functional>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "fit/tuning.h"

namespace polycube {

struct FitOptions {
  double target_scaled_jacobian = kFitTuning.target_scaled_jacobian;  ///< work on worse cells goes on until this or no progress
  int max_rounds = kFitTuning.max_rounds;
  int threads = 2;  ///< the result does not depend on it
  /// Cells keep the sizes that they come with; else those of neighbours even out, and small cells beside large ones grow.
  bool keep_sizes = false;
  /// Whether time runs short: then good cells are not evened out.
  std::function<bool()> hurry = [] { return false; };
};

struct FitReport {
  int inverted = 0;  ///< cells left with scaled Jacobian <= 0; the caller must not use the mesh unless 0
  double min_scaled_jacobian = 0;
  double mean_scaled_jacobian = 0;
  double max_off = 0;          ///< mm, largest distance of a boundary node from its CAD entity
  std::vector<int> bad_faces;  ///< CAD faces touched by cells left inverted
};

/// Moves the nodes of `mesh`: nodes of {0, v} stand on the vertex, of {1, e} slide on the edge's curve, of {2, patch} on the patch's faces,
/// the others are free. Connectivity stays. On return every boundary node is on its entity to 1e-9 of the model's diagonal.
FitReport fit(const CadModel& model, HexMesh& mesh, const Association& association, const FitOptions& options, const Monitor& monitor);

struct FitCandidate {
  HexMesh& mesh;
  const Association& association;
};

struct FitChoice {
  std::size_t index = 0;  ///< of the best of the fitted candidates
  FitReport report;       ///< of that one
  int fitted = 0;         ///< candidates that were fitted to the end
};

/// Meshes of the same part, of which one is wanted, the presumably best first: all go through the first rounds of untangling and a look at what
/// comes after it; then they are fitted, the most promising first, until `good` holds for the best so far or `most` are done. Each mesh comes
/// out as `fit` would leave it, or is not to be used.
FitChoice fit_best(const CadModel& model, const std::vector<FitCandidate>& candidates, const FitOptions& options, int most,
                   const std::function<bool(std::size_t, const FitReport&)>& good, const Monitor& monitor);

/// The one of them that fit_best would fit to the end first; it alone is tried where it comes out good. The meshes are not to be used afterwards.
std::size_t most_promising(const CadModel& model, const std::vector<FitCandidate>& candidates, const FitOptions& options, const Monitor& monitor);

/// The smallest scaled Jacobian but for cells that a narrow angle of the CAD holds where they are, between two edges or, along an edge, between its two
/// faces: no fit and no other grid makes those better.
double free_scaled_jacobian(const HexMesh& mesh, const Association& association);

/// Whether the smallest scaled Jacobian is what the narrowest angle of the CAD that a cell fills allows, between two edges at a vertex or between the two faces
/// of an edge: that of no mesh that has those edges is larger.
bool at_cad_bound(const CadModel& model, const HexMesh& mesh, const Association& association);

}  // namespace polycube
