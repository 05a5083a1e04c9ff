#include "unit/fem/fixtures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/hexahedron.h"
#include "support/shapes.h"

namespace polycube {
namespace {

constexpr double kOn = 1e-7;

bool on_face(const CadModel& model, int face, const Vec3& p) { return model.project_to_face(face, p).distance < kOn; }
bool on_edge(const CadModel& model, int edge, const Vec3& p) { return model.project_to_edge(edge, p).distance < kOn; }

/// Four cells of height 1 between two squares with corners on circles about Z. Per level: four inner nodes, four outer ones.
void add_ring(HexMesh& mesh, const Vec3& centre, double inner, double outer) {
  for (int level = 0; level < 2; ++level)
    for (double radius : {inner, outer})
      for (int q = 0; q < 4; ++q) {
        // Quarter turns from the seam, where OCC puts the circle's vertex.
        const double angle = q * std::acos(0.0);
        mesh.points.push_back(centre + Vec3(radius * std::cos(angle), radius * std::sin(angle), level));
      }
  for (int q = 0; q < 4; ++q) {
    const int r = (q + 1) % 4;
    mesh.hexes.push_back({q, 4 + q, 4 + r, r, 8 + q, 12 + q, 12 + r, 8 + r});
  }
}

}  // namespace

Association associate_by_distance(const CadModel& model, const HexMesh& mesh) {
  Association a;
  for (int f = 1; f <= model.face_count(); ++f) a.patches.push_back({f});
  std::map<Quad, std::pair<Quad, int>> seen;
  for (const Hex& hex : mesh.hexes)
    for (const auto& corners : kHexFaces) {
      const Quad quad{hex[corners[0]], hex[corners[1]], hex[corners[2]], hex[corners[3]]};
      Quad key = quad;
      std::sort(key.begin(), key.end());
      auto [it, fresh] = seen.try_emplace(key, quad, 0);
      ++it->second.second;
    }
  std::set<Segment> segments;
  for (const auto& [key, entry] : seen) {
    const auto& [quad, uses] = entry;
    if (uses != 1) continue;
    for (int f = 1; f <= model.face_count(); ++f) {
      if (!std::all_of(quad.begin(), quad.end(), [&](int p) { return on_face(model, f, mesh.points[p]); })) continue;
      a.quads.push_back(quad);
      a.quad_patch.push_back(f - 1);
      break;
    }
    for (int k = 0; k < 4; ++k) segments.insert({std::min(quad[k], quad[(k + 1) % 4]), std::max(quad[k], quad[(k + 1) % 4])});
  }
  for (const Segment& s : segments)
    for (int e = 1; e <= model.edge_count(); ++e) {
      if (model.edge(e).seam || model.edge(e).degenerate || !on_edge(model, e, mesh.points[s[0]]) || !on_edge(model, e, mesh.points[s[1]])) continue;
      a.segments.push_back(s);
      a.segment_edge.push_back(e);
      break;
    }
  a.point_cad.assign(mesh.points.size(), CadRef{3, 1});
  for (std::size_t q = 0; q < a.quads.size(); ++q)
    for (int p : a.quads[q]) a.point_cad[p] = {2, a.quad_patch[q]};
  for (std::size_t s = 0; s < a.segments.size(); ++s)
    for (int p : a.segments[s]) a.point_cad[p] = {1, a.segment_edge[s]};
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    for (int v = 1; v <= model.vertex_count(); ++v)
      if ((model.vertex(v) - mesh.points[p]).norm() < kOn) a.point_cad[p] = {0, v};
  return a;
}

Example box_example(int n) {
  Example example{CadModel::from_brep(shapes::box(2, 3, 4)), {}, {}};
  const auto id = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) example.mesh.points.emplace_back(2.0 * i / n, 3.0 * j / n, 4.0 * k / n);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        Hex& hex = example.mesh.hexes.emplace_back();
        for (int c = 0; c < 8; ++c) {
          const auto& at = kCornerCoordinates[c];
          hex[c] = id(i + at[0], j + at[1], k + at[2]);
        }
      }
  example.association = associate_by_distance(example.model, example.mesh);
  return example;
}

Example cylinder_example() {
  Example example{CadModel::from_brep(shapes::cylinder(1, 1)), {}, {}};
  add_ring(example.mesh, Vec3::Zero(), 0.5, 1);
  example.mesh.hexes.push_back({0, 1, 2, 3, 8, 9, 10, 11});
  example.association = associate_by_distance(example.model, example.mesh);
  return example;
}

Example round_cell_example() {
  Example example{CadModel::from_brep(shapes::cylinder(1, 1)), {}, {}};
  example.mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 1}, {0, 1, 1}, {-1, 0, 1}, {0, -1, 1}};
  example.mesh.hexes = {{0, 1, 2, 3, 4, 5, 6, 7}};
  example.association = associate_by_distance(example.model, example.mesh);
  return example;
}

Example bore_example(double outer) {
  Example example{CadModel::from_brep(shapes::plate_with_hole(4, 4, 1, 1)), {}, {}};
  add_ring(example.mesh, Vec3(2, 2, 0), 1, outer);
  example.association = associate_by_distance(example.model, example.mesh);
  return example;
}

}  // namespace polycube
