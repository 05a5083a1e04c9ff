// The one solid of a shape as read, or the one that its faces sew to, and the refusals.
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "cad/occt.h"
#include "cad/shape.h"

namespace polycube {
namespace {

// Largest and smallest size of a part that double precision and OCCT's absolute confusion of 1e-7 mm leave room for.
constexpr double kLargest = 1e8, kSmallest = 1e-4;

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum avoid = TopAbs_SHAPE) {
  TopTools_IndexedMapOfShape map;
  for (TopExp_Explorer it(shape, kind, avoid); it.More(); it.Next()) map.Add(it.Current());
  return map.Extent();
}

std::string plural(int number, const std::string& one, const std::string& many) { return std::to_string(number) + " " + (number == 1 ? one : many); }

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// The numbers that the entities of `whole` have, for those of `solid` that they became: the least one where several became one. What is new gets
/// numbers after all of these.
Numbering numbering(const TopoDS_Shape& whole, const TopoDS_Shape& solid, const std::function<TopoDS_Shape(const TopoDS_Shape&)>& became) {
  Numbering numbers;
  for (std::size_t dim = 0; dim < 3; ++dim) {
    TopTools_IndexedMapOfShape before, after;
    TopExp::MapShapes(whole, kKinds[dim], before);
    TopExp::MapShapes(solid, kKinds[dim], after);
    numbers[dim].assign(static_cast<std::size_t>(after.Extent()), 0);
    for (int i = 1; i <= before.Extent(); ++i) {
      for (TopExp_Explorer it(became(before(i)), kKinds[dim]); it.More(); it.Next()) {
        const int at = after.FindIndex(it.Current());
        if (at == 0 || numbers[dim][static_cast<std::size_t>(at) - 1] != 0) continue;
        numbers[dim][static_cast<std::size_t>(at) - 1] = i;
        break;
      }
    }
    int next = before.Extent();
    for (int& number : numbers[dim]) number = number == 0 ? ++next : number;
  }
  return numbers;
}

/// The numbers of a solid in the whole.
Numbering part_of(const Numbering& numbers, const TopoDS_Shape& whole, const TopoDS_Shape& solid) {
  Numbering own;
  for (std::size_t dim = 0; dim < 3; ++dim) {
    TopTools_IndexedMapOfShape all, map;
    TopExp::MapShapes(whole, kKinds[dim], all);
    TopExp::MapShapes(solid, kKinds[dim], map);
    for (int i = 1; i <= map.Extent(); ++i) own[dim].push_back(numbers[dim][static_cast<std::size_t>(all.FindIndex(map(i))) - 1]);
  }
  return own;
}

std::string name_of(const Numbering& numbers, int dim, int at) { return name({dim, numbers[static_cast<std::size_t>(dim)][static_cast<std::size_t>(at) - 1]}); }

void check_coordinates(const TopoDS_Shape& shape, const Numbering& numbers) {
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
  for (int i = 1; i <= vertices.Extent(); ++i) {
    const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(vertices(i)));
    for (int k = 1; k <= 3; ++k)
      if (!std::isfinite(p.Coord(k)) || std::abs(p.Coord(k)) > kLargest) throw InvalidInput(name_of(numbers, 0, i) + " has no usable coordinates");
  }
}

/// Every edge bounds exactly two faces, or the same face twice, or is a mere point.
void check_closed(const TopoDS_Shape& shape, const Numbering& numbers) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    const int uses = faces_of.Contains(edge) ? faces_of.FindFromKey(edge).Extent() : 0;
    if (uses < 2) throw InvalidInput("the shape is open at " + name_of(numbers, 1, i));
    if (uses > 2) throw InvalidInput("more than two faces meet at " + name_of(numbers, 1, i));
  }
}

