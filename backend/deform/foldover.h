// Foldover-free optimisation of the map (Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov 2021) under the charts' constraints.
#pragma once

#include <memory>

#include "core/monitor.h"
#include "deform/system.h"

namespace polycube {

struct FoldoverReport {
  int iterations = 0;
  int flipped = 0;    ///< tets with non-positive determinant left, those that no image can open not counted
  int collapsed = 0;  ///< tets whose points are tied together by the charts so that no image has volume
};

/// Moves `image` (one value per unknown of each coordinate) to lower sum of volume * (tr(J^T J) / chi(det J)^(2/3) + lambda (det^2 + 1) / chi(det J)),
/// by L-BFGS preconditioned with the coordinates' systems; chi's epsilon follows the worst determinant.
FoldoverReport remove_foldovers(const TetMesh& mesh, const std::vector<Element>& elements, const std::array<std::unique_ptr<Coordinate>, 3>& system,
                                std::vector<Vec3>& image, int threads, const Monitor& monitor);

}  // namespace polycube
