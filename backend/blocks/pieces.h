// The pieces into which the sheets cut the tets, gathered into components.
#pragma once

#include "blocks/clip.h"
#include "blocks/sheets.h"
#include "blocks/topology.h"
#include "core/union_find.h"

namespace polycube {

/// Area of the cut between two components.
struct Flux {
  int low, high;  ///< components, pieces before they are known
  int axis, plane, sheet;
  double area;
};

struct ChartArea {
  int component;  ///< piece before components are known
  int chart;
  double area;  ///< along +axis
};

/// Cuts every tet by its sheets and gathers the pieces that adjoin into components.
class Pieces {
 public:
  Pieces(const TetMesh& mesh, const PolycuboidMap& map, const TetTopology& topology, const SheetCuts& cuts);
  void run(const Monitor& monitor);

  std::vector<int> offset;     ///< CSR: pieces of every tet
  std::vector<int> component;  ///< per piece, -1 where a tet has no such piece
  std::vector<double> volume;  ///< per component, signed
  std::vector<Flux> fluxes;
  std::vector<ChartArea> chart_areas;

 private:
  std::array<int, 3> counts(int t) const;
  void cut_tet(int t);
  void slice(int t, int axis, const Polyhedron& in, std::array<int, 3> at);
  int piece(int t, const std::array<int, 3>& at) const;
  void emit(int t, const Polyhedron& p, const std::array<int, 3>& at);
  /// The piece of tet n that shares the part of facet f that belongs to piece `at` of tet t.
  int neighbour_piece(int t, int f, int n, const std::array<int, 3>& at) const;

  const TetMesh& mesh_;
  const TetTopology& topology_;
  const SheetCuts& cuts_;
  std::vector<int> chart_of_triangle_, axis_;
  TetClipper clipper_;
  std::array<int, 4> begin_{};  ///< per axis the first of the tet's cuts
  std::array<std::array<Polyhedron, 3>, 3> buffers_;
  std::vector<double> volume_;
  std::vector<char> used_;
  UnionFind* sets_ = nullptr;
};

}  // namespace polycube
