// The stages up to the polycuboid map alone, to look at labels, charts and features of a part.
#pragma once

#include <optional>

#include "cad/assembly.h"
#include "core/error.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "core/report.h"
#include "label/features.h"
#include "label/label.h"
#include "pipeline/pose.h"

namespace polycube {

struct ConformalLabels;
struct ConformalModel;

struct LabelledPart {
  TetMesh tets;
  Labelling labelling;
  LabelReport label_report;
  Features features;
  PolycuboidMap map;                   ///< empty where there is none
  int flipped = 0;                     ///< tets without positive volume in the image
  std::optional<StageFailed> failure;  ///< why there is no map; of labels that no map can have (label/order.h), the charts and CAD faces concerned
  std::vector<StageRecord> stages;     ///< tet, label and, with a map, deform
};

enum class Until { kLabels, kMap };

/// Throws as the pipeline does up to the labels; labels without a map are handed out, to see what is wrong with
/// them. `until` kLabels leaves the map out, which takes most of the time. All in the part's own place and the
/// user's axes.
LabelledPart label_part(const CadModel& model, const MeshOptions& options, const Monitor& monitor, Until until = Until::kMap);

/// The same of a part of one solid or of several that touch: each of these with all of its boundary and points of its own, an interface as each of its sides
/// sees it. They have no map; `failure` says so. Throws InvalidInput where solids have no common axes: those apart, or all with "separate".
LabelledPart label_part(const Assembly& assembly, const MeshOptions& options, const Monitor& monitor, Until until = Until::kMap);

/// What is seen of solids with common nodes, by the numbers of the assembly. `left_out`: per joined edge. Its stages are the caller's.
LabelledPart labelled_solids(const ConformalModel& model, const ConformalLabels& labels, const std::vector<char>& left_out, const Monitor& monitor);

/// From the pose to the part's own place and the user's axes.
void put_back(const Pose& pose, LabelledPart& part);

}  // namespace polycube
