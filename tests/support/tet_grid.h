// A box of nx x ny x nz cells cut into six tets each (Kuhn), with its boundary; every side is one CAD face: 1..6 = +X -X +Y -Y +Z -Z.
#pragma once

#include <algorithm>
#include <map>

#include "core/mesh.h"

namespace polycube {

inline TetMesh tet_grid(int nx, int ny, int nz, double size = 1) {
  TetMesh mesh;
  const auto node = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        mesh.points.push_back(size * Vec3(i, j, k));
        mesh.point_cad.push_back({3, 1});
      }
    }
  }
  constexpr std::array<std::array<int, 3>, 6> kOrders{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  std::map<Triangle, std::pair<Triangle, int>> open;  // sorted facet -> outward facet, times seen
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        for (std::size_t o = 0; o < kOrders.size(); ++o) {
          std::array<int, 3> at{i, j, k};
          Tet tet{node(i, j, k)};
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[static_cast<std::size_t>(kOrders[o][s])];
            tet[s + 1] = node(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(tet[2], tet[3]);  // odd orders are mirrored
          mesh.tets.push_back(tet);
          for (const Triangle& f :
               {Triangle{tet[1], tet[2], tet[3]}, Triangle{tet[0], tet[3], tet[2]}, Triangle{tet[0], tet[1], tet[3]}, Triangle{tet[0], tet[2], tet[1]}}) {
            Triangle key = f;
            std::sort(key.begin(), key.end());
            ++open.try_emplace(key, f, 0).first->second.second;
          }
        }
      }
    }
  }
  const Vec3 top = size * Vec3(nx, ny, nz);
  for (const auto& [key, facet] : open) {
    if (facet.second != 1) continue;
    mesh.triangles.push_back(facet.first);
    for (int d = 0; d < 3; ++d) {
      const auto all = [&](double x) { return std::all_of(key.begin(), key.end(), [&](int n) { return std::abs(mesh.points[n][d] - x) < 1e-12; }); };
      if (all(top[d]))
        mesh.triangle_face.push_back(2 * d + 1);
      else if (all(0))
        mesh.triangle_face.push_back(2 * d + 2);
    }
  }
  return mesh;
}

}  // namespace polycube
