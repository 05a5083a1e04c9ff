// From labels to a map: features that the map cannot hold without folding are given up.
#pragma once

#include <functional>

#include "core/monitor.h"
#include "deform/deform.h"
#include "label/features.h"

namespace polycube {

struct RealisedMap {
  PolycuboidMap map;
  DeformReport report;
};

/// The map without features. `fixed`: charts (sign 0) that are never given up, last in the map.
RealisedMap realise_bare(const TetMesh& tets, const Labelling& labelling, const DeformOptions& options, const Monitor& monitor,
                         const std::vector<Chart>& fixed = {});

/// Deforms with the features and, where that folds tets, without them; CAD edges whose features fold tets that do not fold without them lose their features
/// (and are marked lost in `features`), until the features fold nothing more. `bare`: the map without features, asked for where it is needed.
RealisedMap realise(const CadModel& model, const TetMesh& tets, const Labelling& labelling, Features& features, const DeformOptions& options,
                    const Monitor& monitor, const std::function<const RealisedMap&()>& bare, const std::vector<Chart>& fixed = {});

/// The same where nobody has the map without features.
RealisedMap realise(const CadModel& model, const TetMesh& tets, const Labelling& labelling, Features& features, const DeformOptions& options,
                    const Monitor& monitor, const std::vector<Chart>& fixed = {});

}  // namespace polycube
