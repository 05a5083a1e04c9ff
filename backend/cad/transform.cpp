// The same solid elsewhere.
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools.hxx>
#include <ShapeUpgrade_RemoveLocations.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gp_Trsf.hxx>

#include "cad/occt.h"
#include "cad/shape.h"
#include "core/error.h"

namespace polycube {
namespace {

// Rounds the real numbers of a BREP text; whole numbers (counts, references) and words stay.
std::string on_grid(const std::string& text, double grid) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n\t\r", i), text.size());
    const std::string token = text.substr(i, end - i);
    char* stop = nullptr;
    const double value = std::strtod(token.c_str(), &stop);
    if (token.find_first_of(".e") != std::string::npos && stop == token.c_str() + token.size() && stop != token.c_str()) {
      char number[32];
      const double rounded = std::round(value / grid) * grid;
      std::snprintf(number, sizeof number, "%.17g", rounded == 0 ? 0.0 : rounded);  // no negative zero
      result += number;
    } else {
      result += token == "-0" ? "0" : token;
    }
    if (end < text.size()) result += text[end];
    i = end + 1;
  }
  return result;
}

}  // namespace

CadModel CadModel::transformed(const Mat3& rotation, const Vec3& translation, double scale, double grid) const {
  TopoDS_Shape shape;
  try {
    gp_Trsf motion;
    const Mat3& r = rotation;
    motion.SetValues(r(0, 0), r(0, 1), r(0, 2), translation[0], r(1, 0), r(1, 1), r(1, 2), translation[1], r(2, 0), r(2, 1), r(2, 2), translation[2]);
    motion.SetScaleFactor(scale);
    // A placement kept beside the geometry would bring back the digits that rounding is to remove.
    ShapeUpgrade_RemoveLocations placed;
    if (!placed.Remove(shape_->shape.Located(TopLoc_Location()))) throw InvalidInput("OpenCASCADE cannot place the shape");
    motion.Multiply(shape_->shape.Location().Transformation());
    shape = BRepBuilderAPI_Transform(placed.GetResult(), motion, true).Shape();
  } catch (const Standard_Failure& failure) {
    throw InvalidInput("OpenCASCADE cannot move the shape: " + reason_of(failure));
  }
  const auto numbered = [&](const TopoDS_Shape& solid) {
    // What OCCT changed about the solid must not take it out of the tables.
    for (std::size_t dim = 0; dim < 3; ++dim) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(solid, kKinds[dim], map);
      if (map.Extent() != static_cast<int>(shape_->numbers[dim].size())) throw InvalidInput("OpenCASCADE changes the shape when it moves it");
    }
    validate(solid, shape_->numbers, Monitor());
    return CadModel(describe(solid, shape_->numbers, Monitor()));
  };
  CadModel moved = numbered(shape);
  if (grid > 0) moved = numbered(parse_brep(on_grid(moved.to_brep(), grid), Monitor()).shape);
  // Entities must have kept their numbers and directions.
  const double reach = 1e-5 * scale * diagonal();
  const auto there = [&](const Vec3& p, const Vec3& q) { return (scale * (rotation * p) + translation - q).norm() <= reach; };
  bool same = std::all_of(vertices().begin(), vertices().end(), [&](int v) { return there(vertex(v), moved.vertex(v)); });
  for (const int e : edges()) {
    same = same && edge(e).vertices == moved.edge(e).vertices && edge(e).faces == moved.edge(e).faces;
    const auto before = edge_samples(e, 3), after = moved.edge_samples(e, 3);
    for (std::size_t i = 0; same && i < before.size(); ++i) same = there(before[i], after[i]);
  }
  same = same && std::all_of(faces().begin(), faces().end(), [&](int f) { return face(f).edges == moved.face(f).edges; });
  if (!same) throw InvalidInput("OpenCASCADE renumbers the shape when it moves it");
  return moved;
}

}  // namespace polycube
