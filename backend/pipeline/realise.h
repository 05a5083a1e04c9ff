// From labels to a map: features that the map cannot hold without folding are given up.
#pragma once

#include "core/monitor.h"
#include "deform/deform.h"
#include "label/features.h"

namespace polycube {

struct RealisedMap {
  PolycuboidMap map;
  DeformReport report;
};

/// Deforms without and with the features; CAD edges whose features fold tets that do not fold without them lose their features (and are marked lost in
/// `features`), until the features fold nothing more. `fixed`: charts (sign 0) that are never given up, last in the map.
RealisedMap realise(const CadModel& model, const TetMesh& tets, const Labelling& labelling, Features& features, const DeformOptions& options,
                    const Monitor& monitor, const std::vector<Chart>& fixed = {});

}  // namespace polycube