/// An edge of one face only; null where the shape is closed.
TopoDS_Edge first_open_edge(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
  for (int i = 1; i <= faces_of.Extent(); ++i) {
    TopoDS_Edge edge = TopoDS::Edge(faces_of.FindKey(i));
    if (faces_of(i).Extent() < 2 && !BRep_Tool::Degenerated(edge)) return edge;
  }
  return {};
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

void validate_unguarded(const TopoDS_Shape& shape, const Numbering& numbers, const Monitor& monitor) {
  if (count(shape, TopAbs_FACE) == 0) throw InvalidInput("the solid has no face");
  check_coordinates(shape, numbers);
  check_closed(shape, numbers);
  monitor.check();
  const BRepCheck_Analyzer analyzer(shape);
  monitor.check();
  if (!analyzer.IsValid()) {
    for (int dim = 2; dim >= 0; --dim) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(shape, kKinds[static_cast<std::size_t>(dim)], map);
      for (int i = 1; i <= map.Extent(); ++i)
        if (!analyzer.IsValid(map(i))) throw InvalidInput("the shape is not valid at " + name_of(numbers, dim, i) + " (OpenCASCADE's check)");
    }
    throw InvalidInput("the solid is not valid (OpenCASCADE's check)");
  }
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  const double diagonal = box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
  if (!(diagonal > kSmallest && diagonal < kLargest)) throw InvalidInput("the solid's size is not usable: " + std::to_string(diagonal) + " mm across");
  const double volume = volume_of(shape);
  if (!std::isfinite(volume) || std::abs(volume) < 1e-12 * std::pow(diagonal, 3)) throw InvalidInput("the solid has no volume");
  if (volume < 0) throw InvalidInput("the solid is inside out: its volume is negative");
  // The box has OCCT's safety margins, so this can only fail on faces that cross each other.
  if (volume > 1.01 * std::pow(diagonal, 3)) throw InvalidInput("the solid intersects itself");
}

/// What is left out beside the solid, as a warning; empty for nothing.
std::string beside(int faces, int edges, int vertices) {
  std::string text;
  const auto add = [&](int number, const char* one, const char* many) {
    if (number > 0) text += (text.empty() ? "" : ", ") + plural(number, one, many);
  };
  add(faces, "loose face", "loose faces");
  add(edges, "loose edge", "loose edges");
  add(vertices, "loose vertex", "loose vertices");
  return text.empty() ? text : "left out beside the solid: " + text;
}

/// Distances within which the faces may be sewn, least first: OCCT's confusion, what the file declares, and what its own entities claim.
std::vector<double> sewing_distances(const FileShape& read) {
  double claimed = 0;
  for (const TopAbs_ShapeEnum kind : {TopAbs_VERTEX, TopAbs_EDGE}) {
    TopTools_IndexedMapOfShape map;
    TopExp::MapShapes(read.shape, kind, map);
    for (int i = 1; i <= map.Extent(); ++i)
      claimed = std::max(claimed, kind == TopAbs_VERTEX ? BRep_Tool::Tolerance(TopoDS::Vertex(map(i))) : BRep_Tool::Tolerance(TopoDS::Edge(map(i))));
  }
  std::vector<double> result{Precision::Confusion(), read.tolerance, claimed};
  std::sort(result.begin(), result.end());
  result.erase(std::remove_if(result.begin(), result.end(), [](double d) { return !(d >= Precision::Confusion()) || !std::isfinite(d); }), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The shells, and shells of the faces that are in none.
std::vector<TopoDS_Shell> shells_of(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shell> shells;
  for (TopExp_Explorer it(shape, TopAbs_SHELL); it.More(); it.Next()) shells.push_back(TopoDS::Shell(it.Current()));
  for (TopExp_Explorer it(shape, TopAbs_FACE, TopAbs_SHELL); it.More(); it.Next()) {
    BRep_Builder().MakeShell(shells.emplace_back());
    BRep_Builder().Add(shells.back(), it.Current());
  }
  for (TopoDS_Shell& shell : shells) shell.Closed(first_open_edge(shell).IsNull());
  return shells;
}

/// Solids of closed shells: of nested ones every second is a void of the one around it.
std::vector<TopoDS_Solid> solids_of(const std::vector<TopoDS_Shell>& shells) {
  struct Filled {
    TopoDS_Solid solid;  ///< as if nothing were inside
    double volume = 0;
    int depth = 0;    ///< shells around it
    int parent = -1;  ///< the innermost of them
  };
  std::vector<Filled> all;
  for (const TopoDS_Shell& shell : shells) {
    TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(shell);
    BRepLib::OrientClosedSolid(solid);
    all.push_back({solid, volume_of(solid)});
  }
  std::stable_sort(all.begin(), all.end(), [](const Filled& a, const Filled& b) { return a.volume > b.volume; });
  for (std::size_t outer = 0; outer < all.size(); ++outer) {
    BRepClass3d_SolidClassifier classifier(all[outer].solid);
    for (std::size_t i = outer + 1; i < all.size(); ++i) {
      const TopExp_Explorer vertex(all[i].solid, TopAbs_VERTEX);
      classifier.Perform(BRep_Tool::Pnt(TopoDS::Vertex(vertex.Current())), Precision::Confusion());
      if (classifier.State() != TopAbs_IN) continue;
      ++all[i].depth;
      all[i].parent = static_cast<int>(outer);
    }
  }
  std::vector<TopoDS_Solid> result;
  std::vector<std::size_t> place(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].depth % 2 == 0) {
      place[i] = result.size();
      result.push_back(all[i].solid);
    } else {
      const TopExp_Explorer shell(all[i].solid, TopAbs_SHELL);
      BRep_Builder().Add(result[place[static_cast<std::size_t>(all[i].parent)]], shell.Current().Reversed());
    }
  }
  return result;
}

