// What the mesher offers, for programs that use it without linking it.
#pragma once

#include <string>

namespace polycube {

/// JSON object, indented, one line end at its end: "options" (the table of core/options.h, in its order), "label_names" and "label_colours"
/// (red, green, blue, 0 to 255) by label, "smesh_hex20" (fem/fem.h). The workbench's engine.json is this text.
std::string describe_engine();

/// JSON object, indented: every value in force of the stages' tuning.h by name, such as "pad.hopeless".
std::string describe_tuning();

}  // namespace polycube
