// What is wrong with a labelling of regions: the published rules (Mestrallet, Bourcier, Ledoux 2025, arXiv 2502.05712), the corner rule in full.
#pragma once

#include "label/regions.h"

namespace polycube {

struct Violations {
  int opposite_arcs = 0;     ///< arcs between +axis and -axis of one axis
  int poor_loops = 0;        ///< missing corners, summed over the border loops of charts (each needs four)
  int bad_corners = 0;       ///< corners whose cyclic label order no polycube corner has
  int turning_points = 0;    ///< places where a boundary reverses along its axis
  int bad_turns = 0;         ///< chart borders that do not close as a rectilinear polygon
  int folded_regions = 0;    ///< regions with a Region::normal that stand square to their label's axis or face away from it: most maps fold there
  double score = 0;          ///< weighted sum
  std::vector<int> regions;  ///< regions beside a violation, ascending
  std::vector<int> corners;  ///< junctions that are bad corners, ascending

  bool valid() const { return opposite_arcs == 0 && poor_loops == 0 && bad_corners == 0; }
  /// Nothing that another division of faces could mend.
  bool sound() const { return valid() && folded_regions == 0; }
};

/// For many labellings of one graph: what does not depend on the labels is worked out once. Safe to use from several threads.
class ViolationFinder {
 public:
  /// `points` are mesh points in the frame of the labels. `noise`: reversals of a boundary below this length (mm) do not count, but for tips between steep
  /// CAD edges. Holds a reference to `graph`.
  ViolationFinder(const RegionGraph& graph, const std::vector<Vec3>& points, double noise);

  Violations find(const std::vector<int>& region_label) const;
  /// Violations::score alone.
  double score(const std::vector<int>& region_label) const;

 private:
  class Check;
  const RegionGraph& graph_;
  double noise_;
  /// A place on a boundary, as seen along one axis.
  struct Place {
    double x = 0;
    bool steep = false;  // the way from the place before runs steeply along the axis on a CAD edge
  };
  /// The ends of a chain of nodes, and where it turns back along an axis between.
  using Course = std::vector<Place>;
  static Course course(const std::vector<Vec3>& points, const Arc& arc, int axis);

  std::vector<std::array<Course, 3>> course_;  // per arc and axis
  std::vector<int> place_;                     // per dart: index among those of the junction where it starts
  std::vector<std::array<char, 6>> folds_;     // per region and label: the region folds with it
};

/// The same for one labelling.
Violations find_violations(const RegionGraph& graph, const std::vector<Vec3>& points, const std::vector<int>& region_label, double noise);

/// Labels per triangle as a graph whose regions are their charts, numbered as find_charts numbers them.
struct ChartGraph {
  RegionGraph graph;
  std::vector<int> label;    ///< per chart
  std::vector<Vec3> points;  ///< in the frame of the labels
  double noise = 0;          ///< mm: reversals of a boundary below three quarters of a mean edge do not count
};

/// `frame` takes the mesh to the frame of the labels.
ChartGraph chart_graph(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels);

/// Of the charts of labels per triangle, of which no normal is known.
Violations find_violations(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels);

/// Corners of charts, as points of the mesh, from which a border runs where the surface is smooth: a block has an edge there, and a part none, so that its
/// cells are 180 degrees wide.
std::vector<int> smooth_corners(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels);

/// What labels per triangle have of single CAD faces, slivers aside, and fold as regions do. No fault by itself: a small face may well be bent round to where
/// its neighbours want it.
int count_folded_parts(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels);

}  // namespace polycube
