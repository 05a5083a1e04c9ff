// What the pipeline chose, its search aside; what the words mean: core/tuned.h.
#pragma once

#include <cstddef>

#include "core/tuned.h"

namespace polycube {

struct PipelineTuning {
  /// Of a cell: so much too long a layer is none more. Theory: the map stretches by as much.
  double slack = 0.05;
  /// Of an element: shares that exceed a whole number by less need none more. Guess.
  double share_slack = 0.1;
  /// Of the longest to the shortest edge of a cell. Theory: the most that solvers take without a warning.
  double widest_aspect = 10;
  /// Sizes: cells as short as this do not ask those beside them to be less long. Measured: without a limit some of 27 parts had a hundred times their cells,
  /// since a sheet goes through the whole part; with a 30th, and a 10th for the next, up to 1.6 times as many.
  double thinnest = 1.0 / 20;
  /// Sizes: from shorter cells others do not grow. Measured: with the one before.
  double smallest = 1.0 / 5;
  /// Times its cells that a layer gets at once for what stands beside it. Guess.
  int most_rounds = 100;
  /// Of an element: so much too long an arc needs none more, be it for rounding or what Boolean operations leave of 90 degrees. Guess.
  double circle_slack = 0.1;
  /// Diameter of small circles, in diagonals. Guess.
  double small_circle = 1.0 / 100;
  /// Elements enough round small circles. Guess.
  int per_small_circle = 8;
  /// Elements that go round a bore at least. Theory: a grid has four sides round a hole.
  int fewest_round = 4;
  /// Turns that an edge needs elements for; more of them are noise of a spline. Guess.
  double most_turns = 4;
  /// Steps along an edge. Theory: as many as keep the turn of one below 90 degrees where the edge goes round as often as that.
  int turn_steps = 16;
  /// Radians within which a circle of several edges closes. Guess.
  double closed = 0.01;
  /// Diagonals within which the centres of such edges are one. Guess.
  double same_centre = 1e-5;
  /// Labellings of several solids that are tried until one has a complete mesh with good cells, as a quick search of one solid does. Guess.
  int conform_labellings = 4;
  /// Paddings of each that are fitted. Guess.
  int conform_fits = 3;
  /// Ways to lay layers through several solids that are fitted. Measured: on 8 parts the first was the best each time.
  std::size_t conform_across = 1;
  /// Of the map's extent: nodes nearer to a chart's plane are on it. Theory: they are put there to rounding.
  double on_plane = 1e-6;
  /// Times a size asked for that cells may be off it before that is told. Theory: an edge of one and a half cells gets one or two.
  double size_rounding = 1.5;
  /// Of the diagonal: below this a mesh edge is none. Guess.
  double shortest_edge = 1e-8;
  /// Cosine of the bend of a zigzag, 35 degrees. Theory: a boundary along generators, CAD edges or 45 degree lines bends less.
  double zigzag = 0.82;
  /// Times that the integers are found anew for what stands beside each other. Guess.
  int neighbour_rounds = 3;
  /// How far off a number of cells that was asked for may be without padding, as a logarithm. Guess.
  double count_miss = 0.04;
  /// Power of the number of cells that the scale goes with. Theory: a third, and more where bounds hold some of them.
  double count_power = 0.4;
  /// Times that the scale may be off what it was at first. Guess.
  double count_reach = 8;
  /// Scales that are tried. Guess.
  int count_rounds = 8;
  /// Of the cells asked for: when more besides are divided for a region to be convex, that is told. Guess.
  double much_of_asked = 1.0 / 3;
  /// Of all cells: the same. Guess.
  double much_of_all = 0.1;
  /// Times the seconds that the gate took with the best mesh: what is kept of the time limit to hand it out. Measured: elements of second order and the file
  /// took up to 16 times as long on the example parts.
  double finishing = 20;
  /// Share of the time limit after which a search without a mesh looks for any; the last ways take some fits too. Guess.
  double hurry = 0.5;
  /// mm: edge of the cube that has the posed part's volume. Theory: within what OpenCASCADE's absolute tolerances are made for.
  double posed_size = 100;
  /// mm in the pose. Theory: a hundredth of OpenCASCADE's confusion, a thousand times the noise of coordinates with 15 digits.
  double grid = 1e-9;
  /// Samples of a CAD edge for the pose. Guess.
  int pose_samples = 7;
  /// Frames of the labels that are tried for the pose. Guess.
  std::size_t frames = 3;
  /// Relative: shapes are as symmetric as this. Guess.
  double tie = 1e-6;
  /// Times that features are given up for the folds that they add. Guess.
  int realise_rounds = 4;
  /// Folds that features may add in all. Guess.
  int few_folds = 5;
  /// Times the folds of the labelling that folds least, and few_folds more: what one with fewer regions square to their axes may have. Measured: CTC 01 of NIST
  /// loses an edge with 23 folds and four such fillets, or with 25 folds and none but others divided; with 37 folds and none it loses nothing.
  int facing_folds = 2;
  /// Of the tets: but no more than this. Measured: a labelling of CTC 01 that folds .0003 of them loses nothing, one of a block of MFCAD (1-1-1-6-10-23) that
  /// folds .0009 leaves 19 cells inverted, and all edges are given up.
  double facing_share = 5e-4;
  /// Cosine of the angle between the outward normals at the two sides of a wall. Theory: tapered ones up to 60 degrees count, the corner of a layer that
  /// padding put under two faces does not.
  double opposite = -0.5;
  /// Labellings whose maps are compared. Guess.
  std::size_t mapped = 4;
  /// Flipped tets that the blocks bear. Guess.
  int few_flips = 50;

  /// Scaled Jacobian below which a mesh is none. Theory: such cells are turned over by rounding, on the way back to the part's place and in the decimals of a
  /// file.
  double flattest = 1e-5;

  POLYCUBE_ENTRIES(slack, share_slack, widest_aspect, thinnest, smallest, most_rounds, circle_slack, small_circle, per_small_circle, fewest_round, most_turns,
                   turn_steps, closed, same_centre, conform_labellings, conform_fits, conform_across, on_plane, size_rounding, shortest_edge, zigzag,
                   neighbour_rounds, count_miss, count_power, count_reach, count_rounds, much_of_asked, much_of_all, finishing, hurry, posed_size, grid,
                   pose_samples, frames, tie, realise_rounds, few_folds, facing_folds, facing_share, opposite, mapped, few_flips, flattest)
};

inline constexpr const PipelineTuning& kPipelineTuning = tuning_in_force<PipelineTuning>;

}  // namespace polycube
