// What the stage pad chose; what the words mean: core/tuned.h.
#pragma once

#include <numbers>

#include "core/tuned.h"

namespace polycube {

struct PadTuning {
  /// Gain that a choice of layers may have less than the best. Theory: it leaves two cells flat that the best does not.
  double hopeless = 2500;
  /// Cell sizes: paths further from their CAD edge are no capture of it. Guess.
  double reach = 3;
  /// Cell sizes: a node as near as this to a CAD vertex is its image. Theory: where both are at one point of the grid their places are the same but for
  /// rounding.
  double same_place = 1e-3;
  /// Cell sizes that a quad too many or too few between two CAD edges at a vertex costs. Guess.
  double spoke_price = 0.5;
  /// Cell sizes of deviation: the blame for a path all of which runs in other charts than its CAD edge. Guess.
  double astray_blame = 10;
  /// Cell sizes that a chart too many at the node of a vertex costs, for each round in which an edge of the vertex found no path. Guess.
  double surplus_price = 0.2;
  /// Rounds of routing. Guess.
  int rounds = 24;
  /// Those without success after which it ends. Guess.
  int patience = 8;
  /// Radians: across a wider edge a layer cannot end, for its one cell there would be too flat. Guess.
  double widest_end = 130 * std::numbers::pi / 180;
  /// Radians: from here on an edge is concave, so that a layer can go on into the solid. Guess.
  double concave = 215 * std::numbers::pi / 180;
  /// angle_cost from which an edge of a smooth region is at fault. Theory: cells of 148 degrees or more.
  double bad_edge = 0.9;
  /// Price of a quad among layers that mend a region. Guess.
  double small_price = 0.002;
  /// What a padded quad must bring for a region to be looked at. Theory: a bore's four lines of three cells (60 degrees each) are not worth a layer, one line
  /// of one cell (180 degrees) is.
  double quad_price = 0.15;
  /// Times that a band takes in more of its region to be opened. Guess.
  int band_repairs = 5;
  /// Radians: a cell this wide is flat. Guess.
  double widest = 150 * std::numbers::pi / 180;
  /// Price of a hex below the boundary that touches it along two edges from one node. Theory: that corner is flat, as at the angle before.
  double sunk = 1000;
  /// Price of a flat inner corner, over its sine. Theory: some 100 where the CAD edge turns by 20 degrees, 1200 where it is straight.
  double flat_inside = 35;
  /// Radians off 0 or a full turn: whether edges that leave in one direction bound a cusp is for their curvature to tell. Guess.
  double cusp = 0.02;
  /// Radians: a corner below this is too narrow for a second cell; above the crescents of 28 degrees of i04 and i20, where one cell does better. Guess.
  double one_cell = 32 * std::numbers::pi / 180;
  /// Cells along the side of the block that gets the layer; fewer where these do not fit. Measured: 1, 2, 3 and 5 give a bevelled cube a min scaled Jacobian of
  /// .437, .482, .451, .480, its like in an L .368, .467, .451, .474.
  int room_width = 2;
  /// angle_cost from which a sector is worth a sheet. Theory: below about 32 or above 148 degrees a quad.
  double bad_sector = 0.9;
  /// What a sheet round one node has to gain more than a longer one. Theory: half of what a flat cell costs.
  double flat = 500;
  /// Radians: one quad in a corner as wide as this is lost, which a sheet round the node alone mends. Measured: at corners of 169 degrees between arcs that
  /// makes the cells beside it worse (i09).
  double straight_angle = 175 * std::numbers::pi / 180;
  /// Gain of a sheet at least. Guess.
  double least_gain = 0.3;
  /// Radians that a border turns at most where a sheet may follow it. Guess.
  double straight = 2 * std::numbers::pi / 12;
  /// Border nodes on each side of a bad one, for the shortest sheets. Guess.
  int sheet_reach = 4;
  /// Sheets in all. Guess.
  int max_sheets = 400;
  /// Times that a sheet takes in more hexes of its patch to be opened. Guess.
  int sheet_repairs = 5;
  /// Weight of edges inside, which have room to give way. Guess.
  double inner_weight = 0.3;
  /// Price of a hex. Guess.
  double hex_price = 0.002;
  /// Radians, and of the radius: axes and radii of faces of one cylinder differ by less. Guess.
  double same_axis = 1e-5;
  /// Radians between neighbouring quads from which a wall does not go all round. Theory: four elements a circle are 90 degrees apart.
  double widest_gap = 100 * std::numbers::pi / 180;
  /// Radians of a bore that symmetry leaves, at least, for rings. Theory: a quarter, but for the map's roundness.
  double least_arc = 80 * std::numbers::pi / 180;
  /// Elements round a bore below which it gets no rings. Guess.
  double least_round = 7.5;
  /// Radii from a bore straight into the solid to the next boundary: less and they get none. Theory: rings up to 1.4 radii take half of it.
  double bore_room = 0.8;
  /// Rows of cells along a bore for it to get rings. Measured: i09 has bores of one row, whose rings counted as walls of one cell.
  double bore_rows = 1.5;
  /// Radii that the rings of a bore are thick, of cells about as long as wide, two at least. Theory: the stress beside a hole falls to half by 1.4 radii.
  double ring_share = 0.4;
  /// Layers round the square inside a cylinder, of the cells along its side. Theory: evenly spread, the square's sides then are at .55 of the radius.
  double core_share = 0.4;
  /// Radii of the bore up to which a tube gets as many cells outside as inside. Theory: up to 1.7 times as long.
  double thick_tube = 1.7;
  /// Cosine of 120 degrees: nodes of a quad on a cylinder further apart round it cut it off. Theory: four round a circle are 90 degrees each, three 120.
  double cut_off = -0.5;
  /// Elements round the bore of such a tube at least. Theory: as many as a circle gets.
  double radial_round = 11.5;
  /// Of the boundary that a layer lies under: the least that belongs to the wall for which it is divided. Guess.
  double own_share = 0.5;
  /// Cells beyond the rings of a bore that are spread with them. Guess.
  int spread_depth = 3;
  /// Rounds of spreading. Measured: over-relaxed by 1.4 and 1.7 they bring n05 from a min scaled Jacobian of .635 to .613 and to inverted cells.
  int spread_rounds = 60;
  /// Cells along the side of the square in a cylinder above which its layer stays as it is: these rounds would not take it far enough. Guess.
  int most_core = 24;
  /// Rings round a bore at most. Guess.
  int most_rings = 8;

  POLYCUBE_ENTRIES(hopeless, reach, same_place, spoke_price, astray_blame, surplus_price, rounds, patience, widest_end, concave, bad_edge, small_price,
                   quad_price, band_repairs, widest, sunk, flat_inside, cusp, one_cell, room_width, bad_sector, flat, straight_angle, least_gain, straight,
                   sheet_reach, max_sheets, sheet_repairs, inner_weight, hex_price, same_axis, widest_gap, least_arc, least_round, bore_room, bore_rows,
                   ring_share, core_share, thick_tube, cut_off, radial_round, own_share, spread_depth, spread_rounds, most_core, most_rings)
};

inline constexpr const PadTuning& kPadTuning = tuning_in_force<PadTuning>;

}  // namespace polycube
