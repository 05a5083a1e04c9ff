// Point location in the image of g.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/types.h"

namespace polycube {

/// Uniform grid over boxes.
class BoxGrid {
 public:
  struct Box {
    Vec3 low, high;
  };
  explicit BoxGrid(const std::vector<Box>& boxes);
  /// Indices of boxes that may contain p (ascending); empty outside of all of them.
  std::pair<const int*, const int*> candidates(const Vec3& p) const;

 private:
  std::array<int, 3> cell(const Vec3& p) const;
  int index(const std::array<int, 3>& c) const { return (c[0] * size_[1] + c[1]) * size_[2] + c[2]; }

  Vec3 low_, high_, step_;
  std::array<int, 3> size_{1, 1, 1};
  std::vector<int> first_, items_;
};

/// Barycentric coordinates of p; of a triangle those of the projection along `normal_axis`. A degenerate simplex gives nan or infinities.
std::array<double, 4> tet_coordinates(const std::array<Vec3, 4>& corners, const Vec3& p);
std::array<double, 3> triangle_coordinates(const std::array<Vec3, 3>& corners, const Vec3& p, int normal_axis);

/// Nearest point of a segment: the parameter in [0, 1].
double segment_parameter(const Vec3& a, const Vec3& b, const Vec3& p);

/// Clamps coordinates to the simplex: negative ones to 0, sum to 1.
template <std::size_t N>
std::array<double, N> clamped(std::array<double, N> c) {
  double sum = 0;
  for (double& x : c) sum += x = x > 0 ? x : 0;
  for (double& x : c) x /= sum;
  return c;
}

}  // namespace polycube
