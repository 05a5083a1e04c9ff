#include "cad/conformal.h"

#include <BRepLib.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "cad/fuse.h"
#include "cad/occt.h"
#include "core/error.h"
#include "core/union_find.h"

namespace polycube {
namespace {

using Maps = std::array<TopTools_IndexedMapOfShape, 3>;  // by dimension

Maps maps_of(const TopoDS_Shape& shape) {
  Maps maps;
  for (std::size_t dim = 0; dim < 3; ++dim) TopExp::MapShapes(shape, kKinds[dim], maps[dim]);
  return maps;
}

Numbering numbering_in(const Maps& whole, const TopoDS_Shape& part) {
  Numbering numbers;
  const Maps own = maps_of(part);
  for (std::size_t dim = 0; dim < 3; ++dim)
    for (int i = 1; i <= own[dim].Extent(); ++i) numbers[dim].push_back(whole[dim].FindIndex(own[dim](i)));
  return numbers;
}

std::shared_ptr<const CadModel::Shape> model_of(const TopoDS_Shape& shape, const Numbering& numbers, const Monitor& monitor) {
  return describe(shape, numbers, monitor);
}

/// A solid of the faces that belong to one solid each.
TopoDS_Solid outer_solid(const std::vector<TopoDS_Shape>& solids, const Maps& whole, const std::vector<std::vector<int>>& solids_of_face) {
  std::vector<TopoDS_Face> faces;
  for (const TopoDS_Shape& solid : solids)
    for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next())
      if (solids_of_face[static_cast<std::size_t>(whole[2].FindIndex(it.Current()))].size() == 1) faces.push_back(TopoDS::Face(it.Current()));
  // Shells are faces joined by edges.
  std::vector<int> group(faces.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int i) {
    while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
    return i;
  };
  std::vector<int> first_at(static_cast<std::size_t>(whole[1].Extent()) + 1, -1);
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    for (TopExp_Explorer it(faces[static_cast<std::size_t>(f)], TopAbs_EDGE); it.More(); it.Next()) {
      int& first = first_at[static_cast<std::size_t>(whole[1].FindIndex(it.Current()))];
      if (first < 0) first = f;
      const int a = root(first), b = root(f);
      group[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  const BRep_Builder builder;
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  for (int r = 0; r < static_cast<int>(faces.size()); ++r) {
    if (root(r) != r) continue;
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
      if (root(f) == r) builder.Add(shell, faces[static_cast<std::size_t>(f)]);
    shell.Closed(true);
    builder.Add(solid, shell);
  }
  return solid;
}

/// The tables of all parts in one: each entity as in the first that has it, edges with their curves in all faces.
std::shared_ptr<CadModel::Shape> merged(const TopoDS_Shape& compound, const Maps& maps, const std::vector<CadModel>& parts) {
  auto all = std::make_shared<CadModel::Shape>();
  all->shape = compound;
  for (std::size_t dim = 0; dim < 3; ++dim) {
    all->numbers[dim].resize(static_cast<std::size_t>(maps[dim].Extent()));
    std::iota(all->numbers[dim].begin(), all->numbers[dim].end(), 1);
  }
  all->ascending = all->numbers;
  all->vertices.resize(all->numbers[0].size());
  all->edges.resize(all->numbers[1].size());
  all->edge_geometry.resize(all->numbers[1].size());
  all->faces.resize(all->numbers[2].size());
  all->face_geometry.resize(all->numbers[2].size());
  std::vector<char> known_edge(all->edges.size(), 0), known_face(all->faces.size(), 0);
  for (const CadModel& part : parts) {
    const CadModel::Shape& own = part.shape();
    for (const int v : part.vertices()) all->vertices[static_cast<std::size_t>(v) - 1] = part.vertex(v);
    std::set<int> fresh;
    for (const int f : part.faces()) {
      const auto at = static_cast<std::size_t>(f) - 1;
      if (known_face[at]) continue;
      known_face[at] = 1;
      fresh.insert(f);
      all->faces[at] = own.faces[at];
      all->face_geometry[at] = own.face_geometry[at];
    }
    for (const int e : part.edges()) {
      const auto at = static_cast<std::size_t>(e) - 1;
      if (!known_edge[at]) {
        known_edge[at] = 1;
        all->edges[at] = own.edges[at];
        all->edge_geometry[at] = own.edge_geometry[at];
        continue;
      }
      for (const EdgeUse& use : own.edge_geometry[at].uses)
        if (fresh.contains(use.face)) all->edge_geometry[at].uses.push_back(use);
    }
    all->box.extend(own.box);
    all->volume += own.volume;
  }
  return all;
}

std::vector<int> origins_of(GeneralFuse& fuse, const CadModel& solid, const TopoDS_Shape& before, std::size_t dim, const TopTools_IndexedMapOfShape& after) {
  std::vector<int> origin(static_cast<std::size_t>(after.Extent()) + 1, 0);
  TopTools_IndexedMapOfShape entities;
  TopExp::MapShapes(before, kKinds[dim], entities);
  for (int i = 1; i <= entities.Extent(); ++i) {
    for (const TopoDS_Shape& image : fuse.images(entities(i))) {
      const int at = after.FindIndex(image);
      if (at > 0 && origin[static_cast<std::size_t>(at)] == 0)
        origin[static_cast<std::size_t>(at)] = solid.brep_order(static_cast<int>(dim)).at(static_cast<std::size_t>(i) - 1);
    }
  }
  return origin;
}

/// Entities by the numbers before, each as the first solid that had it.
std::vector<CadRef> before(int dim, const std::set<int>& joined, const std::vector<Origin>& origins) {
  std::vector<CadRef> entities;
  for (const int id : joined) {
    for (const Origin& origin : origins) {
      const int number = (dim == 1 ? origin.edges : origin.vertices)[static_cast<std::size_t>(id)];
      if (number == 0) continue;
      entities.push_back({dim, number});
      break;
    }
  }
  std::sort(entities.begin(), entities.end());
  entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
  return entities;
}

/// Joins the ends of edges (twice the edge, and one for its end) that follow each other round a face.
void join_corners(const TopoDS_Face& face, const Maps& maps, UnionFind& ends) {
  const auto number = [&](const TopoDS_Shape& edge) { return 2 * maps[1].FindIndex(edge); };
  for (TopExp_Explorer wire(face, TopAbs_WIRE); wire.More(); wire.Next()) {
    std::vector<TopoDS_Edge> round;
    for (BRepTools_WireExplorer it(TopoDS::Wire(wire.Current()), face); it.More(); it.Next()) round.push_back(it.Current());
    int edges = 0;
    for (TopExp_Explorer it(wire.Current(), TopAbs_EDGE); it.More(); it.Next()) ++edges;
    if (edges != static_cast<int>(round.size())) {  // OpenCASCADE does not find its way round: taken for one fan
      for (TopExp_Explorer one(wire.Current(), TopAbs_EDGE); one.More(); one.Next())
        for (TopExp_Explorer other(wire.Current(), TopAbs_EDGE); other.More(); other.Next())
          for (const int a : {0, 1})
            for (const int b : {0, 1}) ends.unite(number(one.Current()) + a, number(other.Current()) + b);
      continue;
    }
    for (std::size_t i = 0; i < round.size(); ++i) {
      const TopoDS_Edge &edge = round[i], &next = round[(i + 1) % round.size()];
      ends.unite(number(edge) + (edge.Orientation() != TopAbs_REVERSED), number(next) + (next.Orientation() == TopAbs_REVERSED));
      if (BRep_Tool::Degenerated(edge)) ends.unite(number(edge), number(edge) + 1);
    }
  }
}

/// Solids that meet in faces may touch along a line or in a point elsewhere: there the outside of them all is no surface.
void refuse_pinched(const TopoDS_Solid& outer, const Maps& maps, const std::vector<Origin>& origins) {
  std::map<int, std::set<int>> faces_at;  // per edge
  UnionFind ends(static_cast<std::size_t>(2 * maps[1].Extent()) + 2);
  for (TopExp_Explorer face(outer, TopAbs_FACE); face.More(); face.Next()) {
    for (TopExp_Explorer edge(face.Current(), TopAbs_EDGE); edge.More(); edge.Next())
      faces_at[maps[1].FindIndex(edge.Current())].insert(maps[2].FindIndex(face.Current()));
    join_corners(TopoDS::Face(face.Current()), maps, ends);
  }
  std::set<int> lines, points;
  for (const auto& [edge, faces] : faces_at)
    if (faces.size() > 2) lines.insert(edge);
  if (!lines.empty())
    throw StageFailed("interfaces", "the solids together make no solid: more than two faces meet where they touch along a line only",
                      before(1, lines, origins));
  // The faces round a vertex are one fan where corners join the ends of all edges there.
  std::map<int, int> fan;
  std::map<int, std::set<int>> edges_at;
  for (const auto& [edge, faces] : faces_at) {
    TopoDS_Vertex vertices[2];
    TopExp::Vertices(TopoDS::Edge(maps[1](edge)), vertices[0], vertices[1]);
    for (const int end : {0, 1}) {
      if (vertices[end].IsNull()) continue;
      const int v = maps[0].FindIndex(vertices[end]), root = ends.find(2 * edge + end);
      edges_at[v].insert(edge);
      if (fan.try_emplace(v, root).first->second != root) points.insert(v);
    }
  }
  if (points.empty()) return;
  for (const int v : points) lines.insert(edges_at[v].begin(), edges_at[v].end());
  const std::vector<CadRef> known = before(0, points, origins);
  throw StageFailed("interfaces", "the solids together make no solid: their outside touches itself in a point only",
                    known.empty() ? before(1, lines, origins) : known);
}

std::shared_ptr<const CadModel::Shape> outer_model(const TopoDS_Solid& outer, const Maps& maps, const Monitor& monitor) {
  const Numbering numbers = numbering_in(maps, outer);
  try {
    validate(outer, numbers, monitor);
  } catch (const InvalidInput& error) {
    throw StageFailed("interfaces", std::string("the solids together make no solid: ") + error.what());
  }
  return model_of(outer, numbers, monitor);
}

}  // namespace

class ConformalBuilder {
 public:
  static ConformalModel make(const Assembly& assembly, const std::vector<int>& chosen, const Monitor& monitor) {
    std::vector<CadModel> before;
    before.reserve(chosen.size());
    for (const int s : chosen) before.push_back(assembly.solids.at(static_cast<std::size_t>(s) - 1));
    GeneralFuse fuse(before, monitor);
    TopoDS_Compound compound;
    BRep_Builder().MakeCompound(compound);
    std::vector<TopoDS_Shape> after;
    for (const CadModel& solid : before) {
      const std::vector<TopoDS_Shape> images = fuse.images(solid_in(solid.shape().shape));
      if (images.size() != 1) throw Standard_Failure("a solid falls to pieces");
      after.push_back(images.front());
      BRep_Builder().Add(compound, after.back());
    }
    const Maps maps = maps_of(compound);
    std::vector<std::vector<int>> solids_of_face(static_cast<std::size_t>(maps[2].Extent()) + 1);
    std::vector<CadModel> solids;
    std::vector<Origin> origins;
    for (std::size_t s = 0; s < after.size(); ++s) {
      solids.push_back(CadModel(model_of(after[s], numbering_in(maps, after[s]), monitor)));
      for (const int f : solids.back().faces()) solids_of_face[static_cast<std::size_t>(f)].push_back(static_cast<int>(s));
      const TopoDS_Shape& shape = before[s].shape().shape;
      origins.push_back(
          {origins_of(fuse, before[s], shape, 2, maps[2]), origins_of(fuse, before[s], shape, 1, maps[1]), origins_of(fuse, before[s], shape, 0, maps[0])});
    }
    const TopoDS_Solid outer = outer_solid(after, maps, solids_of_face);
    refuse_pinched(outer, maps, origins);
    ConformalModel model{CadModel(merged(compound, maps, solids)), CadModel(outer_model(outer, maps, monitor)), solids, origins, chosen, {}};
    for (std::size_t f = 1; f < solids_of_face.size(); ++f)
      if (solids_of_face[f].size() == 2) model.interfaces.push_back({static_cast<int>(f), {solids_of_face[f][0], solids_of_face[f][1]}});
    return model;
  }
};

ConformalModel conform(const Assembly& assembly, const std::vector<int>& solids, const Monitor& monitor) {
  try {
    return catching_faults([&] { return ConformalBuilder::make(assembly, solids, monitor); });
  } catch (const Standard_Failure& failure) {
    monitor.check();
    throw StageFailed("interfaces", "OpenCASCADE cannot join the solids: " + reason_of(failure));
  }
}

}  // namespace polycube
