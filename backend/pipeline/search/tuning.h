// What the search over plans chose; what the words mean: core/tuned.h.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "core/tuned.h"

namespace polycube {

struct SearchTuning {
  /// Times that edges are given up for one draft. Guess.
  int surrender_rounds = 5;
  /// Rings round its inverted cells in which they are. Guess.
  int surrender_rings = 4;
  /// Of the diagonal: a larger size may be too coarse for the edges of the part. Guess.
  double coarse = 1.0 / 25;
  /// Factors then on the number of cells along an edge, the first of which counts with which every CAD edge finds its path. Guess.
  std::array<double, 3> finer{1.25, 1.6, 2.0};
  /// Divisions of the grid one after the other at one vertex. Theory: for as many CAD edges more than a corner of the grid has.
  int room_rounds = 3;
  /// Number of cells: up to this much off it is no other. Guess.
  double count_miss = 0.04;
  /// How far off the one that was asked for it may be with padding. Guess.
  double padded_miss = 0.1;
  /// Times that it is tried to come nearer to it. Guess.
  int recounts = 2;
  /// Times that round CAD edges get more cells. Guess.
  int rounding_rounds = 2;
  /// Cells of the whole grid from which bores may be refined locally instead. Guess.
  double many_cells = 3000;
  /// Times the cells that the grid has without the bores: if they ask for more. Guess.
  double carried = 3;
  /// Of the cells: if it takes at most so many. Theory: refined cells are of a scaled Jacobian of .5, those of the grid near to 1.
  double local_share = 0.5;
  /// Scale of the coarsest mesh. Theory: small enough that only the bounds count (eta of section 6.2).
  double coarsest = 1e-6;
  /// Radians: CAD edges whose faces meet within this of smooth are given up first. Guess.
  double smooth_bend = std::numbers::pi / 6;
  /// Ways to label the part that are tried on one grid. Guess.
  std::size_t labellings = 4;
  /// Those that are tried on other grids before the rest is tried on one. Guess.
  std::size_t best_labellings = 2;
  /// A finer grid, on the number of cells along an edge: whether a thin strip gets one cell or two can decide over the whole mesh. Guess.
  double finer_grid = 1.25;
  /// Size of another tet mesh, which gives a slightly other map, and with it other strips. Guess.
  double other_tets = 0.8;
  /// Radians: edges that bend less are left out by the plan that keeps sharp ones only. Guess.
  double sharp_bend = std::numbers::pi / 18;
  /// Scaled Jacobian good enough to stop looking for a better mesh; half of it is after some patience. Guess.
  double good_scaled_jacobian = 0.2;
  /// A worst cell below counts as half a CAD edge. Guess.
  double poor_scaled_jacobian = 0.05;
  /// Below it a mesh is worth less than one that has fewer cells through walls and round circles. Measured: i20 has .07 with three layers, .26 without; parts
  /// that the CAD itself holds down (i22) stay above it.
  double squeezed_scaled_jacobian = 0.1;
  /// Seconds that padding and fitting a cell of the grid take. Measured: 3e-4 on two cores, for two paddings of 57 thousand cells on a grid of 46 thousand (CTC
  /// 01 of NIST).
  double cell_seconds = 3e-4;
  /// Of the time left: what a plan may take while there is no mesh. Theory: three plans one after the other get .7, .21 and .06 of it; the first is the one
  /// that is wanted, those after it are cheaper.
  double time_share = 0.7;
  /// Scaled Jacobian that rings round bores may cost the worst cell. Theory: as much as another order of the same work does.
  double ring_loss = 0.02;

  POLYCUBE_ENTRIES(surrender_rounds, surrender_rings, coarse, finer, room_rounds, count_miss, padded_miss, recounts, rounding_rounds, many_cells, carried,
                   local_share, coarsest, smooth_bend, labellings, best_labellings, finer_grid, other_tets, sharp_bend, good_scaled_jacobian,
                   poor_scaled_jacobian, squeezed_scaled_jacobian, cell_seconds, time_share, ring_loss)
};

inline constexpr const SearchTuning& kSearchTuning = tuning_in_force<SearchTuning>;

}  // namespace polycube
