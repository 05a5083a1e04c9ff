// Which CAD edges a mesh does without, where cells stay faulty (gate.h) with them.
#pragma once

#include "cad/cad.h"
#include "core/monitor.h"
#include "core/options.h"
#include "pad/associate.h"
#include "pad/pad.h"

namespace polycube {

/// Clears the chains of the `count` CAD edges that most nodes of faulty cells stand on: smooth ones first, those on faces to keep last. False if there is
/// none.
bool give_up_edges(const CadModel& model, const FaceList& keep_faces, const PaddedMesh& padded, int count, AssociateOptions& options, const Monitor& monitor);

/// Clears the chains of all CAD edges within `rings` cells of those that are faulty.
void give_up_around(const CadModel& model, const PaddedMesh& padded, int rings, AssociateOptions& options, const Monitor& monitor);

}  // namespace polycube
