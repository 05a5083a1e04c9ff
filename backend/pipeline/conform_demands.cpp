#include "pipeline/conform_demands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/sorted.h"
#include "label/features.h"
#include "label/frame.h"
#include "pipeline/solids.h"
#include "tet/classify.h"

namespace polycube {
namespace {

bool has(const std::vector<int>& numbers, int id) { return std::binary_search(numbers.begin(), numbers.end(), id); }

const std::vector<int>& numbers_before(const Origin& origin, int dim) { return dim == 2 ? origin.faces : dim == 1 ? origin.edges : origin.vertices; }

const CadModel& before(const ConformalModel& model, const Assembly& assembly, std::size_t s) {
  return assembly.solids[static_cast<std::size_t>(model.numbers[s]) - 1];
}

const std::vector<int>& numbers_of(const CadModel& solid, int dim) { return dim == 2 ? solid.faces() : dim == 1 ? solid.edges() : solid.vertices(); }

/// The first solid that had a face; of a face that two shared the labels are meant as that one sees it.
int first_with(const ConformalModel& model, int face) {
  for (std::size_t s = 0; s < model.origins.size(); ++s)
    if (std::find(model.origins[s].faces.begin(), model.origins[s].faces.end(), face) != model.origins[s].faces.end()) return static_cast<int>(s);
  return -1;
}

void keep_edges_of(const CadModel& model, int face, std::vector<char>& smooth) {
  for (const int e : model.face(face).edges) smooth[static_cast<std::size_t>(e)] = 0;
}

/// Points of a chain a quarter from both of its ends, as parameters of a CAD edge.
std::array<double, 2> quarters(const CadModel& model, int edge, const std::vector<int>& chain, const std::vector<Vec3>& points) {
  std::array<double, 2> t{};
  for (const std::size_t end : {0U, 1U}) {
    const double at = (end == 0 ? 0.25 : 0.75) * static_cast<double>(chain.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), chain.size() - 2);
    const double part = at - static_cast<double>(i);
    t[end] = model.project_to_edge(edge, (1 - part) * points[chain[i]] + part * points[chain[i + 1]]).t;
  }
  return t;
}

}  // namespace

MeshOptions options_of_unit(const MeshOptions& options, const ConformalModel& model, const Assembly& assembly) {
  const auto in_one = [&](const auto& test) {
    for (std::size_t s = 0; s < model.solids.size(); ++s)
      if (test(before(model, assembly, s))) return true;
    return false;
  };
  const auto has_face = [&](int f) { return in_one([&](const CadModel& solid) { return has(solid.faces(), f); }); };
  const auto has_edge = [&](int e) { return in_one([&](const CadModel& solid) { return has(solid.edges(), e); }); };
  const auto has_solid = [&](int number) { return has(model.numbers, number); };
  MeshOptions own = options;
  std::erase_if(own.labels, [&](const auto& label) { return !has_face(label.first); });
  std::erase_if(own.keep_faces, [&](int f) { return !has_face(f); });
  std::erase_if(own.divisions, [&](const Division& d) { return d.solid > 0 ? !has_solid(d.solid) : d.edge > 0 ? !has_edge(d.edge) : !has_face(d.faces[0]); });
  std::erase_if(own.sizes, [&](const LocalSize& s) { return s.solid > 0 ? !has_solid(s.solid) : s.face > 0 && !has_face(s.face); });
  std::erase_if(own.bias, [&](const EdgeBias& b) { return !has_edge(b.edge); });
  std::erase_if(own.refine, [&](const LocalRefinement& r) {
    if (r.entity.dim == 3) return !has_solid(r.entity.id);
    return !in_one([&](const CadModel& solid) { return has(numbers_of(solid, r.entity.dim), r.entity.id); });
  });
  return own;
}

void check_demands(const MeshOptions& options, const ConformalModel& model, const Assembly& assembly, double size) {
  double cells = 0;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    const CadModel& solid = before(model, assembly, s);
    MeshOptions own = options_of_solid(options, assembly, model.numbers[s]);
    own.size = size;
    own = without_solids(own);
    check_divisions(solid, own.divisions);
    check_biases(solid, own.bias);
    check_refinements(solid, own.refine);
    cells += solid.volume() / std::pow(own.size, 3);
  }
  check_count(options.coarsest || options.hexes > 0 ? 0 : cells);
}

