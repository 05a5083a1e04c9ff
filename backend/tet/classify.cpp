#include "tet/classify.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "core/error.h"
#include "tet/tuning.h"

namespace polycube {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// At most as many as are probed, spread over the whole list.
template <class T>
std::vector<T> thin(const std::vector<T>& all) {
  if (all.size() <= kTetTuning.probes) return all;
  std::vector<T> some;
  for (std::size_t k = 0; k < kTetTuning.probes; ++k) some.push_back(all[k * (all.size() - 1) / (kTetTuning.probes - 1)]);
  return some;
}

/// What is known of one Gmsh entity: nodes that must lie on it, and centres of its elements, which only lie near it.
struct Probe {
  std::vector<Vec3> nodes, centres;
  bool own = false;  ///< some of the nodes are classified on the entity itself, not on its border
};

template <class Elements>
std::map<int, Probe> probes_of(const RawMesh& raw, int dim, const Elements& elements, const std::vector<int>& tags) {
  std::map<int, std::vector<int>> elements_of;
  for (std::size_t i = 0; i < elements.size(); ++i) elements_of[tags[i]].push_back(static_cast<int>(i));
  std::map<int, Probe> result;
  for (const auto& [tag, list] : elements_of) {
    Probe& probe = result[tag];
    std::vector<int> own, border;
    for (const int i : list) {
      Vec3 centre = Vec3::Zero();
      for (const int v : elements[at(i)]) {
        centre += raw.points[at(v)] / static_cast<double>(elements[at(i)].size());
        (raw.point_entity[at(v)] == CadRef{dim, tag} ? own : border).push_back(v);
      }
      probe.centres.push_back(centre);
    }
    probe.own = !own.empty();
    probe.centres = thin(probe.centres);
    for (const std::vector<int>& nodes : {thin(own), thin(border)})
      for (const int v : nodes) probe.nodes.push_back(raw.points[at(v)]);
  }
  return result;
}

std::map<int, Probe> probes(const RawMesh& raw, int dim) {
  if (dim == 1) return probes_of(raw, 1, raw.segments, raw.segment_tag);
  if (dim == 2) return probes_of(raw, 2, raw.triangles, raw.triangle_tag);
  std::map<int, Probe> result;
  for (std::size_t i = 0; i < raw.points.size(); ++i)
    if (raw.point_entity[i].dim == 0) result[raw.point_entity[i].id] = {{raw.points[i]}, {raw.points[i]}, true};
  return result;
}

double distance(const CadModel& model, int dim, int id, const Vec3& p) {
  if (dim == 0) return (model.vertex(id) - p).norm();
  return dim == 1 ? model.project_to_edge(id, p).distance : model.project_to_face(id, p).distance;
}

/// Gmsh tag -> CAD number. The tag's place in the file is looked at first; nothing is taken without the distances agreeing.
std::map<int, int> match(const RawMesh& raw, const CadModel& model, int dim) {
  const std::vector<int>& order = model.brep_order(dim);
  std::map<int, int> result;
  std::set<int> taken;
  for (const auto& [tag, found] : probes(raw, dim)) {
    const Probe& probe = found;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    const auto all_within = [&](int id, double reach) {
      return std::all_of(probe.nodes.begin(), probe.nodes.end(), [&](const Vec3& p) { return distance(model, dim, id, p) <= reach * model.diagonal(); });
    };
    const auto consider = [&](int id) {
      if ((dim == 1 && model.edge(id).degenerate) || !all_within(id, kTetTuning.far)) return;
      double sum = 0;
      for (const Vec3& p : probe.centres) sum += distance(model, dim, id, p);
      if (sum < least) least = sum, best = id;
    };
    const int expected = tag >= 1 && at(tag) <= order.size() ? order[at(tag) - 1] : 0;
    if (probe.own && expected > 0 && !(dim == 1 && model.edge(expected).degenerate) && all_within(expected, kTetTuning.near)) best = expected;
    for (const int id : order) {
      if (best != 0 && best == expected) break;
      consider(id);
    }
    if (best == 0) throw Unusable("Gmsh's " + name({dim, tag}) + " lies on no CAD entity");
    if (!taken.insert(best).second) throw Unusable("two of Gmsh's entities lie on " + name({dim, best}), {{dim, best}});
    result[tag] = best;
  }
  return result;
}

template <std::size_t N>
std::array<int, N> sorted(std::array<int, N> key) {
  std::sort(key.begin(), key.end());
  return key;
}

/// What Gmsh's mesh is on the CAD model.
struct Classified {
  Classified(const RawMesh& given, const CadModel& model)
      : raw(given), cad{match(given, model, 0), match(given, model, 1), match(given, model, 2)}, index(given.points.size(), -1) {
    std::vector<char> used(raw.points.size(), 0);
    for (const Tet& tet : raw.tets)
      for (const int v : tet) used[at(v)] = 1;
    int count = 0;
    for (std::size_t i = 0; i < raw.points.size(); ++i)
      if (used[i]) index[i] = count++;
    for (std::size_t i = 0; i < raw.triangles.size(); ++i) {
      Triangle t = raw.triangles[i];
      for (int& v : t) v = index[at(v)];
      face_of[sorted(t)] = cad[2].at(raw.triangle_tag[i]);
    }
    for (std::size_t i = 0; i < raw.segments.size(); ++i) {
      segments.push_back({index[at(raw.segments[i][0])], index[at(raw.segments[i][1])]});
      segment_edge.push_back(cad[1].at(raw.segment_tag[i]));
    }
  }

