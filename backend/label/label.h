// One of six directions for every boundary triangle: a polycube labelling.
#pragma once

#include <string>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "label/tuning.h"

namespace polycube {

struct LabelOptions {
  double fidelity = 3;                            ///< weight of agreeing with the normal
  double compactness = 1;                         ///< weight of short chart boundaries
  double widest_bend = kLabelTuning.widest_bend;  ///< radians: a face whose normals stay this near to their mean keeps one label unless repair halves it
  bool narrow_regions = false;                    ///< pieces of a face between generators that are small against the face may have labels of their own
  bool room = true;                               ///< strips beside edges on barrels that come close to 45 degrees (strips.h)
  int chamfer_axis = -1;                          ///< 0..2: chamfers (is_chamfer) of that axis prefer it; -1: the nearest axis
  double strictness = kLabelTuning.strictness;    ///< energy that one violation is worth; high: any relabelling to be rid of it
  bool facing = false;                            ///< regions that stand square to their label's axis, or face away, are violations, and divided at more places
  bool gradual = true;                            ///< strictness is reached by doubling, so that violations that little cost mends are mended by little
  std::vector<std::pair<int, int>> face_labels;   ///< (CAD face, label 0..5) given by the user
  std::vector<std::pair<int, int>> barred;        ///< (CAD face, label 0..5) that no part of the face may have
  bool frame_given = false;
  Mat3 frame = Mat3::Identity();  ///< rows: the axes, right-handed
  int threads = 2;                ///< the result does not depend on it
};

struct Labelling {
  Mat3 frame = Mat3::Identity();  ///< rows: the axes of the labels in model space
  std::vector<int> label;         ///< per boundary triangle: 0..5 = +X -X +Y -Y +Z -Z of the frame
};

/// What is wrong with the labels as they are after all cuts, by the published rules (validity.h); all zero but `regions`, `charts`, `folded_parts` and `energy`
/// for a valid, monotone labelling.
struct LabelReport {
  int regions = 0;
  int charts = 0;
  int opposite_arcs = 0;
  int poor_loops = 0;
  int bad_corners = 0;
  int turning_points = 0;
  int bad_turns = 0;
  int folded_parts = 0;  ///< of faces, no fault by themselves (count_folded_parts)
  double score = 0;      ///< of the violations, weighted
  double energy = 0;     ///< of the labels: deviation from the normals and borders, what the search lowers after the violations
  bool valid() const { return opposite_arcs == 0 && poor_loops == 0 && bad_corners == 0; }
};

/// A plane between 30 and 60 degrees of the axis.
bool is_chamfer(const CadFace& face, const Mat3& frame, int axis);

/// The best labelling that the search finds, valid or not: whether it can be realised, the map decides. Cuts the mesh along chart boundaries inside
/// smooth faces, so that they run straight; slivers that this leaves are absorbed (strays.h).
Labelling label(const CadModel& model, TetMesh& mesh, const LabelOptions& options, const Monitor& monitor, LabelReport* report = nullptr);

}  // namespace polycube
