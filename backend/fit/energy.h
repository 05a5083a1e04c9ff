// Energies of hexahedra and their minimisation over nodes that slide on their CAD entities.
#pragma once

#include "core/monitor.h"
#include "fit/entities.h"

namespace polycube {

/// Which hexes touch a node, and which lie side by side.
struct HexGraph {
  std::vector<int> first, corners;                      ///< CSR over nodes: 8 * hex + corner, ascending
  std::vector<std::array<int, 6>> neighbours;           ///< per hex and face: the hex beyond, -1 at the boundary
  std::vector<std::array<std::array<int, 3>, 6>> axes;  ///< per hex and face: the neighbour's axis that goes with each of the hex's axes
};

HexGraph build_hex_graph(const HexMesh& mesh);

/// Wanted edge lengths of every hex along its three axes: those it has, smoothed over its neighbours, within a factor of 8 of each other.
std::vector<Vec3> target_lengths(const HexMesh& mesh, const HexGraph& graph, int smoothing_steps);

/// What is minimised. With J the matrix of a corner's three edges over the wanted lengths, D = det J and chi(D) = (D + sqrt(eps^2 + D^2)) /
/// 2:
///   shape * ((tr(J^T J) / 3)^(3/2) / chi + (D^2 + 1) / (2 chi))  +  right * (|J_1| |J_2| |J_3| / chi)^power
///     + right * sum over k of (0.15 / |J_k|)^power
/// summed over the eight corners of each hex: Garanzha et al. 2021 with the power 3/2 of their first term, which needs no cube root; the
/// last two are powers of the inverse scaled Jacobian, which knows no size, and of the edges' shortness, lest edges collapse for its sake.
/// Gathered, the third term is N / gathered * log(mean over the N corners of the hex of (1 / scaled Jacobian)^gathered): minus N times the logarithm of
/// about its worst one. The mean of the worst corners is what a mesh is judged by; the sum over corners makes good ones better at their cost.
/// Watched hexes are summed at their integration points too: there an element is judged, and good corners do not vouch for it.
/// With a floor, a corner adds right / floor^2 * (floor / scaled Jacobian)^16: no cell near the floor gets worse for the sake of the others.
/// Turns of mesh edges on curved CAD edges add powers of their angle, corners of the skin what corners of hexes do.
struct Energy {
  double shape = 1;
  double right = 0;
  int power = 2;     ///< even
  double floor = 0;  ///< a scaled Jacobian, 0: none
  double eps = 0;    ///< 0: a barrier, infinite where D <= 0
  int gathered = 0;  ///< even; 0: corners count each for itself
};

struct CellRegion {
  std::vector<int> hexes;       ///< over which is summed, ascending
  std::vector<int> nodes;       ///< that may move, ascending
  std::vector<char> watched{};  ///< per hex of `hexes`; empty: none
};

/// A mesh edge on a curved CAD edge: the angle by which the curve turns along it, linear in the places of its ends. Long chords of a circle cut
/// off what lies behind them, and the nodes beside them land on the circle.
struct Turn {
  std::array<int, 2> nodes{};
  std::array<Vec3, 2> places;  ///< where `angle` holds
  std::array<Vec3, 2> slopes;  ///< of the angle by the places, radians per mm
  double angle = 0;            ///< radians
};

/// A corner of a boundary quad, as if a cell of height 1 stood on it: positive hexes alone let a face's nodes slide out over its border, and projection takes
/// them back to where the hexes are inverted.
struct SkinCorner {
  std::array<int, 3> nodes{};       ///< the corner and its neighbours in the quad, counter-clockwise seen from outside
  std::array<double, 2> lengths{};  ///< wanted, mm
  Vec3 normal;                      ///< of the CAD face
};

struct DescentResult {
  double energy = 0;
  double start_energy = 0;
  int iterations = 0;
};

/// L-BFGS with nodes moving along the tangent spaces noted by `entities` and bent with them to second order; project them afterwards. It ends
/// early where an entity turns much under a node.
class Descent {
 public:
  Descent(HexMesh& mesh, const HexGraph& graph, const Entities& entities, int threads, const Monitor& monitor);

  DescentResult run(const Energy& energy, const std::vector<Vec3>& targets, const CellRegion& region, const std::vector<Turn>& turns,
                    const std::vector<SkinCorner>& skin, int max_iterations);
  /// Smallest det J of the region and the skin.
  double min_determinant(const std::vector<Vec3>& targets, const CellRegion& region, const std::vector<SkinCorner>& skin) const;

 private:
  double evaluate(const Energy& energy, const std::vector<Vec3>& targets, const CellRegion& region, const std::vector<Turn>& turns,
                  const std::vector<SkinCorner>& skin, const std::vector<Vec3>& points, const std::vector<Vec3>& steps, std::vector<Vec3>& gradient);

  HexMesh& mesh_;
  const HexGraph& graph_;
  const Entities& entities_;
  int threads_;
  const Monitor& monitor_;
  std::vector<int> slot_;       // per hex: its place in the region, -1
  std::vector<int> node_slot_;  // per node: its place in the region, -1
  std::vector<double> corner_gradient_;
};

}  // namespace polycube
