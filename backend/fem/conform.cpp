#include "fem/conform.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/hexahedron.h"

namespace polycube {
namespace {

class Namer {
 public:
  Namer(FemMesh& mesh, const ConformalModel& model, const std::vector<int>& hex_solid) : mesh_(mesh), model_(model), solid_(hex_solid) {}

  void run(const std::vector<CadRef>& point_cad) {
    const auto owners = find_owners();
    for (int q = 0; q < std::ssize(mesh_.quads); ++q) name_quad(q, owners[q]);
    name_segments();
    for (int p = 0; p < std::ssize(point_cad); ++p)
      if (point_cad[p].dim == 0) name_vertex(p, point_cad[p].id);
    for (int h = 0; h < std::ssize(mesh_.hexes); ++h) {
      FemGroup& group = groups_[{0, 0, {3, number(solid_[h])}}];
      group.elements.push_back(h);
      add_nodes(group, mesh_.hexes[h]);
      mesh_.hex_solid.push_back(number(solid_[h]));
    }
    finish();
  }

 private:
  using Sides = std::vector<std::array<int, 2>>;

  int number(int solid) const { return model_.numbers[static_cast<std::size_t>(solid)]; }
  const Origin& origin(int solid) const { return model_.origins[static_cast<std::size_t>(solid)]; }

  template <class Row>
  static void add_nodes(FemGroup& group, const Row& row) {
    for (const int n : row)
      if (n >= 0) group.nodes.push_back(n);
  }

  /// Per quad the hexes with that side and its number in them, by solid.
  std::vector<Sides> find_owners() const {
    const auto sorted = [](Quad quad) {
      std::sort(quad.begin(), quad.end());
      return quad;
    };
    std::map<Quad, int> wanted;
    for (int q = 0; q < std::ssize(mesh_.quads); ++q) wanted[sorted({mesh_.quads[q][0], mesh_.quads[q][1], mesh_.quads[q][2], mesh_.quads[q][3]})] = q;
    std::vector<Sides> owners(mesh_.quads.size());
    for (int h = 0; h < std::ssize(mesh_.hexes); ++h) {
      for (int f = 0; f < 6; ++f) {
        const auto& c = kHexFaces[f];
        const auto& hex = mesh_.hexes[h];
        if (const auto at = wanted.find(sorted({hex[c[0]], hex[c[1]], hex[c[2]], hex[c[3]]})); at != wanted.end())
          owners[at->second].push_back({h, kAbaqusFace[f]});
      }
    }
    for (Sides& sides : owners)
      std::sort(sides.begin(), sides.end(), [&](const auto& a, const auto& b) { return std::pair(solid_[a[0]], a[0]) < std::pair(solid_[b[0]], b[0]); });
    return owners;
  }

  void add_side(FemGroup& group, int quad, const std::array<int, 2>& side) {
    group.elements.push_back(quad);
    group.sides.push_back(side);
    add_nodes(group, mesh_.quads[quad]);
  }

  void name_quad(int q, const Sides& sides) {
    const auto face = static_cast<std::size_t>(mesh_.quad_face[q]);
    mesh_.quad_hex[q] = sides.front();
    mesh_.quad_face[q] = origin(solid_[sides.front()[0]]).faces[face];
    std::vector<int> named;
    for (const auto& side : sides) {
      const int solid = solid_[side[0]], before = origin(solid).faces[face];
      // A face that both solids share is listed once, as the first of them sees it.
      if (std::find(named.begin(), named.end(), before) == named.end()) add_side(groups_[{0, 0, {2, before}}], q, side);
      named.push_back(before);
      if (sides.size() < 2) continue;
      const int other = solid_[(side == sides[0] ? sides[1] : sides[0])[0]];
      add_side(groups_[{number(solid), number(other), {2, 0}}], q, side);
      if (origin(other).faces[face] == before) add_side(groups_[{number(solid), 0, {2, before}}], q, side);
    }
  }

  void name_segments() {
    std::vector<std::array<int, 3>> kept;
    std::vector<int> edges;
    for (std::size_t s = 0; s < mesh_.segments.size(); ++s) {
      const auto edge = static_cast<std::size_t>(mesh_.segment_edge[s]);
      std::vector<int> before;
      for (const Origin& o : model_.origins)
        if (o.edges[edge] > 0 && std::find(before.begin(), before.end(), o.edges[edge]) == before.end()) before.push_back(o.edges[edge]);
      if (before.empty()) continue;  // where one solid ends on a face of another
      for (const int e : before) {
        FemGroup& group = groups_[{0, 0, {1, e}}];
        group.elements.push_back(static_cast<int>(kept.size()));
        add_nodes(group, mesh_.segments[s]);
      }
      kept.push_back(mesh_.segments[s]);
      edges.push_back(before.front());
    }
    mesh_.segments = std::move(kept);
    mesh_.segment_edge = std::move(edges);
  }

  void name_vertex(int point, int vertex) {
    for (const Origin& o : model_.origins)
      if (const int before = o.vertices[static_cast<std::size_t>(vertex)]; before > 0) groups_[{0, 0, {0, before}}].nodes.push_back(point);
  }

  void finish() {
    mesh_.groups.clear();
    for (auto& [key, group] : groups_) {
      std::tie(group.solid, group.other, group.entity) = key;
      std::sort(group.nodes.begin(), group.nodes.end());
      group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
      mesh_.groups.push_back(std::move(group));
    }
  }

  FemMesh& mesh_;
  const ConformalModel& model_;
  const std::vector<int>& solid_;
  std::map<std::tuple<int, int, CadRef>, FemGroup> groups_;
};

}  // namespace

void name_by_origin(FemMesh& mesh, const ConformalModel& model, const std::vector<int>& hex_solid, const std::vector<CadRef>& point_cad) {
  Namer(mesh, model, hex_solid).run(point_cad);
}

}  // namespace polycube
