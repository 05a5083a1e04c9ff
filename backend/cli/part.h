// Reading the part named on the command line.
#pragma once

#include <string>

#include "cad/cad.h"

namespace polycube {

/// .step, .stp, .brep, .brp, or a FreeCAD document (.FCStd). A document must hold one solid that nothing else is built from, or `object`
/// names (or labels) the one to take. Throws InvalidInput, one line.
CadModel read_part(const std::string& path, const std::string& object);

}  // namespace polycube