std::vector<FaceLabels> labels_by_solid(const FaceLabels& labels, const ConformalModel& model, const TetMesh& tets, const Mat3& frame) {
  std::vector<std::map<int, std::pair<int, int>>> found(model.solids.size());  // per solid and joined face: label, and the face before
  for (const auto& [face, label] : labels) {
    const int first = first_with(model, face);
    if (first < 0) continue;
    for (std::size_t s = 0; s < model.solids.size(); ++s) {
      const std::vector<int>& origin = model.origins[s].faces;
      for (const int f : model.solids[s].faces()) {
        if (origin[static_cast<std::size_t>(f)] != face) continue;
        const int own = static_cast<int>(s) == first ? label : label ^ 1;
        found[s][f] = {own, face};
      }
    }
  }
  for (const auto& [face, solids] : model.interfaces) {
    auto &one = found[static_cast<std::size_t>(solids[0])], &other = found[static_cast<std::size_t>(solids[1])];
    const auto a = one.find(face), b = other.find(face);
    if (a != one.end() && b != other.end() && a->second.first != (b->second.first ^ 1))
      throw InvalidInput("--label: " + name({2, a->second.second}) + "=" + label_name(a->second.first) + " and " + name({2, b->second.second}) + "=" +
                         label_name(b->second.first) + " contradict each other: they are the two sides of one face");
    if (a != one.end()) {
      other[face] = {a->second.first ^ 1, a->second.second};
    } else if (b != other.end()) {
      one[face] = {b->second.first ^ 1, b->second.second};
    }
  }
  std::vector<FaceLabels> result(model.solids.size());
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    for (const auto& [face, label] : found[s]) result[s].emplace_back(face, label.first);
    if (labels.empty()) continue;
    // Refused by the number that the user gave, each face where it was given.
    TetMesh own = tets_of_solid(tets, static_cast<int>(s));
    FaceLabels given;
    for (const auto& [face, label] : labels)
      if (first_with(model, face) == static_cast<int>(s)) given.emplace_back(face, label);
    for (int& f : own.triangle_face) f = model.origins[s].faces[static_cast<std::size_t>(f)];
    check_labels(own, frame, given);
  }
  return result;
}

std::vector<char> ignored_edges(const MeshOptions& options, const ConformalModel& model) {
  std::vector<char> ignored(static_cast<std::size_t>(model.whole.edge_count()) + 1, 1);
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    const CadModel& solid = model.solids[s];
    std::vector<char> smooth = smooth_edges(solid, options.feature_angle * std::numbers::pi / 180);
    for (const int f : solid.faces())
      if (has(options.keep_faces, model.origins[s].faces[static_cast<std::size_t>(f)])) keep_edges_of(solid, f, smooth);
    for (const int e : solid.edges()) ignored[static_cast<std::size_t>(e)] &= smooth[static_cast<std::size_t>(e)];
  }
  for (const auto& interface : model.interfaces) keep_edges_of(model.whole, interface.first, ignored);
  return ignored;
}

std::vector<std::vector<int>> all_edge_chains(const ConformalModel& model, const TetMesh& tets) {
  TetMesh skin;
  skin.segments = tets.segments;
  skin.segments.insert(skin.segments.end(), tets.inner_segments.begin(), tets.inner_segments.end());
  skin.segment_edge = tets.segment_edge;
  skin.segment_edge.insert(skin.segment_edge.end(), tets.inner_segment_edge.begin(), tets.inner_segment_edge.end());
  skin.point_cad = tets.point_cad;
  for (const auto& [point, vertex] : tets.inner_vertices) skin.point_cad[point] = {0, vertex};
  return edge_chains(model.whole, skin);
}

namespace {

/// The pieces of every edge of the assembly, end to end from its start.
std::vector<std::vector<int>> chains_by_origin(const ConformalModel& model, const Assembly& assembly, const TetMesh& tets) {
  const std::vector<std::vector<int>> joined = all_edge_chains(model, tets);
  std::vector<std::vector<int>> result;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    const CadModel& cad = before(model, assembly, s);
    result.resize(std::max(result.size(), static_cast<std::size_t>(cad.edge_count()) + 1));
    std::map<int, std::map<double, std::vector<int>>> pieces;  // per edge, in order
    for (const int e : model.solids[s].edges()) {
      const int edge = model.origins[s].edges[static_cast<std::size_t>(e)];
      std::vector<int> chain = joined[static_cast<std::size_t>(e)];
      if (edge == 0 || chain.size() < 2 || cad.edge(edge).seam || cad.edge(edge).degenerate) continue;
      const auto [early, late] = quarters(cad, edge, chain, tets.points);
      if (early > late) std::reverse(chain.begin(), chain.end());
      pieces[edge][std::min(early, late)] = std::move(chain);
    }
    for (const auto& [edge, in_order] : pieces) {
      std::vector<int>& whole = result[static_cast<std::size_t>(edge)];
      if (!whole.empty()) continue;  // shared with a solid before
      for (const auto& [t, chain] : in_order) whole.insert(whole.end(), chain.begin() + (whole.empty() ? 0 : 1), chain.end());
    }
  }
  return result;
}

}  // namespace

