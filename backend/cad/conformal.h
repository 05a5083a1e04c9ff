// Solids that touch, joined: what they have in common exists once.
#pragma once

#include "cad/assembly.h"

namespace polycube {

/// What the entities of one solid were before the solids were joined: by number, entry 0 unused; 0 for what is new.
struct Origin {
  std::vector<int> faces, edges, vertices;
};

/// The general fuse of solids that touch in faces. All models share one numbering, that of the fused shape; faces between two solids are interfaces.
struct ConformalModel {
  CadModel
      whole;  ///< every face, edge and vertex once: for places and projections. Its edges name two of their faces only, a face is turned as in its first solid.
  CadModel outer;                ///< the solid that the faces of one solid each bound
  std::vector<CadModel> solids;  ///< in the order of the assembly's
  std::vector<Origin> origins;   ///< per solid
  std::vector<int> numbers;      ///< per solid: its number in the assembly
  /// CAD faces between two solids, ascending, with indices of these, the lower first.
  std::vector<std::pair<int, std::array<int, 2>>> interfaces;
};

/// Joins those solids of an assembly (numbers from 1, ascending). Throws StageFailed("interfaces", ...) where they do not make one solid: where they meet in an
/// edge or a vertex only, with those by their numbers in the assembly.
ConformalModel conform(const Assembly& assembly, const std::vector<int>& solids, const Monitor& monitor);

}  // namespace polycube
