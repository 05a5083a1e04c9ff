// Tables of a valid solid: geometry for the projections, kinds, areas, borders and dihedral angles.
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <BndLib_Add3dCurve.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomLib_IsPlanarSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "cad/shape.h"
#include "cad/tuning.h"
#include "core/error.h"
#include "core/union_find.h"

namespace polycube {
namespace {

Vec2 to_vec(const gp_Pnt2d& p) { return {p.X(), p.Y()}; }

struct Maps {
  TopTools_IndexedMapOfShape faces, edges, vertices;
  const Numbering& numbers;
  int edge(const TopoDS_Shape& shape) const { return number(edges, 1, shape); }
  int vertex(const TopoDS_Shape& shape) const { return number(vertices, 0, shape); }

 private:
  int number(const TopTools_IndexedMapOfShape& map, std::size_t dim, const TopoDS_Shape& shape) const {
    return numbers[dim].at(static_cast<std::size_t>(map.FindIndex(shape)) - 1);
  }
};

Eigen::AlignedBox3d to_box(const Bnd_Box& box) {
  Eigen::AlignedBox3d result;
  if (!box.IsVoid()) result = {polycube::to_vec(box.CornerMin()), polycube::to_vec(box.CornerMax())};
  return result;
}

EdgeGeometry edge_geometry(const TopoDS_Edge& edge) {
  EdgeGeometry g;
  g.edge = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
  if (BRep_Tool::Degenerated(edge)) {
    BRep_Tool::Range(edge, g.first, g.last);
    g.box.extend(polycube::to_vec(BRep_Tool::Pnt(TopExp::FirstVertex(g.edge))));
    return g;
  }
  g.curve = BRep_Tool::Curve(g.edge, g.first, g.last);
  while (const Handle(Geom_TrimmedCurve) trimmed = Handle(Geom_TrimmedCurve)::DownCast(g.curve)) g.curve = trimmed->BasisCurve();
  const GeomAdaptor_Curve adaptor(g.curve, g.first, g.last);
  if (adaptor.GetType() == GeomAbs_Line) g.closed_form = adaptor.Line();
  if (adaptor.GetType() == GeomAbs_Circle) g.closed_form = adaptor.Circle();
  if (g.curve->IsPeriodic()) g.period = g.curve->Period();
  g.closed = TopExp::FirstVertex(g.edge).IsSame(TopExp::LastVertex(g.edge));
  Bnd_Box box;
  BndLib_Add3dCurve::Add(adaptor, 0, box);
  g.box = to_box(box);
  if (g.closed_form.index() == 0)
    for (int i = 0; i < kCadTuning.edge_samples; ++i)
      g.samples.push_back(polycube::to_vec(g.curve->Value(g.first + (g.last - g.first) * i / (kCadTuning.edge_samples - 1))));
  return g;
}

CadEdge edge_facts(const EdgeGeometry& g, const Maps& maps) {
  CadEdge info;
  info.vertices = {maps.vertex(TopExp::FirstVertex(g.edge)), maps.vertex(TopExp::LastVertex(g.edge))};
  info.closed = info.vertices[0] == info.vertices[1];
  info.degenerate = g.curve.IsNull();
  info.tolerance = BRep_Tool::Tolerance(g.edge);
  if (!info.degenerate) {
    GProp_GProps properties;
    BRepGProp::LinearProperties(g.edge, properties);
    info.length = properties.Mass();
  }
  return info;
}

/// Appends the curve of one edge in one face to the polygon, drawn along the wire.
void draw_border(const EdgeUse& use, double first, double last, bool wire_forward, int edge_id, bool interior, std::vector<BorderSegment>& border) {
  Handle(Geom2d_Curve) curve = use.curve;
  while (const Handle(Geom2d_TrimmedCurve) trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  const bool straight = !Handle(Geom2d_Line)::DownCast(curve).IsNull();
  const int pieces = straight ? 1 : kCadTuning.border_pieces;
  for (int i = 0; i < pieces; ++i) {
    const double from = static_cast<double>(i) / pieces, to = static_cast<double>(i + 1) / pieces;
    const auto at = [&](double s) { return to_vec(use.curve->Value(first + (last - first) * (wire_forward ? s : 1 - s))); };
    BorderSegment segment{at(from), at(to), 0, edge_id, interior};
    const Vec2 chord = segment.b - segment.a;
    double sagitta = 0;
    for (int k = 1; k < 4 && !straight; ++k) {
      const Vec2 off = at(from + (to - from) * k / 4) - segment.a;
      const double along = chord.squaredNorm() > 0 ? std::clamp(off.dot(chord) / chord.squaredNorm(), 0.0, 1.0) : 0;
      sagitta = std::max(sagitta, (off - along * chord).norm());
    }
    // Twice the sagitta at the quarter points bounds the deviation of any curve that does not wiggle within a 48th of its length.
    // Both sides of a seam are the face, so a wider margin there costs nothing and takes up the rounding of the parameters.
    segment.margin = 2 * sagitta + (interior ? 1e-7 : 1e-9) * (1 + chord.norm());
    border.push_back(segment);
  }
}

/// Reads the wires of a face: its border in (u, v) and what each edge is to it.
void read_borders(int face_id, FaceGeometry& g, std::vector<EdgeGeometry>& edges, std::vector<CadEdge>& infos, const Maps& maps) {
  const TopoDS_Face face = TopoDS::Face(g.face.Oriented(TopAbs_FORWARD));
  // BRep_Tool::IsClosed is no test for a seam: a Boolean operation may leave both curves on an edge that bounds the face on one side only.
  std::map<int, int> occurrences;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) ++occurrences[maps.edge(it.Current())];
  TopTools_IndexedMapOfShape own;
  TopExp::MapShapes(face, TopAbs_VERTEX, own);
  UnionFind joined(static_cast<std::size_t>(own.Extent()));  // vertices of one wire, and so wires that touch in a vertex
  std::set<int> on_border;
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    const TopoDS_Wire wire = TopoDS::Wire(wires.Current());
    int first_vertex = -1;
    for (TopExp_Explorer it(wire, TopAbs_VERTEX); it.More(); it.Next()) {
      const int vertex = own.FindIndex(it.Current()) - 1;
      if (first_vertex < 0) first_vertex = vertex;
      joined.unite(first_vertex, vertex);
      on_border.insert(vertex);
    }
    std::vector<TopoDS_Edge> chain, plain;
    for (BRepTools_WireExplorer it(wire, face); it.More(); it.Next()) chain.push_back(it.Current());
    for (TopExp_Explorer it(wire, TopAbs_EDGE); it.More(); it.Next()) plain.push_back(TopoDS::Edge(it.Current()));
    const bool ordered = chain.size() == plain.size();
    if (!ordered) chain = plain;
    std::vector<BorderSegment> drawn;
    std::vector<std::size_t> starts;
    for (const TopoDS_Edge& edge : chain) {
      if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
      const int id = maps.edge(edge);
      EdgeUse use;
      use.face = face_id;
      use.forward = edge.Orientation() == TopAbs_FORWARD;
      double first = 0, last = 0;
      use.curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
      if (use.curve.IsNull()) throw InvalidInput(name({1, id}) + " has no curve on " + name({2, face_id}));
      const bool seam = occurrences[id] > 1, degenerate = BRep_Tool::Degenerated(edge);
      starts.push_back(drawn.size());
      draw_border(use, first, last, use.forward, seam || degenerate ? 0 : id, seam || degenerate, drawn);
      if (degenerate) g.tips.push_back(to_vec(use.curve->Value((first + last) / 2)));
      if (!seam && !degenerate) g.border_edges.push_back(id);
      edges[static_cast<std::size_t>(id - 1)].uses.push_back(use);
      if (degenerate) infos[static_cast<std::size_t>(id - 1)].faces = {face_id, face_id};
    }
    // Small gaps between consecutive curves would let the even-odd count leak.
    const std::size_t count = drawn.size();
    for (std::size_t k = 0; ordered && k < starts.size(); ++k) {
      const std::size_t next = k + 1 < starts.size() ? starts[k + 1] : 0, last_piece = (k + 1 < starts.size() ? starts[k + 1] : count) - 1;
      if (drawn[last_piece].b != drawn[next].a) drawn.push_back({drawn[last_piece].b, drawn[next].a, 0, 0, false});
    }
    g.border.insert(g.border.end(), drawn.begin(), drawn.end());
  }
  for (const int vertex : on_border) g.border_parts += joined.find(vertex) == vertex;
  std::sort(g.border_edges.begin(), g.border_edges.end());
  g.border_edges.erase(std::unique(g.border_edges.begin(), g.border_edges.end()), g.border_edges.end());
  for (const BorderSegment& segment : g.border) {
    g.domain.extend(segment.a);
    g.domain.extend(segment.b);
  }
  if (!g.border_edges.empty()) g.border_grid = BorderGrid(g.border);  // all of a face without is inside
}

FaceGeometry face_geometry(const TopoDS_Face& face) {
  FaceGeometry g;
  g.face = face;
  g.sign = face.Orientation() == TopAbs_REVERSED ? -1 : 1;
  g.surface = BRep_Tool::Surface(face);
  while (const Handle(Geom_RectangularTrimmedSurface) trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(g.surface))
    g.surface = trimmed->BasisSurface();
  const GeomAdaptor_Surface adaptor(g.surface);
  switch (adaptor.GetType()) {
    case GeomAbs_Plane:
      g.closed_form = adaptor.Plane();
      break;
    case GeomAbs_Cylinder:
      g.closed_form = adaptor.Cylinder();
      break;
    case GeomAbs_Cone:
      g.closed_form = adaptor.Cone();
      break;
    case GeomAbs_Sphere:
      g.closed_form = adaptor.Sphere();
      break;
    case GeomAbs_Torus:
      g.closed_form = adaptor.Torus();
      break;
    default:
      break;
  }
  g.surface->Bounds(g.lower[0], g.upper[0], g.lower[1], g.upper[1]);
  if (g.surface->IsUPeriodic()) g.period[0] = g.surface->UPeriod();
  if (g.surface->IsVPeriodic()) g.period[1] = g.surface->VPeriod();
  g.closed = {g.period[0] == 0 && g.surface->IsUClosed(), g.period[1] == 0 && g.surface->IsVClosed()};
  return g;
}

void sample_face(const CadModel::Shape& shape, FaceGeometry& g) {
  if (g.closed_form.index() != 0) return;
  const auto add = [&](const Vec2& uv) {
    g.sample_uv.push_back(uv);
    g.samples.push_back(polycube::to_vec(g.surface->Value(uv[0], uv[1])));
  };
  const Vec2 size = g.domain.sizes();
  for (int i = 0; i < kCadTuning.face_samples; ++i)
    for (int j = 0; j < kCadTuning.face_samples; ++j) {
      const Vec2 uv = g.domain.min() + Vec2((i + 0.5) / kCadTuning.face_samples * size[0], (j + 0.5) / kCadTuning.face_samples * size[1]);
      if (inside(shape, g, uv)) add(uv);
    }
  for (const BorderSegment& segment : g.border) {
    const int pieces = segment.margin > 1e-8 || segment.edge == 0 ? 1 : kCadTuning.face_samples;
    for (int k = 0; k < pieces; ++k) add(segment.a + (segment.b - segment.a) * k / pieces);
  }
}

/// Exporters write cylinders as lines revolved and planes as B-splines; later stages ask what a face is, not how it was written.
void recognise(const FaceGeometry& g, CadFace& info) {
  if (const GeomLib_IsPlanarSurface planar(g.surface, kCadTuning.linear); planar.IsPlanar()) {
    info.kind = SurfaceKind::kPlane;
    info.axis = g.sign * surface_normal(g, g.domain.center());
    return;
  }
  if (info.kind != SurfaceKind::kRevolution) return;
  const GeomAdaptor_Surface adaptor(g.surface);
  const gp_Ax1 axis = adaptor.AxeOfRevolution();
  const Handle(Adaptor3d_Curve) meridian = adaptor.BasisCurve();
  if (meridian->GetType() == GeomAbs_Line && meridian->Line().Direction().IsParallel(axis.Direction(), kCadTuning.angular)) {
    info.kind = SurfaceKind::kCylinder;
    info.radius = gp_Lin(axis).Distance(meridian->Line().Location());
  } else if (meridian->GetType() == GeomAbs_Line) {
    if (gp_Lin(axis).Distance(meridian->Line()) < kCadTuning.linear) info.kind = SurfaceKind::kCone;  // else a hyperboloid
  } else if (meridian->GetType() == GeomAbs_Circle) {
    const gp_Circ circle = meridian->Circle();
    const double off = gp_Lin(axis).Distance(circle.Location());
    if (!circle.Axis().Direction().IsNormal(axis.Direction(), kCadTuning.angular)) return;
    if (std::abs(circle.Axis().Direction().XYZ().Dot(circle.Location().XYZ() - axis.Location().XYZ())) > kCadTuning.linear) return;
    info.kind = off < kCadTuning.linear ? SurfaceKind::kSphere : SurfaceKind::kTorus;
    info.radius = circle.Radius();
    if (off < kCadTuning.linear) info.centre = polycube::to_vec(circle.Location());
  }
}

CadFace face_facts(const FaceGeometry& g, int id, const std::vector<CadEdge>& edges) {
  CadFace info;
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(g.face, properties);
  info.area = std::abs(properties.Mass());
  info.tolerance = BRep_Tool::Tolerance(g.face);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (!edges[e].degenerate && (edges[e].faces[0] == id || edges[e].faces[1] == id)) info.edges.push_back(static_cast<int>(e) + 1);
  const auto set_axis = [&](const gp_Ax1& axis) {
    info.axis = polycube::to_vec(axis.Direction().XYZ());
    info.centre = polycube::to_vec(axis.Location());
  };
  const GeomAdaptor_Surface adaptor(g.surface);
  switch (adaptor.GetType()) {
    case GeomAbs_Plane:
      info.kind = SurfaceKind::kPlane;
      info.axis = g.sign * surface_normal(g, g.domain.center());
      info.centre = polycube::to_vec(properties.CentreOfMass());
      break;
    case GeomAbs_Cylinder:
      info.kind = SurfaceKind::kCylinder;
      set_axis(adaptor.Cylinder().Axis());
      info.radius = adaptor.Cylinder().Radius();
      break;
    case GeomAbs_Cone:
      info.kind = SurfaceKind::kCone;
      set_axis(adaptor.Cone().Axis());
      break;
    case GeomAbs_Sphere:
      info.kind = SurfaceKind::kSphere;
      info.centre = polycube::to_vec(adaptor.Sphere().Location());
      info.radius = adaptor.Sphere().Radius();
      break;
    case GeomAbs_Torus:
      info.kind = SurfaceKind::kTorus;
      set_axis(adaptor.Torus().Axis());
      info.radius = adaptor.Torus().MinorRadius();
      break;
    case GeomAbs_SurfaceOfExtrusion:
      info.kind = SurfaceKind::kExtrusion;
      info.axis = polycube::to_vec(adaptor.Direction().XYZ());
      info.centre = polycube::to_vec(properties.CentreOfMass());
      break;
    case GeomAbs_SurfaceOfRevolution:
      info.kind = SurfaceKind::kRevolution;
      set_axis(adaptor.AxeOfRevolution());
      break;
    default:
      info.centre = polycube::to_vec(properties.CentreOfMass());
      break;
  }
  if (g.closed_form.index() == 0) recognise(g, info);
  return info;
}

/// Interior dihedral angle at parameter t, from the two inner directions: pi where the faces continue each other.
double dihedral_angle(const CadModel::Shape& shape, const EdgeGeometry& edge, double t) {
  gp_Pnt point;
  gp_Vec tangent;
  edge.curve->D1(t, point, tangent);
  std::array<Vec3, 2> inward, outer;
  for (std::size_t k = 0; k < 2; ++k) {
    const EdgeUse& use = edge.uses[k];
    const FaceGeometry& face = shape.face(use.face);
    const Vec3 normal = surface_normal(face, to_vec(use.curve->Value(t)));
    inward[k] = normal.cross(polycube::to_vec(tangent)).normalized() * (use.forward ? 1 : -1);
    outer[k] = face.sign * normal;
  }
  const double angle = std::atan2(-inward[1].dot(outer[0]), inward[1].dot(inward[0]));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

// Normals a little way off the point that a degenerate edge is: off their mean by more than 10 degrees, a cone's tip and not a sphere's pole.
bool is_tip(const CadModel::Shape& shape, const EdgeGeometry& edge) {
  const EdgeUse& use = edge.uses.front();
  const FaceGeometry& face = shape.face(use.face);
  const Vec2 inwards = kCadTuning.tip_offset * (face.domain.center() - to_vec(use.curve->Value((edge.first + edge.last) / 2)));
  std::vector<Vec3> normals;
  Vec3 mean = Vec3::Zero();
  for (int i = 1; i <= kCadTuning.angle_samples; ++i) {
    normals.push_back(surface_normal(face, to_vec(use.curve->Value(edge.first + (edge.last - edge.first) * i / (kCadTuning.angle_samples + 1))) + inwards));
    mean += normals.back();
  }
  return std::any_of(normals.begin(), normals.end(), [&](const Vec3& n) { return n.dot(mean.normalized()) < std::cos(kCadTuning.tip_angle); });
}

void finish_edge(const CadModel::Shape& shape, const EdgeGeometry& edge, int id, CadEdge& info) {
  if (info.degenerate) {
    info.tip = !edge.uses.empty() && is_tip(shape, edge);
    return;
  }
  if (edge.uses.size() != 2) throw InvalidInput(name({1, id}) + " bounds " + std::to_string(edge.uses.size()) + " faces; two are needed");
  info.faces = {edge.uses[0].face, edge.uses[1].face};
  info.seam = info.faces[0] == info.faces[1];
  info.min_angle = 2 * std::numbers::pi;
  info.max_angle = 0;
  for (int i = 1; i <= kCadTuning.angle_samples; ++i) {
    const double angle = dihedral_angle(shape, edge, edge.first + (edge.last - edge.first) * i / (kCadTuning.angle_samples + 1));
    info.min_angle = std::min(info.min_angle, angle);
    info.max_angle = std::max(info.max_angle, angle);
  }
}

// Edges far below any cell's size, which files of other systems leave between faces that just fail to meet, cannot have mesh edges of their own.
void join_tiny_edges(std::vector<CadEdge>& edges, int vertices, double diagonal) {
  UnionFind same(static_cast<std::size_t>(vertices) + 1);
  for (CadEdge& e : edges) {
    if (e.degenerate || e.vertices[0] == e.vertices[1] || e.length > kCadTuning.tiny_edge * diagonal) continue;
    e.tiny = true;
    same.unite(std::min(e.vertices[0], e.vertices[1]), std::max(e.vertices[0], e.vertices[1]));
  }
  for (CadEdge& e : edges) {
    for (int& v : e.vertices) v = same.find(v);
  }
}

}  // namespace

std::shared_ptr<CadModel::Shape> describe(const TopoDS_Shape& solid, const Numbering& numbers, const Monitor& monitor) {
  auto result = std::make_shared<CadModel::Shape>();
  result->shape = solid;
  result->numbers = numbers;
  result->ascending = numbers;
  for (auto& list : result->ascending) std::sort(list.begin(), list.end());
  BRepLib::BuildCurves3d(solid);
  Maps maps{{}, {}, {}, numbers};
  TopExp::MapShapes(solid, TopAbs_FACE, maps.faces);
  TopExp::MapShapes(solid, TopAbs_EDGE, maps.edges);
  TopExp::MapShapes(solid, TopAbs_VERTEX, maps.vertices);
  const auto largest = [&](std::size_t dim) { return result->ascending[dim].empty() ? 0 : static_cast<std::size_t>(result->ascending[dim].back()); };
  const auto entry = [&](std::size_t dim, int at) { return static_cast<std::size_t>(numbers[dim].at(static_cast<std::size_t>(at) - 1)) - 1; };
  result->vertices.assign(largest(0), Vec3::Zero());
  result->edge_geometry.resize(largest(1));
  result->edges.resize(largest(1));
  result->face_geometry.resize(largest(2));
  result->faces.resize(largest(2));
  for (int i = 1; i <= maps.vertices.Extent(); ++i) result->vertices[entry(0, i)] = polycube::to_vec(BRep_Tool::Pnt(TopoDS::Vertex(maps.vertices(i))));
  for (int i = 1; i <= maps.edges.Extent(); ++i) {
    monitor.check();
    EdgeGeometry& geometry = result->edge_geometry[entry(1, i)];
    geometry = edge_geometry(TopoDS::Edge(maps.edges(i)));
    result->edges[entry(1, i)] = edge_facts(geometry, maps);
  }
  for (int i = 1; i <= maps.faces.Extent(); ++i) {
    FaceGeometry& geometry = result->face_geometry[entry(2, i)];
    geometry = face_geometry(TopoDS::Face(maps.faces(i)));
    read_borders(static_cast<int>(entry(2, i)) + 1, geometry, result->edge_geometry, result->edges, maps);
  }
  for (const int e : result->ascending[1]) {
    const auto at = static_cast<std::size_t>(e) - 1;
    finish_edge(*result, result->edge_geometry[at], e, result->edges[at]);
  }
  for (const int f : result->ascending[2]) {
    monitor.check();
    const auto at = static_cast<std::size_t>(f) - 1;
    sample_face(*result, result->face_geometry[at]);
    result->faces[at] = face_facts(result->face_geometry[at], f, result->edges);
  }
  Bnd_Box box;
  BRepBndLib::AddOptimal(solid, box, false, false);
  result->box = to_box(box);
  join_tiny_edges(result->edges, static_cast<int>(result->vertices.size()), result->box.diagonal().norm());
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties);
  result->volume = properties.Mass();
  return result;
}

}  // namespace polycube
