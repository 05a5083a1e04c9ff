// Slivers that cutting along borders leaves behind.
#pragma once

#include "core/monitor.h"
#include "label/label.h"

namespace polycube {

/// Charts of a few triangles inside a CAD face that has larger ones take the label that they share most border with, unless the labelling becomes
/// less valid by that (Violations::score of the charts). Faces that the user labelled are left alone: they have one label anyway.
/// Returns the number of charts that went.
int absorb_strays(TetMesh& mesh, Labelling& labelling, const Monitor& monitor);

}  // namespace polycube
