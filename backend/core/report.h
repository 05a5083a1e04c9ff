// What a run did and what came out of it, for people and for machines.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/options.h"
#include "core/quality.h"

namespace polycube {

struct StageRecord {
  std::string name;
  double seconds = 0;
};

/// How many of the worst cells a report lists.
inline constexpr std::size_t kWorstCells = 20;

struct WorstCell {
  int hex = 0;                 ///< 0-based
  Vec3 centre = Vec3::Zero();  ///< mm
  double scaled_jacobian = 0;
  std::vector<int> faces{};  ///< CAD faces that it touches, ascending; empty for an inner cell
};

/// CAD entities that the mesh has quads, edges and nodes for, out of all. Seams and degenerate edges are not counted.
struct CadCapture {
  int vertices = 0, edges = 0, faces = 0;
  int vertices_captured = 0, edges_captured = 0, faces_captured = 0;
  std::vector<int> lost_vertices, lost_edges, lost_faces;           ///< ascending
  std::vector<int> ignored_vertices, ignored_edges, ignored_faces;  ///< ascending: left out on demand (feature_angle), neither captured nor lost
};

/// The quantization's proof: no other integers have an objective below the bound.
struct QuantizationRecord {
  double objective = 0, bound = 0, gap = 0;  ///< gap: (objective - bound) / objective
  bool optimal = false;
  int nodes = 0, cuts = 0, c2_rounds = 0;  ///< of the search tree; C2 constraints met; solutions checked against C2
};

struct SolidReport;

/// Faces of two solids that touch.
struct InterfaceRecord {
  std::array<int, 2> solids{0, 0};
  std::array<std::vector<int>, 2> faces;  ///< CAD faces of each
  double area = 0;                        ///< mm^2
};

struct MeshReport {
  std::string version;
  MeshOptions options;
  double size = 0;                  ///< edge length in force, mm
  std::vector<StageRecord> stages;  ///< in the order they ran; a stage that ran for several candidates is summed up
  double peak_memory_mb = 0;
  int tets = 0, charts = 0, blocks = 0, hexes = 0, nodes = 0;
  QualitySummary quality;        ///< of the corners (first order)
  ShapeSummary shape;            ///< likewise
  double volume = 0;             ///< mm^3, of the mesh
  double cad_volume = 0;         ///< mm^3
  std::vector<WorstCell> worst;  ///< ascending scaled Jacobian, at most kWorstCells
  CadCapture capture;
  QuantizationRecord quantization;
  std::string plan;  ///< of the search: the one that the mesh comes from
  int plans_tried = 0;
  bool out_of_time = false;             ///< the time limit ended the search: a better mesh was not looked for
  int padded_hexes = 0;                 ///< cells that padding added
  int loose_nodes = 0;                  ///< on CAD edges whose curve is there more than 1e-7 mm off a face of theirs (files with loose tolerances)
  int thin_walls = 0;                   ///< pairs of CAD faces with fewer elements between them than asked for
  int coarse_circles = 0;               ///< CAD edges with fewer elements along them than their turning asks for
  int straightened_edges = 0;           ///< second order: edges off the CAD because a cell would be spoilt by the curved ones
  std::vector<int> straightened_faces;  ///< CAD faces with such edges, ascending
  std::vector<SolidReport> solids;      ///< of several: each by itself; the fields above are of all of them
  std::vector<InterfaceRecord> interfaces;
  std::vector<std::string> warnings;  ///< one line each
};

struct SolidReport {
  std::string label;  ///< of the object or product that the solid comes from, or empty
  MeshReport report;
  int first_hex = 0;  ///< number of its first cell in the mesh of all
};

/// The report of a mesh of several solids, from those of each: counts and seconds are summed, the worst cells are those of the whole, by its numbers.
MeshReport join(std::vector<SolidReport> solids);

/// The `count` cells of least scaled Jacobian, ties by index.
std::vector<WorstCell> worst_cells(const HexMesh& mesh, const Association& association, int count = kWorstCells);

/// Counts the model's entities against the association's lists. A face in a patch of several faces is lost (or ignored): the mesh does not tell it apart.
/// `real_edges` are the CAD edges that count (neither seam nor degenerate).
CadCapture capture(const Association& association, int vertex_count, const std::vector<int>& real_edges, int face_count);

/// JSON object, indented, one line end at its end.
std::string to_json(const MeshReport& report);

}  // namespace polycube