struct Sewn {
  FoundSolids found;
  int open_faces = 0;  ///< left out
};

/// The solids that the shape's faces sew to within the distance. Throws InvalidInput where there is none.
Sewn sew(const FileShape& read, double distance, const Monitor& monitor) {
  BRepBuilderAPI_Sewing sewing(distance);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(read.shape, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
  const opencascade::handle<OcctProgress> progress = new OcctProgress(monitor);
  sewing.Perform(progress->Start());
  monitor.check();
  const auto became = [&](const TopoDS_Shape& shape) {
    if (shape.ShapeType() == TopAbs_FACE && sewing.IsModified(shape)) return sewing.Modified(shape);
    return sewing.IsModifiedSubShape(shape) ? sewing.ModifiedSubShape(shape) : shape;
  };
  const std::string start = "the shape is a shell or loose faces, not a solid: sewn within " + number_text(distance) + " mm ";
  const TopoDS_Shape sewn = sewing.SewedShape();
  if (sewn.IsNull()) throw InvalidInput(start + "nothing is left of it");
  const Numbering numbers = numbering(read.shape, sewn, became);
  std::vector<TopoDS_Shell> shells;
  int open_faces = 0;
  TopoDS_Edge open_edge;
  for (TopoDS_Shell& shell : shells_of(sewn)) {
    if (const TopoDS_Edge edge = first_open_edge(shell); !edge.IsNull()) {
      open_faces += count(shell, TopAbs_FACE);
      if (open_edge.IsNull()) open_edge = edge;
    } else {
      shells.push_back(shell);
    }
  }
  if (shells.empty() && !open_edge.IsNull()) {
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(sewn, TopAbs_EDGE, edges);
    throw InvalidInput(start + "it is open at " + name_of(numbers, 1, edges.FindIndex(open_edge)));
  }
  if (shells.empty()) throw InvalidInput(start + "no shell comes of it");
  FoundSolids found;
  TopoDS_Compound whole;
  BRep_Builder().MakeCompound(whole);
  for (const TopoDS_Solid& solid : solids_of(shells)) {
    found.solids.push_back({solid, {}, {}});
    BRep_Builder().Add(whole, solid);
  }
  const Numbering all = numbering(read.shape, whole, became);
  for (FoundSolid& solid : found.solids) solid.numbers = part_of(all, whole, solid.solid);
  const auto first_face = [](const FoundSolid& solid) { return *std::min_element(solid.numbers[2].begin(), solid.numbers[2].end()); };
  std::sort(found.solids.begin(), found.solids.end(), [&](const FoundSolid& a, const FoundSolid& b) { return first_face(a) < first_face(b); });
  const bool one = found.solids.size() == 1;
  found.warnings.push_back("the shape is no solid: its " + plural(count(whole, TopAbs_FACE), "face is", "faces are") + " sewn to " +
                           (one ? "one" : std::to_string(found.solids.size()) + " solids") + " within " + number_text(distance) + " mm");
  const std::string left_out = beside(open_faces, count(read.shape, TopAbs_EDGE, TopAbs_FACE), count(read.shape, TopAbs_VERTEX, TopAbs_EDGE));
  if (!left_out.empty()) found.warnings.push_back(left_out);
  return {std::move(found), open_faces};
}

/// Within the least distance that leaves the fewest faces out.
FoundSolids sew(const FileShape& read, const Monitor& monitor) {
  std::optional<Sewn> best;
  std::optional<InvalidInput> refusal;
  for (const double distance : sewing_distances(read)) {
    try {
      Sewn sewn = sew(read, distance, monitor);
      for (const FoundSolid& solid : sewn.found.solids) validate(solid.solid, solid.numbers, monitor);
      if (!best || sewn.open_faces < best->open_faces) best = std::move(sewn);
      if (best->open_faces == 0) break;
    } catch (const InvalidInput& error) {
      refusal = error;
    }
  }
  if (!best) throw InvalidInput(*refusal);
  return std::move(best->found);
}

/// Throws InvalidInput where there is no face to sew, or sewing is not wanted.
void check_sewing(const TopoDS_Shape& shape, bool sew_faces) {
  if (shape.IsNull()) throw InvalidInput("the shape is empty");
  if (count(shape, TopAbs_FACE) == 0) throw InvalidInput("the shape is empty: it has no face");
  if (!sew_faces) throw InvalidInput("the shape is a shell or loose faces, not a solid");
}

FoundSolid find_solid_unguarded(const FileShape& read, bool sew_faces, const Monitor& monitor) {
  const TopoDS_Shape& shape = read.shape;
  if (shape.IsNull()) throw InvalidInput("the shape is empty");
  const int solids = count(shape, TopAbs_SOLID);
  if (solids > 1) throw InvalidInput("the shape holds " + std::to_string(solids) + " solids; one is needed");
  if (solids == 0) {
    check_sewing(shape, sew_faces);
    FoundSolids sewn = sew(read, monitor);
    if (sewn.solids.size() > 1) throw InvalidInput("the shape's faces sew to " + std::to_string(sewn.solids.size()) + " solids; one is needed");
    sewn.solids.front().warnings = std::move(sewn.warnings);
    return sewn.solids.front();
  }
  FoundSolid found{shape, {}, {}};
  int times = 0;
  for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More(); it.Next()) ++times;
  if (times > 1) found.warnings.push_back("the solid is in the shape " + std::to_string(times) + " times; it is meshed once");
  const int edges = count(shape, TopAbs_EDGE, TopAbs_FACE), vertices = count(shape, TopAbs_VERTEX, TopAbs_EDGE);
  if (times > 1 || count(shape, TopAbs_FACE, TopAbs_SOLID) + edges + vertices > 0) {
    found.solid = TopExp_Explorer(shape, TopAbs_SOLID).Current();
    // Faces beside it may be its own, as of a shell that shares them.
    if (std::string left_out = beside(count(shape, TopAbs_FACE) - count(found.solid, TopAbs_FACE), edges, vertices); !left_out.empty())
      found.warnings.push_back(std::move(left_out));
  }
  found.numbers = numbering(shape, found.solid, [](const TopoDS_Shape& entity) { return entity; });
  validate(found.solid, found.numbers, monitor);
  return found;
}

