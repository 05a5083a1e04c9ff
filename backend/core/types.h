// Basic value types shared by every stage.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace polycube {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A CAD entity by dimension (0 vertex, 1 edge, 2 face, 3 solid) and FreeCAD's 1-based number (Face3 is {2, 3}).
struct CadRef {
  int dim = 3;
  int id = 1;
  friend bool operator==(const CadRef&, const CadRef&) = default;
  friend auto operator<=>(const CadRef&, const CadRef&) = default;  // NOLINT(modernize-use-nullptr)
};

}  // namespace polycube
