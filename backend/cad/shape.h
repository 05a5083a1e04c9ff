// The OCCT side of CadModel. Only backend/cad/*.cpp and the tet worker include this.
#pragma once

#include <Eigen/Geometry>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <array>
#include <gp_Circ.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Lin.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <map>
#include <mutex>
#include <optional>
#include <variant>

#include "cad/cad.h"

namespace polycube {

inline Vec3 to_vec(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }
inline Vec3 to_vec(const gp_Pnt& p) { return to_vec(p.XYZ()); }
inline Vec3 to_vec(const gp_Vec& v) { return to_vec(v.XYZ()); }
inline gp_Pnt to_pnt(const Vec3& p) { return {p[0], p[1], p[2]}; }

/// A straight piece of a face's border in (u, v). The true border is within `margin` of it.
struct BorderSegment {
  Vec2 a, b;
  double margin = 0;
  int edge = 0;           ///< CAD edge, 0 where the segment is no border in space (seam, pole, gap)
  bool interior = false;  ///< seam or pole: the face goes on beyond it
};

/// Squares of (u, v) that no border passes are inside or outside as a whole: most questions need no look at the border.
class BorderGrid {
 public:
  BorderGrid() = default;
  /// Of a border whose pieces are too few to be worth it, nothing is known.
  explicit BorderGrid(const std::vector<BorderSegment>& border);
  /// Empty where a border is near, and outside of its box.
  std::optional<bool> inside(const Vec2& uv) const;

 private:
  enum class Cell : char { kFar, kNear, kInside, kOutside };
  Eigen::AlignedBox2d box_;
  int count_ = 0;  // cells along each side
  std::vector<Cell> cells_;
};

/// One edge in one face, with the curve in (u, v) and the direction along which the face lies to the left of it.
struct EdgeUse {
  int face = 0;
  Handle(Geom2d_Curve) curve;
  bool forward = true;  ///< the face, seen against its surface's own normal du x dv, is to the left of the 3D curve's direction
};

struct FaceGeometry {
  TopoDS_Face face;
  Handle(Geom_Surface) surface;  ///< placed, without rectangular trimming
  std::variant<std::monostate, gp_Pln, gp_Cylinder, gp_Cone, gp_Sphere, gp_Torus> closed_form;
  double sign = 1;                           ///< outward normal = sign * du x dv
  Vec2 period = Vec2::Zero();                ///< 0: not periodic
  Vec2 lower, upper;                         ///< natural bounds of the parameters
  std::array<bool, 2> closed{false, false};  ///< both bounds are the same curve in space although the surface is not periodic
  Eigen::AlignedBox2d domain;                ///< box of the trimmed domain
  int border_parts = 0;                      ///< of the border that hang together: wires that touch in a vertex are one
  std::vector<BorderSegment> border;
  BorderGrid border_grid;
  std::vector<int> border_edges;  ///< edges that bound the face in space: no seams, no degenerate ones
  std::vector<Vec2> tips;         ///< (u, v) at degenerate edges: cone tips, poles
  std::vector<Vec3> samples;      ///< points of the trimmed face where there is no closed form
  std::vector<Vec2> sample_uv;
};

struct EdgeGeometry {
  TopoDS_Edge edge;
  Handle(Geom_Curve) curve;  ///< placed; null for a degenerate edge
  std::variant<std::monostate, gp_Lin, gp_Circ> closed_form;
  double first = 0, last = 0;
  double period = 0;  ///< of the curve's parameter, 0: not periodic
  bool closed = false;
  Eigen::AlignedBox3d box;
  std::vector<Vec3> samples;  ///< evenly by parameter, where there is no closed form
  std::vector<EdgeUse> uses;
};

/// OCCT's kind of shape by the dimension of an entity.
inline constexpr std::array<TopAbs_ShapeEnum, 3> kKinds{TopAbs_VERTEX, TopAbs_EDGE, TopAbs_FACE};

/// Numbers of the vertices, edges and faces (by dimension) of a solid, in the order of TopExp::MapShapes on it.
using Numbering = std::array<std::vector<int>, 3>;

/// Values that are worked out once, when they are first asked for.
class NormalTable {
 public:
  template <class Work>
  Vec3 get(const std::array<int, 2>& key, const Work& work) {
    {
      const std::lock_guard lock(mutex_);
      const auto found = values_.find(key);
      if (found != values_.end()) return found->second;
    }
    Vec3 value = work();
    const std::lock_guard lock(mutex_);
    values_.emplace(key, value);
    return value;
  }

