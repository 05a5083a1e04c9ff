// Whether a point of a surface belongs to the trimmed face: even-odd count against the border drawn as segments in (u, v); within a
// segment's margin the border curve itself decides, so the answer is exact up to rounding.
#include <BRepClass_FaceClassifier.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cad/shape.h"
#include "cad/tuning.h"

namespace polycube {
namespace {

double squared_distance(const BorderSegment& segment, const Vec2& uv) {
  const Vec2 d = segment.b - segment.a;
  const double length = d.squaredNorm();
  const double t = length > 0 ? std::clamp((uv - segment.a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (segment.a + t * d - uv).squaredNorm();
}

// Whether the ray from `uv` along u meets the segment.
bool crosses(const BorderSegment& segment, const Vec2& uv) {
  if ((segment.a[1] <= uv[1]) == (segment.b[1] <= uv[1])) return false;
  return segment.a[0] + (uv[1] - segment.a[1]) / (segment.b[1] - segment.a[1]) * (segment.b[0] - segment.a[0]) > uv[0];
}

// Whether some of the segment is in the box: clipped by its sides one after the other (Liang, Barsky 1984).
bool passes(const BorderSegment& segment, const Eigen::AlignedBox2d& box) {
  double from = 0, to = 1;
  const Vec2 way = segment.b - segment.a;
  for (int d = 0; d < 2; ++d) {
    const double low = box.min()[d] - segment.a[d], high = box.max()[d] - segment.a[d];
    if (way[d] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    from = std::max(from, std::min(low / way[d], high / way[d]));
    to = std::min(to, std::max(low / way[d], high / way[d]));
  }
  return from <= to;
}

bool classify_slowly(const FaceGeometry& face, const Vec2& uv) {
  const BRepClass_FaceClassifier classifier(face.face, gp_Pnt2d(uv[0], uv[1]), 1e-9);
  return classifier.State() == TopAbs_IN || classifier.State() == TopAbs_ON;
}

bool left_of_border(const CadModel::Shape& shape, const FaceGeometry& face, const Vec2& uv, const std::vector<int>& near) {
  const Vec3 point = to_vec(face.surface->Value(uv[0], uv[1]));
  EdgePoint best;
  best.distance = std::numeric_limits<double>::infinity();
  int edge_id = 0;
  for (const int e : near) {
    const EdgePoint candidate = nearest_on_edge(shape.edge(e), point, nullptr);
    if (candidate.distance < best.distance) best = candidate, edge_id = e;
  }
  const EdgeGeometry& edge = shape.edge(edge_id);
  if (best.distance <= 1e-9) return true;
  const double range = edge.last - edge.first;
  const bool at_vertex = best.t - edge.first < 1e-9 * range || edge.last - best.t < 1e-9 * range;
  if (at_vertex) return classify_slowly(face, uv);
  gp_Pnt c;
  gp_Vec tangent;
  edge.curve->D1(best.t, c, tangent);
  for (const EdgeUse& use : edge.uses) {
    if (&shape.face(use.face) != &face) continue;
    const Vec3 left = surface_normal(face, uv).cross(to_vec(tangent)) * (use.forward ? 1 : -1);
    return left.dot(point - best.point) > 0;
  }
  return classify_slowly(face, uv);
}

}  // namespace

BorderGrid::BorderGrid(const std::vector<BorderSegment>& border) {
  if (std::ssize(border) < kCadTuning.few_pieces) return;
  for (const BorderSegment& s : border) {
    box_.extend(s.a);
    box_.extend(s.b);
  }
  const Vec2 size = box_.sizes();
  if (!(size.minCoeff() > 0)) return;
  count_ = std::clamp(static_cast<int>(border.size()) / kCadTuning.pieces_a_cell, kCadTuning.fewest_cells, kCadTuning.most_cells);
  const Vec2 step = size / count_;
  cells_.assign(static_cast<std::size_t>(count_) * static_cast<std::size_t>(count_), Cell::kFar);
  const auto cell = [&](int i, int j) -> Cell& { return cells_[static_cast<std::size_t>(j) * static_cast<std::size_t>(count_) + static_cast<std::size_t>(i)]; };
  for (const BorderSegment& s : border) {
    const Vec2 reach = Vec2::Constant(s.margin) + kCadTuning.border_rounding * size;
    const Eigen::AlignedBox2d round(s.a.cwiseMin(s.b) - reach, s.a.cwiseMax(s.b) + reach);
    const auto first = [&](int d) { return std::clamp(static_cast<int>(std::floor((round.min()[d] - box_.min()[d]) / step[d])), 0, count_ - 1); };
    const auto last = [&](int d) { return std::clamp(static_cast<int>(std::floor((round.max()[d] - box_.min()[d]) / step[d])), 0, count_ - 1); };
    for (int j = first(1); j <= last(1); ++j) {
      for (int i = first(0); i <= last(0); ++i) {
        const Vec2 low = box_.min() + Vec2(i * step[0], j * step[1]);
        if (passes(s, {low - reach, low + step + reach})) cell(i, j) = Cell::kNear;
      }
    }
  }
  // A far cell is as the one before it in its row or below it, if that is far too: no border lies between them.
  for (int j = 0; j < count_; ++j) {
    for (int i = 0; i < count_; ++i) {
      if (cell(i, j) == Cell::kNear) continue;
      if (i > 0 && cell(i - 1, j) != Cell::kNear) {
        cell(i, j) = cell(i - 1, j);
      } else if (j > 0 && cell(i, j - 1) != Cell::kNear) {
        cell(i, j) = cell(i, j - 1);
      } else {
        const Vec2 middle = box_.min() + Vec2((i + 0.5) * step[0], (j + 0.5) * step[1]);
        const auto crossings = std::count_if(border.begin(), border.end(), [&](const BorderSegment& s) { return crosses(s, middle); });
        cell(i, j) = crossings % 2 == 1 ? Cell::kInside : Cell::kOutside;
      }
    }
  }
}

std::optional<bool> BorderGrid::inside(const Vec2& uv) const {
  if (count_ == 0 || !box_.contains(uv)) return {};
  const Vec2 at = (uv - box_.min()).cwiseQuotient(box_.sizes()) * count_;
  const int i = std::min(static_cast<int>(at[0]), count_ - 1), j = std::min(static_cast<int>(at[1]), count_ - 1);
  const Cell cell = cells_[static_cast<std::size_t>(j) * static_cast<std::size_t>(count_) + static_cast<std::size_t>(i)];
  if (cell == Cell::kNear) return {};
  return cell == Cell::kInside;
}

bool inside(const CadModel::Shape& shape, const FaceGeometry& face, const Vec2& uv) {
  const std::optional<bool> known = face.border_grid.inside(uv);
  return known ? *known : inside_by_border(shape, face, uv);
}

bool inside_by_border(const CadModel::Shape& shape, const FaceGeometry& face, const Vec2& uv) {
  if (face.border_edges.empty()) return true;
  int crossings = 0;
  std::vector<int> near;
  bool on_seam = false;
  for (const BorderSegment& segment : face.border) {
    if (crosses(segment, uv)) ++crossings;
    const bool real = segment.edge != 0 && (near.empty() || near.back() != segment.edge);
    if ((!real && !segment.interior) || squared_distance(segment, uv) > segment.margin * segment.margin) continue;
    if (real) near.push_back(segment.edge);
    on_seam = on_seam || segment.interior;
  }
  if (!near.empty()) return left_of_border(shape, face, uv, near);
  return on_seam || crossings % 2 == 1;
}

}  // namespace polycube
