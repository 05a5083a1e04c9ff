// Hexahedral meshes of simple solids, made from cells of an integer grid, with the association that the solid's geometry implies.
#pragma once

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <gp_Ax1.hxx>
#include <gp_Trsf.hxx>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "cad/cad.h"
#include "core/hexahedron.h"
#include "core/mesh.h"
#include "support/shapes.h"

namespace polycube::testing {

inline std::string brep_of(const TopoDS_Shape& shape) {
  std::ostringstream text;
  BRepTools::Write(shape, text);
  return text.str();
}

/// A mesh made for a solid: hexes on grid cells, nodes placed by a map of the grid's integer coordinates.
struct Grid {
  std::string brep;
  HexMesh mesh;
  Association association;
};

using Occupied = std::function<bool(int, int, int)>;
using Place = std::function<Vec3(const Vec3&)>;

/// Cells (i, j, k) below `size` that are occupied; the node at integer coordinates x goes to place(x).
inline HexMesh grid_mesh(const std::array<int, 3>& size, const Occupied& occupied, const Place& place) {
  HexMesh mesh;
  std::map<std::array<int, 3>, int> nodes;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        if (!occupied(i, j, k)) continue;
        Hex hex;
        for (int c = 0; c < 8; ++c) {
          const auto& d = kCornerCoordinates[c];
          const std::array<int, 3> at{i + d[0], j + d[1], k + d[2]};
          const auto [it, fresh] = nodes.try_emplace(at, static_cast<int>(mesh.points.size()));
          if (fresh) mesh.points.push_back(place(Vec3(at[0], at[1], at[2])));
          hex[c] = it->second;
        }
        mesh.hexes.push_back(hex);
      }
    }
  }
  return mesh;
}

/// Classes by geometry: a boundary quad belongs to the face all its corners are on, chains run between quads of different faces, every CAD
/// vertex takes the nearest node of a chain.
inline Association associate_by_geometry(const CadModel& model, const HexMesh& mesh) {
  Association a;
  std::map<std::array<int, 4>, std::pair<Quad, int>> faces;
  for (const Hex& hex : mesh.hexes) {
    for (const auto& corners : kHexFaces) {
      Quad quad;
      for (int k = 0; k < 4; ++k) quad[k] = hex[corners[k]];
      std::array<int, 4> key = quad;
      std::sort(key.begin(), key.end());
      auto& entry = faces.try_emplace(key, quad, 0).first->second;
      ++entry.second;
    }
  }
  for (int f = 1; f <= model.face_count(); ++f) a.patches.push_back({f});
  a.point_cad.assign(mesh.points.size(), {3, 1});
  std::map<std::array<int, 2>, std::vector<int>> edges;
  for (const auto& [key, entry] : faces) {
    if (entry.second != 1) continue;
    const Quad& quad = entry.first;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 1; f <= model.face_count(); ++f) {
      double sum = 0;
      for (int node : quad) sum += model.project_to_face(f, mesh.points[node]).distance;
      if (sum < least) {
        least = sum;
        best = f;
      }
    }
    for (int k = 0; k < 4; ++k) {
      a.point_cad[quad[k]] = {2, best - 1};
      edges[{std::min(quad[k], quad[(k + 1) % 4]), std::max(quad[k], quad[(k + 1) % 4])}].push_back(best);
    }
    a.quads.push_back(quad);
    a.quad_patch.push_back(best - 1);
  }
  std::map<int, int> degree;
  for (auto& [nodes, sides] : edges) {
    if (sides[0] == sides[1]) continue;
    std::sort(sides.begin(), sides.end());
    const Vec3 middle = (mesh.points[nodes[0]] + mesh.points[nodes[1]]) / 2;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int e = 1; e <= model.edge_count(); ++e) {
      std::array<int, 2> pair = model.edge(e).faces;
      std::sort(pair.begin(), pair.end());
      if (pair != std::array{sides[0], sides[1]}) continue;
      const double distance = model.project_to_edge(e, middle).distance;
      if (distance < least) {
        least = distance;
        best = e;
      }
    }
    if (best == 0) throw std::logic_error("quads of two faces meet where the solid has no edge");
    a.segments.push_back(nodes);
    a.segment_edge.push_back(best);
    for (int node : nodes) {
      a.point_cad[node] = {1, best};
      ++degree[node];
    }
  }
  for (int v = 1; v <= model.vertex_count(); ++v) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [node, count] : degree) {
      const double distance = (mesh.points[node] - model.vertex(v)).norm();
      if (distance < least && a.point_cad[node].dim != 0) {
        least = distance;
        best = node;
      }
    }
    if (best >= 0) a.point_cad[best] = {0, v};
  }
  return a;
}

inline Grid make_grid(const std::string& brep, const std::array<int, 3>& size, const Occupied& occupied, const Place& place) {
  Grid grid{brep, grid_mesh(size, occupied, place), {}};
  grid.association = associate_by_geometry(CadModel::from_brep(brep), grid.mesh);
  return grid;
}

inline Grid make_grid(const TopoDS_Shape& shape, const std::array<int, 3>& size, const Occupied& occupied, const Place& place) {
  return make_grid(brep_of(shape), size, occupied, place);
}

inline bool everywhere(int, int, int) { return true; }