 private:
  std::mutex mutex_;
  std::map<std::array<int, 2>, Vec3> values_;
};

/// Tables by number: entry n - 1 is entity n, and empty where the solid has no entity n.
struct CadModel::Shape {
  TopoDS_Shape shape;  ///< the solid, or a compound of nothing else
  Numbering numbers;
  std::array<std::vector<int>, 3> ascending;  ///< the same numbers, sorted
  std::vector<std::string> warnings;
  std::vector<CadFace> faces;
  std::vector<CadEdge> edges;
  std::vector<Vec3> vertices;
  std::vector<FaceGeometry> face_geometry;
  std::vector<EdgeGeometry> edge_geometry;
  Eigen::AlignedBox3d box;
  double volume = 0;
  mutable NormalTable vertex_normals;  ///< by face and vertex

  const FaceGeometry& face(int id) const { return face_geometry[static_cast<std::size_t>(id - 1)]; }
  const EdgeGeometry& edge(int id) const { return edge_geometry[static_cast<std::size_t>(id - 1)]; }
};

/// A shape as a file has it.
struct FileShape {
  TopoDS_Shape shape;
  double tolerance = 0;  ///< mm: what the file declares for all of it, 0 where its format has no such thing
  std::vector<std::string> warnings{};
  std::vector<std::pair<TopoDS_Shape, std::string>> labels{};  ///< solids and the names of what they come from, where the format has them
};

/// The solid of a shape as read. Its entities have the numbers of that whole shape.
struct FoundSolid {
  TopoDS_Shape solid;
  Numbering numbers;
  std::vector<std::string> warnings;
};

/// Reads a file by its suffix; throws InvalidInput. The shape is not checked.
FileShape read_shape(const std::string& path, const ReadOptions& options, const Monitor& monitor);
FileShape read_step(const std::string& path, const Monitor& monitor);
/// An object of a FreeCAD document, where FreeCAD shows it: placements of its containers included.
FileShape read_document(const std::string& path, const std::string& object, const Monitor& monitor);
/// From BREP text; throws InvalidInput. The shape is not checked.
FileShape parse_brep(const std::string& text, const Monitor& monitor);
/// The shape's one solid, checked; or, if it has faces only and `sew_faces`, the solid that they sew to within the file's own tolerance. Throws InvalidInput.
FoundSolid find_solid(const FileShape& read, bool sew_faces, const Monitor& monitor);
/// All solids of a shape as read, and what the user should know of the whole.
struct FoundSolids {
  std::vector<FoundSolid> solids;
  std::vector<std::string> warnings{};
};

/// As find_solid, but of a shape with several solids each of them, in the order of TopExp::MapShapes. Throws InvalidInput, with the solid's name where there
/// are several.
FoundSolids find_solids(const FileShape& read, bool sew_faces, const Monitor& monitor);
/// Throws InvalidInput unless the shape is a closed valid solid of positive volume.
void validate(const TopoDS_Shape& solid, const Numbering& numbers, const Monitor& monitor);
/// Tables of a valid solid. Throws InvalidInput for what the tables cannot express (an edge of three faces).
std::shared_ptr<CadModel::Shape> describe(const TopoDS_Shape& solid, const Numbering& numbers, const Monitor& monitor);
/// The same of a solid that was found, with its warnings after those of reading.
std::shared_ptr<const CadModel::Shape> described(const FoundSolid& found, const std::vector<std::string>& reading, const Monitor& monitor);

/// Parameters of the nearest point of the untrimmed surface, moved by periods into the face's domain where that is possible.
/// `converged` is false where Newton's method ended elsewhere than in a foot point.
Vec2 foot_on_surface(const FaceGeometry& face, const Vec3& p, const Vec2& seed, bool* converged);
/// (u, v) moved by whole periods into the box of the face's domain, as far as possible.
Vec2 wrap(const FaceGeometry& face, const Vec2& uv);
/// Whether the surface's point at wrapped `uv` belongs to the trimmed face.
bool inside(const CadModel::Shape& shape, const FaceGeometry& face, const Vec2& uv);
/// The same by every piece of the border.
bool inside_by_border(const CadModel::Shape& shape, const FaceGeometry& face, const Vec2& uv);
/// Unit du x dv, also at poles.
Vec3 surface_normal(const FaceGeometry& face, const Vec2& uv);
EdgePoint nearest_on_edge(const EdgeGeometry& edge, const Vec3& p, const double* seed);

}  // namespace polycube