FoundSolids find_solids_unguarded(const FileShape& read, bool sew_faces, const Monitor& monitor) {
  const TopoDS_Shape& shape = read.shape;
  if (shape.IsNull() || count(shape, TopAbs_SOLID) == 0) {
    check_sewing(shape, sew_faces);
    FoundSolids sewn = sew(read, monitor);
    // Those of one solid are its own.
    if (sewn.solids.size() == 1) sewn.solids.front().warnings = std::move(sewn.warnings);
    return sewn;
  }
  if (count(shape, TopAbs_SOLID) == 1) return {{find_solid_unguarded(read, sew_faces, monitor)}, {}};
  FoundSolids found;
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(shape, TopAbs_SOLID, solids);
  for (int i = 1; i <= solids.Extent(); ++i) {
    FoundSolid& solid = found.solids.emplace_back(FoundSolid{solids(i), {}, {}});
    solid.numbers = numbering(shape, solid.solid, [](const TopoDS_Shape& entity) { return entity; });
    try {
      validate(solid.solid, solid.numbers, monitor);
    } catch (const InvalidInput& error) {
      throw InvalidInput(name({3, i}) + ": " + error.what());
    }
  }
  TopTools_IndexedMapOfShape own;
  for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More(); it.Next()) TopExp::MapShapes(it.Current(), TopAbs_FACE, own);
  const std::string left_out =
      beside(count(shape, TopAbs_FACE) - own.Extent(), count(shape, TopAbs_EDGE, TopAbs_FACE), count(shape, TopAbs_VERTEX, TopAbs_EDGE));
  if (!left_out.empty()) found.warnings.push_back(left_out);
  return found;
}

}  // namespace

FoundSolids find_solids(const FileShape& read, bool sew_faces, const Monitor& monitor) {
  try {
    return catching_faults([&] { return find_solids_unguarded(read, sew_faces, monitor); });
  } catch (const Standard_Failure& failure) {
    monitor.check();
    throw InvalidInput("OpenCASCADE cannot check the shape: " + reason_of(failure));
  }
}

FoundSolid find_solid(const FileShape& read, bool sew_faces, const Monitor& monitor) {
  try {
    return catching_faults([&] { return find_solid_unguarded(read, sew_faces, monitor); });
  } catch (const Standard_Failure& failure) {
    monitor.check();
    throw InvalidInput("OpenCASCADE cannot check the shape: " + reason_of(failure));
  }
}

void validate(const TopoDS_Shape& solid, const Numbering& numbers, const Monitor& monitor) {
  try {
    validate_unguarded(solid, numbers, monitor);
  } catch (const Standard_Failure& failure) {
    monitor.check();
    throw InvalidInput("OpenCASCADE cannot check the shape: " + reason_of(failure));
  }
}

}  // namespace polycube
