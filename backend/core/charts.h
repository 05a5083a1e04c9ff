// Charts of a labelled boundary.
#pragma once

#include "core/mesh.h"

namespace polycube {

/// Labels are 0..5 = +X -X +Y -Y +Z -Z of the frame in use.
inline int label_axis(int label) { return label / 2; }
inline int label_sign(int label) { return label % 2 == 0 ? 1 : -1; }

/// Red, green, blue (0 to 255) that a label has in every picture: opposite directions have opposite hues.
std::array<unsigned char, 3> label_colour(int label);

/// For every triangle the neighbour across edge k (corner k to k+1), -1 at a border. Throws std::invalid_argument where more than two
/// triangles share an edge.
std::vector<std::array<int, 3>> triangle_neighbours(const std::vector<Triangle>& triangles);

/// Connected components (across edges) of equally labelled triangles, in the order of their first triangle.
/// Fills axis, sign, triangles, nodes; value stays 0.
std::vector<Chart> find_charts(const std::vector<Triangle>& triangles, const std::vector<int>& labels);

}  // namespace polycube
