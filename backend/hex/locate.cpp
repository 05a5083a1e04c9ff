#include "hex/locate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace polycube {

BoxGrid::BoxGrid(const std::vector<Box>& boxes) : low_(Vec3::Zero()), high_(Vec3::Zero()), step_(Vec3::Ones()) {
  Vec3 mean = Vec3::Zero();
  if (!boxes.empty()) {
    low_ = boxes.front().low;
    high_ = boxes.front().high;
  }
  for (const Box& box : boxes) {
    low_ = low_.cwiseMin(box.low);
    high_ = high_.cwiseMax(box.high);
    mean += (box.high - box.low) / static_cast<double>(boxes.size());
  }
  // Cells of the boxes' mean size, no more of them than boxes allow for.
  const double limit = std::cbrt(static_cast<double>(boxes.size())) * 2 + 1;
  for (int d = 0; d < 3; ++d) {
    const double width = high_[d] - low_[d];
    const double wanted = mean[d] > 0 ? std::min(width / mean[d], limit) : 1;
    size_[d] = std::max(1, static_cast<int>(wanted));
    step_[d] = width > 0 ? width / size_[d] : 1;
  }
  first_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2] + 1, 0);
  const auto for_cells = [&](const Box& box, const auto& visit) {
    const auto a = cell(box.low), b = cell(box.high);
    for (int i = a[0]; i <= b[0]; ++i) {
      for (int j = a[1]; j <= b[1]; ++j) {
        for (int k = a[2]; k <= b[2]; ++k) visit(index({i, j, k}));
      }
    }
  };
  for (const Box& box : boxes) for_cells(box, [&](int c) { ++first_[c + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  items_.resize(first_.back());
  auto fill = first_;
  for (std::size_t i = 0; i < boxes.size(); ++i) for_cells(boxes[i], [&](int c) { items_[fill[c]++] = static_cast<int>(i); });
}

std::array<int, 3> BoxGrid::cell(const Vec3& p) const {
  std::array<int, 3> c;
  for (int d = 0; d < 3; ++d) c[d] = std::clamp(static_cast<int>((p[d] - low_[d]) / step_[d]), 0, size_[d] - 1);
  return c;
}

std::pair<const int*, const int*> BoxGrid::candidates(const Vec3& p) const {
  const int c = index(cell(p));
  return {items_.data() + first_[c], items_.data() + first_[c + 1]};
}

std::array<double, 4> tet_coordinates(const std::array<Vec3, 4>& corners, const Vec3& p) {
  const auto det = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.cross(b).dot(c); };
  const double whole = det(corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0]);
  const Vec3 q = p - corners[0];
  const double b = det(q, corners[2] - corners[0], corners[3] - corners[0]) / whole;
  const double c = det(corners[1] - corners[0], q, corners[3] - corners[0]) / whole;
  const double d = det(corners[1] - corners[0], corners[2] - corners[0], q) / whole;
  return {1 - b - c - d, b, c, d};
}

std::array<double, 3> triangle_coordinates(const std::array<Vec3, 3>& corners, const Vec3& p, int normal_axis) {
  const int u = (normal_axis + 1) % 3, v = (normal_axis + 2) % 3;
  const auto det = [&](const Vec3& a, const Vec3& b) { return a[u] * b[v] - a[v] * b[u]; };
  const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0], q = p - corners[0];
  const double whole = det(ab, ac);
  const double b = det(q, ac) / whole, c = det(ab, q) / whole;
  return {1 - b - c, b, c};
}

double segment_parameter(const Vec3& a, const Vec3& b, const Vec3& p) {
  const double length = (b - a).squaredNorm();
  return length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0;
}

}  // namespace polycube
