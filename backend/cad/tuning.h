// What the stage cad chose; what the words mean: core/tuned.h.
#pragma once

#include <numbers>

#include "core/tuned.h"

namespace polycube {

struct CadTuning {
  /// Of the smaller solid's volume: a common part below this is rounding in the file, not an overlap. Guess.
  double overlap = 1e-6;
  /// Of the smaller solid's diagonal: solids so near to each other are meant to touch. Guess.
  double gap = 1e-4;
  /// Segments of a curved border in (u, v). Guess.
  int border_pieces = 48;
  /// Samples of an edge without closed form. Guess.
  int edge_samples = 49;
  /// Samples along a side of the grid of a face without closed form. Guess.
  int face_samples = 24;
  /// Inner points of an edge where the dihedral angle is taken. Guess.
  int angle_samples = 9;
  /// Radians within which a profile's direction counts as along, or across, the axis that it is revolved about. Guess.
  double angular = 1e-9;
  /// mm within which a surface counts as a plane, cone, sphere or torus. Theory: OpenCASCADE's confusion.
  double linear = 1e-7;
  /// Of the way to the middle of a face: where the normals beside a degenerate edge are taken. Guess.
  double tip_offset = 1e-3;
  /// Radians: normals further off their mean are those round a cone's tip, not a sphere's pole. Guess.
  double tip_angle = std::numbers::pi / 18;
  /// Of the diagonal: an edge as short as this, which files of other systems leave between faces that just fail to meet, is far below any cell's size. Guess.
  double tiny_edge = 1e-5;
  /// Newton's steps of a projection. Guess.
  int newton_steps = 60;

  /// Pieces of a border below which a look at all of them is quick enough. Guess.
  int few_pieces = 12;
  /// Pieces for a cell along each side of a border's grid. Guess.
  int pieces_a_cell = 3;
  /// Cells along each side of it, at least. Guess.
  int fewest_cells = 8;
  /// Cells along each side of it, at most: 4 KB. Guess.
  int most_cells = 64;
  /// Of the box of a border: so far off rounding may take a point beside it. Theory: a million times the rounding of doubles.
  double border_rounding = 1e-9;

  POLYCUBE_ENTRIES(overlap, gap, border_pieces, edge_samples, face_samples, angle_samples, angular, linear, tip_offset, tip_angle, tiny_edge, newton_steps,
                   few_pieces, pieces_a_cell, fewest_cells, most_cells, border_rounding)
};

inline constexpr const CadTuning& kCadTuning = tuning_in_force<CadTuning>;

}  // namespace polycube
