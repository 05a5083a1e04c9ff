// Hex meshes with association of simple solids, made by hand.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"

namespace polycube {

/// n^3 cells on a box with a corner at the origin; nodes are classified by distance from the CAD entities.
struct Example {
  CadModel model;
  HexMesh mesh;
  Association association;
};

Example box_example(int n);

/// One ring of cells between the axis-parallel square core and the wall of a cylinder of radius 1 and height 1 (an O-grid with a one-cell core):
/// each wall quad spans a quarter of the circle.
Example cylinder_example();

/// Four cells round the bore of radius 1 of a plate, out to nodes at the given radius; they do not fill the plate.
Example bore_example(double outer);

/// One cell for a whole cylinder of radius 1 and height 1: its four quads on the wall meet where the wall is smooth.
Example round_cell_example();

/// Classifies the boundary of `mesh` on `model` by distance; every CAD face is a patch of its own.
Association associate_by_distance(const CadModel& model, const HexMesh& mesh);

}  // namespace polycube
