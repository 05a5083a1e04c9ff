// CAD edges that turn, and the mesh edges that each needs to look round.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cad/cad.h"

namespace polycube {

/// A CAD edge that turns by enough to need two mesh edges or more, or is a piece of a full circle.
struct RoundEdge {
  int edge = 0;
  double turn = 0;   ///< of its tangent from start to end, radians
  int elements = 0;  ///< at least
  int circle = 0;    ///< the first of the edges that are one full circle together, 0 if it is part of none
  int round = 0;     ///< elements round that circle at least; the pieces may share them out otherwise
  int bore = 0;      ///< the cylinder or cone inside such a circle that looks towards its axis, 0 if there is none
  std::string name;  ///< for the log, such as "Face12: 12 elements round the bore" or "Edge7: 3 elements along the arc"
};

/// `per_circle` elements for every full turn, in proportion for less, at most 8 where the circle is smaller than a hundredth of the diagonal. Ascending by
/// edge; seams and points are none. 0 gives none.
std::vector<RoundEdge> round_edges(const CadModel& model, int per_circle);

/// Times that the cells at each CAD edge are to be divided into three along it, by number.
using EdgeLevels = std::map<int, int>;

/// Edges of bores whose elements a grid of four round the bore gives after that many levels.
EdgeLevels levels_round_bores(const std::vector<RoundEdge>& edges);

/// The edges with so many fewer elements that levels make of them those that are needed.
std::vector<RoundEdge> before_levels(std::vector<RoundEdge> edges, const EdgeLevels& levels);

/// By how many mesh edges each of the round edges falls short, given those that each CAD edge has (by number); a circle as a whole, told at its first edge.
/// Edges without any, which are lost, are left out.
std::vector<int> missing_elements(const std::vector<RoundEdge>& edges, const std::vector<int>& elements);

/// How far the tangent of a CAD edge turns between two parameters, radians.
double edge_turn(const CadModel& model, int edge, double from, double to);

}  // namespace polycube
