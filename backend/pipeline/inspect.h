// What there is to see on a labelled part: charts, their boundaries and what is doubtful about them. As values, as a table line, as a file for ParaView.
#pragma once

#include <string>
#include <vector>

#include "label/validity.h"
#include "pipeline/label_part.h"

namespace polycube {

/// Of the boundary mesh as it is after straightening, not of the regions that the labels were searched on. Points are indices into the tet mesh.
struct Inspection {
  std::vector<int> chart;  ///< per boundary triangle, numbered by the first triangle
  int charts = 0;
  int boundaries = 0;               ///< maximal chains between two charts
  Violations violations;            ///< by the published rules
  std::vector<int> corners;         ///< points where three or more charts meet, ascending
  std::vector<int> bad_corners;     ///< those no polycube has
  std::vector<int> turning_points;  ///< where a boundary reverses along its axis
  std::vector<int> zigzags;         ///< points inside a CAD face where a boundary bends by more than 35 degrees
  std::vector<int> stray_charts;    ///< charts of at most 4 triangles, or of less than a square of 2 mean edges
};

Inspection inspect(const LabelledPart& part);

/// The CAD edges by what became of them.
struct EdgeTable {
  int edges = 0, boundary = 0, feature = 0, lost = 0;
};

EdgeTable edge_table(const LabelledPart& part);

/// The label that covers most of each CAD face, by face number; entry 0 is not used.
std::vector<int> face_labels(const LabelledPart& part, int face_count);

/// JSON object, indented, one line end at its end. `name`: of the part.
std::string report_json(const std::string& name, const Assembly& assembly, const LabelledPart& part, const Inspection& inspection);

/// VTK XML. Cells: boundary triangles; chart boundaries and CAD edges as lines; corners and doubtful points as vertices. Cell data:
/// kind (0 triangle, 1 chart boundary, 2 CAD edge on chart boundaries, 3 CAD edge with feature charts, 4 CAD edge not captured, 5 corner, 6 corner that no
/// polycube has, 7 turning point, 8 zigzag), label, chart, face, edge (-1 or 0 where a cell has none), axis (of a feature chart, else -1).
/// Point data g: the map, where there is one. Throws InvalidInput where the file cannot be written.
void write_vtu(const std::string& path, const LabelledPart& part, const Inspection& inspection);

}  // namespace polycube
