// Integer positions of the charts (paper, sections 3 to 5).
#pragma once

#include <limits>
#include <string>

#include "blocks/blocks.h"
#include "quantize/tuning.h"

namespace polycube {

/// What an engineer asks of the distance between two charts (features included) of one axis: at_least <= value[high] - value[low] <=
/// at_most.
struct DistanceConstraint {
  int low = 0, high = 0;  ///< chart indices
  int at_least = std::numeric_limits<int>::min();
  int at_most = std::numeric_limits<int>::max();
  std::string name;        ///< for messages, e.g. "3 elements between Face2 and Face5"
  bool may_yield = false;  ///< a bound that nobody asked for by name: left out where it contradicts others
};

struct QuantizeOptions {
  double scale = 1;                           ///< eta of section 6.2: target integer distance = scale * distance in the map; near 0 (or 0) gives the coarsest
  std::array<double, 3> axis_scale{1, 1, 1};  ///< factor of scale per direction of the map
  std::vector<double> block_scale;            ///< factor of scale per block (regions); empty: 1
  int min_layers = 1;                         ///< elements at least between two boundary charts opposite each other
  std::vector<DistanceConstraint> constraints;
  /// Integers per chart of a coarser mesh of the same blocks whose cells are to be subdivided: what has no extent there has none, all else
  /// keeps what it has at least. Empty: the best integers.
  std::vector<int> structure;
  bool separate_features = true;                ///< C2 holds for the block vertices on features too, not only on boundary charts
  int node_limit = kQuantizeTuning.node_limit;  ///< of the search tree; past it the best solution found so far, with its gap
};

struct Quantization {
  std::vector<int> value;    ///< per chart (features included); smallest of each axis 0; a feature without sheet has that of the nearest chart
  double objective = 0;      ///< Eq. 4
  double bound = 0;          ///< proved lower bound
  bool optimal = false;      ///< objective is proved: no better solution is left in the tree
  std::vector<int> yielded;  ///< QuantizeOptions::constraints that were left out, ascending
  int c2_rounds = 0;         ///< times a solution was checked against C2
  int cuts = 0;              ///< different C2 constraints that were violated on the way
  int nodes = 0;             ///< of the search tree
  int flows_solved = 0;      ///< flows found from nothing
  int flows_repaired = 0;    ///< flows made from another node's
  double gap() const { return objective > bound ? (objective - bound) / objective : 0; }
};

/// Minimises Eq. 4 under C1 and C2. Past the node limit the best solution found, with optimal false and its gap. Throws InvalidInput when
/// constraints that may not yield contradict each other, naming those that clash; StageFailed when there is no solution even without them.
Quantization quantize(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, const Monitor& monitor);

/// What is wrong with integers given to a block complex; all zero on good ones.
struct QuantizeReport {
  int c1 = 0;            ///< blocks' axes where high < low
  int opposite = 0;      ///< opposite charts nearer than min_layers
  int c2 = 0;            ///< pairs of charts joined by a monotone path of length 0 (distinct ones found; 0 means there is none)
  int constraints = 0;   ///< of the engineer
  double objective = 0;  ///< Eq. 4
  bool good() const { return c1 == 0 && opposite == 0 && c2 == 0 && constraints == 0; }
};
QuantizeReport check(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, const std::vector<int>& value);

}  // namespace polycube
