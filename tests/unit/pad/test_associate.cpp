#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/charts.h"
#include "pad/associate.h"
#include "support/grids.h"
#include "support/shapes.h"

namespace polycube {
namespace {

// A box of 12 x 8 x 4 with a square from (0.4, 0.4) to (2.4, 2.4) drawn on its top and cells of 1, none of whose nodes are on the square.
// The surface triangles are made by hand, the sides of the box are the charts.
struct Drawn {
  CadModel model = CadModel::from_brep(shapes::box_with_square(12, 8, 4, 0.4, 2.4));
  TetMesh tets;
  std::vector<Chart> charts;
  AssociateOptions options;
  testing::Grid grid = testing::box_grid(4);
  std::vector<int> quad_chart, quad_triangle;

  int point_at(const Vec3& p) {
    for (std::size_t i = 0; i < tets.points.size(); ++i) {
      if ((tets.points[i] - p).norm() < 1e-9) return static_cast<int>(i);
    }
    return -1;
  }

  Drawn() {
    for (double z : {0, 4}) {
      for (double y : {0, 8}) {
        for (double x : {0, 12}) tets.points.emplace_back(x, y, z);
      }
    }
    const std::array<double, 2> in{0.4, 2.4};
    for (double y : in) {
      for (double x : in) tets.points.emplace_back(x, y, 4);
    }
    const auto quad = [&](int a, int b, int c, int d) {
      tets.triangles.push_back({a, b, c});
      tets.triangles.push_back({a, c, d});
    };
    quad(0, 2, 3, 1), quad(0, 1, 5, 4), quad(2, 6, 7, 3), quad(0, 4, 6, 2), quad(1, 3, 7, 5);
    quad(8, 9, 11, 10), quad(4, 5, 9, 8), quad(5, 7, 11, 9), quad(7, 6, 10, 11), quad(6, 4, 8, 10);
    std::vector<int> labels;
    for (const Triangle& t : tets.triangles) {
      const Vec3 normal = (tets.points[t[1]] - tets.points[t[0]]).cross(tets.points[t[2]] - tets.points[t[0]]).normalized();
      const Vec3 centre = (tets.points[t[0]] + tets.points[t[1]] + tets.points[t[2]]) / 3;
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(normal[axis]) > 0.5) labels.push_back(2 * axis + (normal[axis] < 0));
      }
      int face = 1;
      for (int f = 2; f <= model.face_count(); ++f) {
        if (model.project_to_face(f, centre).distance < model.project_to_face(face, centre).distance) face = f;
      }
      tets.triangle_face.push_back(face);
    }
    charts = find_charts(tets.triangles, labels);
    for (const Vec3& p : tets.points) {
      for (int v = 1; v <= model.vertex_count(); ++v) {
        if ((model.vertex(v) - p).norm() < 1e-9) tets.point_cad.push_back({0, v});
      }
    }
    options.size = 1;
    options.edge_chains.resize(static_cast<std::size_t>(model.edge_count()) + 1);
    for (int e = 1; e <= model.edge_count(); ++e) {
      for (int v : model.edge(e).vertices) options.edge_chains[e].push_back(point_at(model.vertex(v)));
    }
    for (Vec3& p : grid.mesh.points) p *= 4;
    for (const Quad& q : grid.association.quads) {
      Vec3 centre = Vec3::Zero();
      for (int n : q) centre += grid.mesh.points[n] / 4;
      int nearest = 0;
      double least = 1e9;
      for (int t = 0; t < static_cast<int>(tets.triangles.size()); ++t) {
        const auto& [a, b, c] = tets.triangles[t];
        const Vec3 normal = (tets.points[b] - tets.points[a]).cross(tets.points[c] - tets.points[a]).normalized();
        const double away = std::abs(normal.dot(centre - tets.points[a])) + 1e-3 * ((tets.points[a] + tets.points[b] + tets.points[c]) / 3 - centre).norm();
        if (away < least) {
          least = away;
          nearest = t;
        }
      }
      quad_triangle.push_back(nearest);
      for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
        if (std::find(charts[c].triangles.begin(), charts[c].triangles.end(), nearest) != charts[c].triangles.end()) quad_chart.push_back(c);
      }
    }
  }
};

// The corner of the square is nearest to a node of the cube's edge, which that edge has to pass.
TEST(Associate, VerticesInsideAChartLeaveItsBoundaryToOthers) {
  Drawn part;
  ASSERT_EQ(part.charts.size(), 6u);
  ASSERT_EQ(part.tets.point_cad.size(), part.tets.points.size());
  const HexBoundary boundary{part.grid.mesh.points, part.grid.association.quads, part.quad_chart, part.quad_triangle};
  const Association found = associate(part.model, part.tets, part.charts, boundary, part.options, Monitor{});
  EXPECT_TRUE(found.lost_edges.empty());
  EXPECT_TRUE(found.lost_vertices.empty());
  int corners = 0;  // of the square
  for (std::size_t n = 0; n < found.point_cad.size(); ++n) {
    const Vec3& p = part.grid.mesh.points[n];
    if (found.point_cad[n].dim != 0) continue;
    const Vec3 v = part.model.vertex(found.point_cad[n].id);
    if (v[0] == 0 || v[0] == 12) continue;
    ++corners;
    for (int k = 0; k < 2; ++k) EXPECT_GT(p[k], 0.5) << v.transpose();
  }
  EXPECT_EQ(corners, 4);
}

// A side of the square goes round by the nodes that a solid on the other side of it has there.
TEST(Associate, TakesPathsThatAreGiven) {
  Drawn part;
  const HexBoundary boundary{part.grid.mesh.points, part.grid.association.quads, part.quad_chart, part.quad_triangle};
  const auto node_at = [&](double x, double y) {
    const auto& points = part.grid.mesh.points;
    return static_cast<int>(std::find_if(points.begin(), points.end(), [&](const Vec3& p) { return (p - Vec3(x, y, 4)).norm() < 1e-9; }) - points.begin());
  };
  int edge = 0;
  for (int e = 1; e <= part.model.edge_count(); ++e) {
    const auto& [a, b] = part.model.edge(e).vertices;
    if (std::abs(part.model.vertex(a)[0] - 2.4) < 1e-9 && std::abs(part.model.vertex(b)[0] - 2.4) < 1e-9) edge = e;
  }
  ASSERT_GT(edge, 0);
  std::vector<int> path{node_at(2, 1), node_at(3, 1), node_at(3, 2), node_at(2, 2)};
  if (part.model.vertex(part.model.edge(edge).vertices[0])[1] > 1) std::reverse(path.begin(), path.end());
  part.options.given_paths[edge] = path;
  const Association found = associate(part.model, part.tets, part.charts, boundary, part.options, Monitor{});
  EXPECT_TRUE(found.lost_edges.empty());
  std::vector<int> nodes{path.front()};
  for (std::size_t s = 0; s < found.segments.size(); ++s) {
    if (found.segment_edge[s] == edge) nodes.push_back(found.segments[s][1]);
  }
  EXPECT_EQ(nodes, path);
  EXPECT_EQ(found.point_cad[path.front()], (CadRef{0, part.model.edge(edge).vertices[0]}));
  EXPECT_EQ(found.point_cad[path.back()], (CadRef{0, part.model.edge(edge).vertices[1]}));
}

}  // namespace
}  // namespace polycube
