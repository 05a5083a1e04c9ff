#include "tet/split.h"

#include <algorithm>
#include <map>
#include <set>

#include "tet/classify.h"

namespace polycube {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Segment edge_key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class Splitter {
 public:
  Splitter(TetMesh& mesh, const CadModel& model, const Monitor& monitor) : mesh_(mesh), model_(model), monitor_(monitor) {
    around_.resize(mesh.points.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      for (const int v : mesh.tets[t]) around_[at(v)].push_back(static_cast<int>(t));
  }

  void split_cut_corners() {
    std::vector<std::set<int>> edges_at(mesh_.points.size());
    std::set<Segment> segments;
    for (const auto& [list, edges] : {std::pair(&mesh_.segments, &mesh_.segment_edge), std::pair(&mesh_.inner_segments, &mesh_.inner_segment_edge)}) {
      for (std::size_t i = 0; i < list->size(); ++i) {
        segments.insert(edge_key((*list)[i][0], (*list)[i][1]));
        for (const int v : (*list)[i]) edges_at[at(v)].insert((*edges)[i]);
      }
    }
    split_cut_corners(mesh_.triangles, mesh_.triangle_face, 2, edges_at, segments);
    split_cut_corners(mesh_.inner_triangles, mesh_.inner_face, 3, edges_at, segments);
  }

  void split_inner_edges() {
    mark_boundary();
    std::vector<Segment> edges;
    for (const Tet& tet : mesh_.tets)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) {
          const Segment edge = edge_key(tet[i], tet[j]);
          if (on_boundary_[at(edge[0])] && on_boundary_[at(edge[1])] && !boundary_edges_.count(edge)) edges.push_back(edge);
        }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    longest_first(edges);
    for (const Segment& edge : edges) {
      if (++count_ % 1024 == 0) monitor_.check();
      split_edge(edge, add_point((mesh_.points[at(edge[0])] + mesh_.points[at(edge[1])]) / 2, {3, 1}), tets_around(edge));
    }
  }

  void split_inner_facets() {
    std::set<Triangle> boundary, inner;
    for (const auto* triangles : {&mesh_.triangles, &mesh_.inner_triangles}) {
      for (Triangle t : *triangles) {
        std::sort(t.begin(), t.end());
        boundary.insert(t);
      }
    }
    for (const Tet& tet : mesh_.tets)
      for (std::size_t skip = 0; skip < 4; ++skip) {
        Triangle facet{tet[(skip + 1) % 4], tet[(skip + 2) % 4], tet[(skip + 3) % 4]};
        std::sort(facet.begin(), facet.end());
        if (on_boundary_[at(facet[0])] && on_boundary_[at(facet[1])] && on_boundary_[at(facet[2])] && !boundary.count(facet)) inner.insert(facet);
      }
    for (const Triangle& facet : inner) {
      if (++count_ % 1024 == 0) monitor_.check();
      const Vec3 centre = (mesh_.points[at(facet[0])] + mesh_.points[at(facet[1])] + mesh_.points[at(facet[2])]) / 3;
      const int middle = add_point(centre, {3, 1});
      for (const int t : tets_around({facet[0], facet[1]})) {
        const Tet tet = mesh_.tets[at(t)];
        if (std::find(tet.begin(), tet.end(), facet[2]) == tet.end()) continue;
        replace(t, facet[0], middle);
        for (const int corner : {facet[1], facet[2]}) {
          Tet copy = tet;
          std::replace(copy.begin(), copy.end(), corner, middle);
          add_tet(copy, t);
        }
      }
    }
  }

 private:
  /// `dim`: of the new points' classification, 3 for those between solids.
  void split_cut_corners(std::vector<Triangle>& triangles, std::vector<int>& faces, int dim, const std::vector<std::set<int>>& edges_at,
                         const std::set<Segment>& segments) {
    std::set<Segment> edges;
    for (const Triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) edges.insert(edge_key(t[k], t[(k + 1) % 3]));
    std::vector<Segment> cuts;
    for (const Segment& edge : edges) {
      // Points that this adds are on no CAD edge.
      if (segments.count(edge) || at(std::max(edge[0], edge[1])) >= edges_at.size()) continue;
      std::vector<int> common;
      std::set_intersection(edges_at[at(edge[0])].begin(), edges_at[at(edge[0])].end(), edges_at[at(edge[1])].begin(), edges_at[at(edge[1])].end(),
                            std::back_inserter(common));
      if (!common.empty()) cuts.push_back(edge);
    }
    longest_first(cuts);
    for (const Segment& edge : cuts) split_surface_edge(edge, triangles, faces, dim);
  }

  void longest_first(std::vector<Segment>& edges) const {
    const auto length = [&](const Segment& e) { return (mesh_.points[at(e[0])] - mesh_.points[at(e[1])]).squaredNorm(); };
    std::sort(edges.begin(), edges.end(), [&](const Segment& a, const Segment& b) {
      const double la = length(a), lb = length(b);
      return la != lb ? la > lb : a < b;
    });
  }