  /// Points with their classification, and tets turned the right way.
  TetMesh tets() const {
    TetMesh mesh;
    for (std::size_t i = 0; i < raw.points.size(); ++i) {
      if (index[i] < 0) continue;
      mesh.points.push_back(raw.points[i]);
      const CadRef& entity = raw.point_entity[i];
      mesh.point_cad.push_back(entity.dim == 3 ? CadRef{3, 1} : CadRef{entity.dim, cad[at(entity.dim)].at(entity.id)});
    }
    for (const Tet& tet : raw.tets) {
      Tet t;
      for (std::size_t k = 0; k < 4; ++k) t[k] = index[at(tet[k])];
      const double volume = signed_volume(mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])], mesh.points[at(t[3])]);
      if (volume == 0) throw Unusable("a tetrahedron has no volume");
      if (volume < 0) std::swap(t[2], t[3]);
      mesh.tets.push_back(t);
    }
    return mesh;
  }

  const RawMesh& raw;
  std::array<std::map<int, int>, 3> cad;
  std::vector<int> index;           ///< per point of Gmsh's: its number in the mesh, -1 for one of no tet
  std::map<Triangle, int> face_of;  ///< by sorted points
  std::vector<Segment> segments;
  std::vector<int> segment_edge;
};

}  // namespace

double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return (b - a).cross(c - a).dot(d - a) / 6; }

std::vector<Triangle> boundary_facets(const std::vector<Tet>& tets) {
  static constexpr std::array<std::array<std::size_t, 3>, 4> kFacets{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  struct Facet {
    Triangle key, outward;
    std::size_t order;
  };
  std::vector<Facet> facets;
  facets.reserve(4 * tets.size());
  for (const Tet& tet : tets)
    for (const auto& f : kFacets) {
      const Triangle facet{tet[f[0]], tet[f[1]], tet[f[2]]};
      facets.push_back({sorted(facet), facet, facets.size()});
    }
  std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return std::tie(a.key, a.order) < std::tie(b.key, b.order); });
  std::vector<Facet> single;
  for (std::size_t i = 0; i < facets.size();) {
    std::size_t j = i + 1;
    while (j < facets.size() && facets[j].key == facets[i].key) ++j;
    if (j - i > 2) throw Unusable("more than two tetrahedra share a facet");
    if (j - i == 1) single.push_back(facets[i]);
    i = j;
  }
  std::sort(single.begin(), single.end(), [](const Facet& a, const Facet& b) { return a.order < b.order; });
  std::vector<Triangle> result;
  result.reserve(single.size());
  for (const Facet& facet : single) result.push_back(facet.outward);
  return result;
}

