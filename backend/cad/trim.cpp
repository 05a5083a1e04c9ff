// Whether a point of a surface belongs to the trimmed face: even-odd count against the border drawn as segments in (u, v); within a
// segment's margin the border curve itself decides, so the answer is exact up to rounding.
#include <BRepClass_FaceClassifier.hxx>
#include <algorithm>
#include <limits>

#include "cad/shape.h"

namespace polycube {
namespace {

double squared_distance(const BorderSegment& segment, const Vec2& uv) {
  const Vec2 d = segment.b - segment.a;
  const double length = d.squaredNorm();
  const double t = length > 0 ? std::clamp((uv - segment.a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (segment.a + t * d - uv).squaredNorm();
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

bool inside(const CadModel::Shape& shape, const FaceGeometry& face, const Vec2& uv) {
  if (face.border_edges.empty()) return true;
  int crossings = 0;
  std::vector<int> near;
  bool on_seam = false;
  for (const BorderSegment& segment : face.border) {
    const bool below_a = segment.a[1] <= uv[1], below_b = segment.b[1] <= uv[1];
    if (below_a != below_b) {
      const double u = segment.a[0] + (uv[1] - segment.a[1]) / (segment.b[1] - segment.a[1]) * (segment.b[0] - segment.a[0]);
      if (u > uv[0]) ++crossings;
    }
    const bool real = segment.edge != 0 && (near.empty() || near.back() != segment.edge);
    if ((!real && !segment.interior) || squared_distance(segment, uv) > segment.margin * segment.margin) continue;
    if (real) near.push_back(segment.edge);
    on_seam = on_seam || segment.interior;
  }
  if (!near.empty()) return left_of_border(shape, face, uv, near);
  return on_seam || crossings % 2 == 1;
}

}  // namespace polycube
