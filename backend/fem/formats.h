// One writer per file format. Private to fem.
#pragma once

#include <string>

#include "fem/fem.h"

namespace polycube {

/// For node sets of formats that need distinct names: "Face3_Nodes".
std::string node_group_name(const FemGroup& group);

inline int hex_nodes(const FemMesh& mesh) { return mesh.order == 2 ? 20 : 8; }
inline int quad_nodes(const FemMesh& mesh) { return mesh.order == 2 ? 8 : 4; }
inline int segment_nodes(const FemMesh& mesh) { return mesh.order == 2 ? 3 : 2; }

/// printf onto the end of a string; the line must be shorter than 256 characters.
[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...);

std::string inp_text(const FemMesh& mesh, const std::string& element_type);
std::string unv_text(const FemMesh& mesh);
std::string vtu_text(const FemMesh& mesh);
std::string medit_text(const FemMesh& mesh);
/// Through libmed, which writes files itself. FreeCAD reads the mesh only under the name of its file. Throws std::runtime_error where it fails.
void write_med(const FemMesh& mesh, const std::string& path, const std::string& mesh_name);

}  // namespace polycube