TetMesh classify(const RawMesh& raw, const CadModel& model) {
  const Classified found(raw, model);
  TetMesh mesh = found.tets();
  mesh.triangles = boundary_facets(mesh.tets);
  std::set<Segment> boundary_edges;
  for (const Triangle& t : mesh.triangles) {
    const auto face = found.face_of.find(sorted(t));
    if (face == found.face_of.end()) throw Unusable("a boundary facet of the tetrahedra lies on no CAD face");
    mesh.triangle_face.push_back(face->second);
    for (std::size_t k = 0; k < 3; ++k) boundary_edges.insert(sorted(Segment{t[k], t[(k + 1) % 3]}));
  }
  if (mesh.triangles.size() != raw.triangles.size()) throw Unusable("some surface triangles bound no tetrahedron");
  for (std::size_t i = 0; i < found.segments.size(); ++i) {
    const int edge = found.segment_edge[i];
    if (!boundary_edges.count(sorted(found.segments[i]))) throw Unusable("a piece of " + name({1, edge}) + " is no edge of the boundary", {{1, edge}});
    mesh.segments.push_back(found.segments[i]);
    mesh.segment_edge.push_back(edge);
  }
  return mesh;
}

TetMesh classify(const RawMesh& raw, const CadModel& whole, const std::vector<CadModel>& solids) {
  const Classified found(raw, whole);
  TetMesh mesh = found.tets();
  // The solid of a tag is the one that the faces of its tets bound.
  std::map<int, std::vector<Tet>> tets_of;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) tets_of[raw.tet_tag[t]].push_back(mesh.tets[t]);
  std::map<int, int> solid_of;
  for (const auto& [tag, tets] : tets_of) {
    std::set<int> faces;
    for (const Triangle& t : boundary_facets(tets)) {
      const auto face = found.face_of.find(sorted(t));
      if (face == found.face_of.end()) throw Unusable("a boundary facet of the tetrahedra lies on no CAD face");
      faces.insert(face->second);
    }
    const auto solid =
        std::find_if(solids.begin(), solids.end(), [&](const CadModel& s) { return std::set<int>(s.faces().begin(), s.faces().end()) == faces; });
    if (solid == solids.end()) throw Unusable("the tetrahedra of a solid are not bounded by its faces");
    solid_of[tag] = static_cast<int>(solid - solids.begin());
  }
  if (solid_of.size() != solids.size()) throw Unusable("a solid has no tetrahedra");
  for (const int tag : raw.tet_tag) mesh.tet_solid.push_back(solid_of.at(tag));

  // Of every solid all of its boundary: what two have in common is inner.
  std::map<Triangle, int> count;
  std::vector<std::vector<Triangle>> boundaries;
  for (int s = 0; s < static_cast<int>(solids.size()); ++s) {
    std::vector<Tet> own;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      if (mesh.tet_solid[t] == s) own.push_back(mesh.tets[t]);
    boundaries.push_back(boundary_facets(own));
    for (const Triangle& t : boundaries.back()) ++count[sorted(t)];
  }
  std::set<Segment> outer_edges, inner_edges;
  std::set<Triangle> done;
  for (const auto& boundary : boundaries) {
    for (const Triangle& t : boundary) {
      const bool outer = count.at(sorted(t)) == 1;
      if (!outer && !done.insert(sorted(t)).second) continue;
      (outer ? mesh.triangles : mesh.inner_triangles).push_back(t);
      (outer ? mesh.triangle_face : mesh.inner_face).push_back(found.face_of.at(sorted(t)));
      for (std::size_t k = 0; k < 3; ++k) (outer ? outer_edges : inner_edges).insert(sorted(Segment{t[k], t[(k + 1) % 3]}));
    }
  }
  if (mesh.triangles.size() + mesh.inner_triangles.size() != raw.triangles.size()) throw Unusable("some surface triangles bound no tetrahedron");
  for (std::size_t i = 0; i < found.segments.size(); ++i) {
    const Segment key = sorted(found.segments[i]);
    const int edge = found.segment_edge[i];
    const bool outer = outer_edges.count(key) > 0;
    if (!outer && !inner_edges.count(key)) throw Unusable("a piece of " + name({1, edge}) + " is no edge of the boundary", {{1, edge}});
    (outer ? mesh.segments : mesh.inner_segments).push_back(found.segments[i]);
    (outer ? mesh.segment_edge : mesh.inner_segment_edge).push_back(edge);
  }
  std::vector<char> on_outer(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) on_outer[at(v)] = 1;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (on_outer[p]) continue;
    if (mesh.point_cad[p].dim == 0) mesh.inner_vertices.emplace_back(static_cast<int>(p), mesh.point_cad[p].id);
    mesh.point_cad[p] = {3, 1};
  }
  return mesh;
}

