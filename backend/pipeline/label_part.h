// The stages up to the polycuboid map alone, to look at labels, charts and features of a part.
#pragma once

#include <string>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "core/report.h"
#include "label/features.h"
#include "label/label.h"

namespace polycube {

struct LabelledPart {
  TetMesh tets;
  Labelling labelling;
  LabelReport label_report;
  Features features;
  PolycuboidMap map;
  int flipped = 0;                   ///< tets without positive volume in the image
  std::vector<StageRecord> stages;
};

/// Throws as the pipeline does.
LabelledPart label_part(const CadModel& model, const MeshOptions& options, const Monitor& monitor);

/// Boundary triangles with cell data label, chart, face and point data image (VTK XML); feature charts and chart boundaries as lines.
void write_vtu(const std::string& path, const LabelledPart& part);

}  // namespace polycube
