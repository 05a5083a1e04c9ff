// Cylinders and cones, which may change their label along generators where other faces end on them.
#pragma once

#include "cad/cad.h"
#include "label/straighten.h"
#include "label/strips.h"

namespace polycube {

class Barrels {
 public:
  /// `divided`: per CAD face, whether it may have more labels than one. `room`: null, or where it is divided beside edges too. Keeps references to model and
  /// mesh.
  Barrels(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const std::vector<char>& divided, const Room* room);

  /// Number of the piece between two cuts that a triangle lies in; 0 on faces without cuts.
  int sector(int triangle) const;

  /// Borders along generators for the arcs between regions `a` and `b`, which lie on one face and want labels `l` and `m` by their normals. A generator
  /// through a vertex serves where it is nearer to the arc than the line on which the normal is half way between the labels, or within 5 degrees of that
  /// line: a border that passes a vertex by a hair would turn back beside it. Empty where that line serves.
  std::vector<BorderFunction> borders(const RegionGraph& graph, int a, int b, int l, int m) const;

 private:
  struct Barrel {
    std::array<Vec3, 2> across{};    // directions of angle 0 and 90 degrees, in model space
    std::vector<double> generators;  // angles of the vertices on its border and of the ends of strips, ascending
    std::vector<double> cuts;        // those that it is cut at
  };
  static void cut_at(Barrel& barrel, double angle);
  double angle(int face, const Vec3& p) const;
  double mean_angle(int face, const std::vector<int>& nodes) const;
  double share_beyond(int face, const Region& region, double cut) const;

  const CadModel& model_;
  const TetMesh& mesh_;
  Mat3 frame_;
  std::vector<Barrel> barrels_;  // per CAD face
};

}  // namespace polycube