TetMesh tets_of_solid(const TetMesh& mesh, int solid, std::vector<int>* points) {
  TetMesh own;
  std::vector<int> index(mesh.points.size(), -1), back;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.tet_solid[t] != solid) continue;
    Tet& tet = own.tets.emplace_back(mesh.tets[t]);
    for (int& v : tet) {
      if (index[at(v)] < 0) {
        index[at(v)] = static_cast<int>(back.size());
        back.push_back(v);
      }
      v = index[at(v)];
    }
  }
  for (const int v : back) {
    own.points.push_back(mesh.points[at(v)]);
    own.point_cad.push_back({3, 1});
  }
  std::map<Triangle, int> face_of;
  for (const auto& [triangles, faces] : {std::pair(&mesh.triangles, &mesh.triangle_face), std::pair(&mesh.inner_triangles, &mesh.inner_face)}) {
    for (std::size_t i = 0; i < triangles->size(); ++i) {
      Triangle t = (*triangles)[i];
      for (int& v : t) v = index[at(v)];
      if (*std::min_element(t.begin(), t.end()) >= 0) face_of[sorted(t)] = (*faces)[i];
    }
  }
  own.triangles = boundary_facets(own.tets);
  std::set<Segment> edges;
  for (const Triangle& t : own.triangles) {
    own.triangle_face.push_back(face_of.at(sorted(t)));
    for (std::size_t k = 0; k < 3; ++k) {
      edges.insert(sorted(Segment{t[k], t[(k + 1) % 3]}));
      own.point_cad[at(t[k])] = {2, own.triangle_face.back()};
    }
  }
  for (const auto& [segments, of] : {std::pair(&mesh.segments, &mesh.segment_edge), std::pair(&mesh.inner_segments, &mesh.inner_segment_edge)}) {
    for (std::size_t i = 0; i < segments->size(); ++i) {
      const Segment s{index[at((*segments)[i][0])], index[at((*segments)[i][1])]};
      if (s[0] < 0 || s[1] < 0 || !edges.count(sorted(s))) continue;
      own.segments.push_back(s);
      own.segment_edge.push_back((*of)[i]);
      for (const int v : s) own.point_cad[at(v)] = {1, (*of)[i]};
    }
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    if (index[p] >= 0 && mesh.point_cad[p].dim == 0) own.point_cad[at(index[p])] = mesh.point_cad[p];
  for (const auto& [p, vertex] : mesh.inner_vertices)
    if (index[at(p)] >= 0) own.point_cad[at(index[at(p)])] = {0, vertex};
  if (points) *points = std::move(back);
  return own;
}

void check_complete(const TetMesh& mesh, const CadModel& model) {
  std::vector<int> vertices(at(model.vertex_count()) + 1), edges(at(model.edge_count()) + 1), faces(at(model.face_count()) + 1);
  for (const CadRef& cad : mesh.point_cad)
    if (cad.dim == 0) ++vertices[at(cad.id)];
  for (const int edge : mesh.segment_edge) ++edges[at(edge)];
  for (const int face : mesh.triangle_face) ++faces[at(face)];
  std::vector<CadRef> missing;
  for (const int v : model.vertices())
    if (vertices[at(v)] != 1) missing.push_back({0, v});
  for (const int e : model.edges())
    if (edges[at(e)] == 0 && !model.edge(e).degenerate) missing.push_back({1, e});
  for (const int f : model.faces())
    if (faces[at(f)] == 0) missing.push_back({2, f});
  if (!missing.empty()) throw Unusable("the tetrahedra leave out " + name(missing.front()), missing);
  std::set<Segment> boundary_edges;
  std::set<int> boundary_points;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      boundary_edges.insert(sorted(Segment{t[k], t[(k + 1) % 3]}));
      boundary_points.insert(t[k]);
    }
  const auto euler = static_cast<int>(boundary_points.size()) - static_cast<int>(boundary_edges.size()) + static_cast<int>(mesh.triangles.size());
  if (euler != model.euler_characteristic()) throw Unusable("the boundary of the tetrahedra has another topology than the CAD");
}

}  // namespace polycube
