// The polycuboid map g: every chart becomes an axis-aligned plane, with as little distortion as can be had.
#pragma once

#include "core/mesh.h"
#include "core/monitor.h"
#include "deform/tuning.h"

namespace polycube {

struct DeformOptions {
  int rotations = kDeformTuning.rotations;  ///< local/global rounds after the first solve (as rigid as possible)
  double merge = 0;                         ///< mm: charts of one axis whose values differ by less become one plane
  int threads = 2;                          ///< the result does not depend on it
};

struct DeformReport {
  int flipped = 0;                ///< tets with non-positive volume in the image
  std::vector<int> flipped_tets;  ///< ascending
  double distortion = 0;          ///< mean over the positive tets' volumes of tr(J^T J) / (3 det(J)^(2/3)) - 1: 0 where all angles are kept
};

/// `frame` rows are the axes, `labels` (0..5 per boundary triangle) belong to them, `features` are charts with sign 0 (axis and nodes filled).
/// The result's charts are those of the labelling (core/charts.h), then the features that could be kept, each with its value; the image is in mm.
/// Throws StageFailed("deform", ...) when the charts leave no room for a map (a coordinate is the same all over).
PolycuboidMap deform(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels, const std::vector<Chart>& features, const DeformOptions& options,
                     const Monitor& monitor, DeformReport* report = nullptr);

}  // namespace polycube