  void mark_boundary() {
    on_boundary_.assign(mesh_.points.size(), false);
    for (const auto* triangles : {&mesh_.triangles, &mesh_.inner_triangles})
      for (const Triangle& t : *triangles)
        for (std::size_t k = 0; k < 3; ++k) {
          on_boundary_[at(t[k])] = true;
          boundary_edges_.insert(edge_key(t[k], t[(k + 1) % 3]));
        }
  }

  std::vector<int> tets_around(const Segment& edge) const {
    std::vector<int> result;
    for (const int t : around_[at(edge[0])])
      if (const Tet& tet = mesh_.tets[at(t)]; std::find(tet.begin(), tet.end(), edge[1]) != tet.end()) result.push_back(t);
    return result;
  }

  int add_point(const Vec3& point, const CadRef& cad) {
    mesh_.points.push_back(point);
    mesh_.point_cad.push_back(cad);
    around_.emplace_back();
    on_boundary_.push_back(cad.dim < 3);
    return static_cast<int>(mesh_.points.size()) - 1;
  }

  /// A piece of tet `whole`.
  void add_tet(const Tet& tet, int whole) {
    for (const int v : tet) around_[at(v)].push_back(static_cast<int>(mesh_.tets.size()));
    mesh_.tets.push_back(tet);
    if (!mesh_.tet_solid.empty()) mesh_.tet_solid.push_back(mesh_.tet_solid[at(whole)]);
  }

  void replace(int t, int from, int to) {
    Tet& tet = mesh_.tets[at(t)];
    std::replace(tet.begin(), tet.end(), from, to);
    std::erase(around_[at(from)], t);
    around_[at(to)].push_back(t);
  }

  void split_edge(const Segment& edge, int middle, const std::vector<int>& tets) {
    for (const int t : tets) {
      Tet copy = mesh_.tets[at(t)];
      std::replace(copy.begin(), copy.end(), edge[0], middle);
      replace(t, edge[1], middle);
      add_tet(copy, t);
    }
  }

  /// Whether all halves keep a fair part of the volume that the straight midpoint would give them.
  bool keeps_volumes(const Segment& edge, const Vec3& point, const std::vector<int>& tets) const {
    for (const int t : tets)
      for (const int end : edge) {
        std::array<Vec3, 4> p;
        const Tet& tet = mesh_.tets[at(t)];
        for (std::size_t k = 0; k < 4; ++k) p[k] = tet[k] == end ? point : mesh_.points[at(tet[k])];
        const double whole = signed_volume(mesh_.points[at(tet[0])], mesh_.points[at(tet[1])], mesh_.points[at(tet[2])], mesh_.points[at(tet[3])]);
        if (signed_volume(p[0], p[1], p[2], p[3]) < 0.1 * whole) return false;
      }
    return true;
  }

  void split_surface_edge(const Segment& edge, std::vector<Triangle>& triangles, std::vector<int>& faces, int dim) {
    // The two triangles are looked up afresh: earlier splits have changed them.
    std::vector<std::size_t> sides;
    for (std::size_t t = 0; t < triangles.size() && sides.size() < 2; ++t) {
      const Triangle& triangle = triangles[t];
      if (std::count(triangle.begin(), triangle.end(), edge[0]) && std::count(triangle.begin(), triangle.end(), edge[1])) sides.push_back(t);
    }
    if (sides.size() != 2 || faces[sides[0]] != faces[sides[1]]) return;
    const int face = faces[sides[0]];
    const FacePoint foot = model_.project_to_face(face, (mesh_.points[at(edge[0])] + mesh_.points[at(edge[1])]) / 2);
    const std::vector<int> tets = tets_around(edge);
    if (!keeps_volumes(edge, foot.point, tets)) return;
    const int middle = add_point(foot.point, dim == 2 ? CadRef{2, face} : CadRef{3, 1});
    split_edge(edge, middle, tets);
    for (const std::size_t t : sides) {
      Triangle copy = triangles[t];
      std::replace(copy.begin(), copy.end(), edge[0], middle);
      std::replace(triangles[t].begin(), triangles[t].end(), edge[1], middle);
      triangles.push_back(copy);
      faces.push_back(face);
    }
  }

  TetMesh& mesh_;
  const CadModel& model_;
  const Monitor& monitor_;
  std::vector<std::vector<int>> around_;  // tets of each point
  std::vector<bool> on_boundary_;
  std::set<Segment> boundary_edges_;
  int count_ = 0;
};

}  // namespace

void split_for_map(TetMesh& mesh, const CadModel& model, const Monitor& monitor) {
  Splitter splitter(mesh, model, monitor);
  splitter.split_cut_corners();
  splitter.split_inner_edges();
  splitter.split_inner_facets();
}

}  // namespace polycube
