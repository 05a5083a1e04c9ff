// What a sheet would gain, tried on the part of the mesh it touches.
#pragma once

#include "pad/angles.h"
#include "pad/sheet.h"

namespace polycube {

/// The mesh before the sheet, with what all trials on it need.
struct TrialMesh {
  TrialMesh(const CadModel& model, const PaddedMesh& padded);

  const CadModel& model;
  const PaddedMesh& padded;
  HexTopology topology;
  std::vector<std::vector<int>> node_quads;
  std::vector<std::vector<int>> node_segments;
};

struct TrialResult {
  std::vector<int> obstacles;  ///< nodes where the sheet cannot be opened; then the rest is 0
  double gain = 0;             ///< fall of the sum of angle costs at the edges and sectors it touches, less a price per new hex
  int added = 0;               ///< new hexes
};

TrialResult try_sheet(const TrialMesh& whole, const SheetCut& cut);

}  // namespace polycube