/// Box 3 x 2 x 1.
inline Grid box_grid(int n = 4) {
  const double h = 1.0 / n;
  return make_grid(BRepPrimAPI_MakeBox(3, 2, 1).Shape(), {3 * n, 2 * n, n}, everywhere, [=](const Vec3& x) -> Vec3 { return h * x; });
}

/// L of legs 2 and thickness 1.
inline Grid l_grid(int n = 4) {
  const TopoDS_Shape shape = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(2, 2, 1).Shape(), BRepPrimAPI_MakeBox(gp_Pnt(1, 1, -1), gp_Pnt(3, 3, 3)).Shape()).Shape();
  const double h = 1.0 / n;
  return make_grid(
      shape, {2 * n, 2 * n, n}, [=](int i, int j, int) { return i < n || j < n; }, [=](const Vec3& x) -> Vec3 { return h * x; });
}

// The square [-1, 1]^2 to the unit disk, radially.
inline Vec2 square_to_disk(const Vec2& p) {
  const double longest = p.cwiseAbs().maxCoeff();
  return p.norm() > 0 ? Vec2(p * longest / p.norm()) : p;
}

/// Cylinder of radius 1 and height 2 along z, n cells a side.
inline Grid cylinder_grid(int n = 6) {
  return make_grid(BRepPrimAPI_MakeCylinder(1, 2).Shape(), {n, n, n}, everywhere, [=](const Vec3& x) -> Vec3 {
    const Vec2 p = square_to_disk(2.0 / n * x.head<2>() - Vec2::Ones());
    return {p[0], p[1], 2.0 * x[2] / n};
  });
}

/// Unit ball, n cells a side.
inline Grid ball_grid(int n = 6) {
  return make_grid(BRepPrimAPI_MakeSphere(1).Shape(), {n, n, n}, everywhere, [=](const Vec3& x) -> Vec3 {
    const Vec3 p = 2.0 / n * x - Vec3::Ones();
    return p.norm() > 0 ? Vec3(p * p.cwiseAbs().maxCoeff() / p.norm()) : p;
  });
}

/// Plate 4 x 4 x 1 with a bore of radius 1 in the middle; n cells across the bore.
inline Grid plate_grid(int n = 4) {
  const TopoDS_Shape bore = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(2, 2, -1), gp_Dir(0, 0, 1)), 1, 3).Shape();
  const TopoDS_Shape shape = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(4, 4, 1).Shape(), bore).Shape();
  const int side = 2 * n, first = n / 2, last = first + n;
  return make_grid(
      shape, {side, side, n / 2}, [=](int i, int j, int) { return i < first || i >= last || j < first || j >= last; },
      [=](const Vec3& x) -> Vec3 {
        Vec2 p = 4.0 / side * x.head<2>() - Vec2(2, 2);
        const double longest = p.cwiseAbs().maxCoeff();  // 1 on the bore, 2 outside
        const double onto = std::clamp(2 - longest, 0.0, 1.0);
        p = (1 - onto) * p + onto * p * longest / p.norm();
        return {p[0] + 2, p[1] + 2, x[2] / (n / 2)};
      });
}

/// Cube of edge 4 with all edges rounded by radius 1, n cells an edge, n a multiple of 4.
inline Grid filleted_grid(int n = 8) {
  return make_grid(shapes::filleted_box(4, 1), {n, n, n}, everywhere, [=](const Vec3& x) -> Vec3 {
    const Vec3 p = 4.0 / n * x, core = p.cwiseMax(1).cwiseMin(3), d = p - core;
    return d.norm() > 0 ? Vec3(core + d * d.cwiseAbs().maxCoeff() / d.norm()) : p;
  });
}

/// Cylinder of radius 1 and height 1 on a plate 4 x 4 x 1: a smooth boss.
inline Grid boss_grid(int n = 4) {
  const TopoDS_Shape boss = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(2, 2, 0.5), gp_Dir(0, 0, 1)), 1, 1.5).Shape();
  const TopoDS_Shape shape = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(4, 4, 1).Shape(), boss).Shape();
  const int side = 2 * n, first = n / 2, last = first + n;
  return make_grid(
      shape, {side, side, n}, [=](int i, int j, int k) { return k < n / 2 || (i >= first && i < last && j >= first && j < last); },
      [=](const Vec3& x) -> Vec3 {
        Vec2 p = 4.0 / side * x.head<2>() - Vec2(2, 2);
        const double longest = p.cwiseAbs().maxCoeff();
        const double onto = std::clamp(2 - longest, 0.0, 1.0);
        if (longest > 0) p = (1 - onto) * p + onto * p * longest / p.norm();
        return {p[0] + 2, p[1] + 2, x[2] / (n / 2)};
      });
}

/// Box 4 x 4 x 1 whose top face is split by a circle of radius r round its middle; the grid does not follow the circle.
inline Grid imprint_grid(int n = 16, double r = 1.2) {
  const TopoDS_Shape disk = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(2, 2, 0.5), gp_Dir(0, 0, 1)), r, 0.5).Shape();
  const TopoDS_Shape shape = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(4, 4, 1).Shape(), disk).Shape();
  const double h = 4.0 / n;
  return make_grid(shape, {n, n, n / 4}, everywhere, [=](const Vec3& x) -> Vec3 { return h * x; });
}

}  // namespace polycube::testing