DemandPlaces find_places(const ConformalModel& model, const Assembly& assembly, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                         const std::vector<int>& block_solid, const std::vector<int>& inner_chart) {
  std::map<Triangle, std::pair<int, int>> at;  // chart and joined face
  const int first_interface = static_cast<int>(map.charts.size()) - 1 - *std::max_element(inner_chart.begin(), inner_chart.end());
  for (int c = 0; c < first_interface; ++c)
    for (const int t : map.charts[c].triangles) at[sorted(tets.triangles[t])] = {c, tets.triangle_face[t]};
  for (std::size_t t = 0; t < tets.inner_triangles.size(); ++t) at[sorted(tets.inner_triangles[t])] = {first_interface + inner_chart[t], tets.inner_face[t]};
  const auto chart_at = [&](const Triangle& triangle, int block) -> std::optional<std::pair<int, int>> {
    const auto found = at.find(triangle);
    if (found == at.end()) return std::nullopt;
    const Origin& origin = model.origins[static_cast<std::size_t>(block_solid[block])];
    return std::pair(found->second.first, origin.faces[static_cast<std::size_t>(found->second.second)]);
  };
  return {find_side_faces(tets, map, blocks, block_solid, chart_at), chains_by_origin(model, assembly, tets), block_solid, {}};
}

std::map<CadRef, std::vector<CadRef>> pieces_of(const ConformalModel& model) {
  std::map<CadRef, std::set<CadRef>> found;
  for (const Origin& origin : model.origins) {
    for (const int dim : {0, 1, 2}) {
      const std::vector<int>& before = numbers_before(origin, dim);
      for (std::size_t joined = 1; joined < before.size(); ++joined)
        if (before[joined] > 0) found[{dim, before[joined]}].insert({dim, static_cast<int>(joined)});
    }
  }
  std::map<CadRef, std::vector<CadRef>> result;
  for (const auto& [entity, pieces] : found) result[entity].assign(pieces.begin(), pieces.end());
  return result;
}

Association by_origin(const Association& association, const Origin& origin) {
  Association result = association;
  std::map<std::vector<int>, int> patch_of;
  std::vector<int> patch;
  result.patches.clear();
  for (std::vector<int> faces : association.patches) {
    for (int& f : faces) f = origin.faces[static_cast<std::size_t>(f)];
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    const auto [known, fresh] = patch_of.try_emplace(faces, static_cast<int>(result.patches.size()));
    if (fresh) result.patches.push_back(faces);
    patch.push_back(known->second);
  }
  for (int& p : result.quad_patch) p = patch[static_cast<std::size_t>(p)];
  for (CadRef& cad : result.point_cad) {
    if (cad.dim == 3) continue;
    cad.id = cad.dim == 2 ? patch[static_cast<std::size_t>(cad.id)] : numbers_before(origin, cad.dim)[static_cast<std::size_t>(cad.id)];
  }
  for (auto* edges : {&result.segment_edge, &result.lost_edges, &result.ignored_edges})
    for (int& e : *edges) e = origin.edges[static_cast<std::size_t>(e)];
  for (auto* vertices : {&result.lost_vertices, &result.ignored_vertices})
    for (int& v : *vertices) v = origin.vertices[static_cast<std::size_t>(v)];
  for (int& f : result.ignored_faces) f = origin.faces[static_cast<std::size_t>(f)];
  for (auto* list : {&result.lost_edges, &result.ignored_edges, &result.lost_vertices, &result.ignored_vertices, &result.ignored_faces}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
    std::erase(*list, 0);
  }
  return result;
}

StageFailed as_joined(const StageFailed& failure, const ConformalModel& model) {
  std::vector<CadRef> entities;
  for (const CadRef& entity : failure.entities()) {
    for (const Origin& origin : model.origins) {
      const std::vector<int>& numbers = numbers_before(origin, entity.dim);
      const auto at = std::find(numbers.begin() + 1, numbers.end(), entity.id);
      if (at == numbers.end()) continue;
      entities.push_back({entity.dim, static_cast<int>(at - numbers.begin())});
      break;
    }
  }
  return StageFailed(failure.stage(), failure.what(), entities);
}

StageFailed by_origin(const StageFailed& failure, const ConformalModel& model) {
  std::vector<CadRef> entities;
  for (const CadRef& entity : failure.entities()) {
    for (const Origin& origin : model.origins) {
      const std::vector<int>& numbers = numbers_before(origin, entity.dim);
      if (static_cast<std::size_t>(entity.id) < numbers.size() && numbers[static_cast<std::size_t>(entity.id)] > 0)
        entities.push_back({entity.dim, numbers[static_cast<std::size_t>(entity.id)]});
    }
  }
  std::sort(entities.begin(), entities.end());
  entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
  return StageFailed(failure.stage(), failure.what(), entities);
}

}  // namespace polycube
