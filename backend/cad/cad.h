// The CAD model: one solid, read and queried with OpenCASCADE behind this header.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/monitor.h"
#include "core/types.h"

namespace polycube {

enum class SurfaceKind { kPlane, kCylinder, kCone, kSphere, kTorus, kExtrusion, kRevolution, kOther };

struct CadFace {
  SurfaceKind kind = SurfaceKind::kOther;  ///< what it is, however the file writes it (a line revolved about a parallel axis is a cylinder)
  double area = 0;                         ///< mm^2
  Vec3 axis = Vec3::Zero();                ///< plane: outward normal; cylinder, cone, torus, revolution: axis; extrusion: direction; else zero. Unit.
  Vec3 centre = Vec3::Zero();              ///< a point on the axis, or in the plane
  double radius = 0;                       ///< cylinder, sphere, torus (minor): mm, else 0
  std::vector<int> edges;                  ///< CAD edges on its border, ascending, without degenerate ones
  double tolerance = 0;                    ///< mm
};

struct CadEdge {
  std::array<int, 2> faces{0, 0};     ///< CAD faces on both sides; the same twice for a seam
  std::array<int, 2> vertices{0, 0};  ///< start and end; the same twice for a closed edge
  double length = 0;                  ///< mm
  bool closed = false;
  bool seam = false;                    ///< both sides are the same face
  bool degenerate = false;              ///< a point (cone tip, sphere pole): no curve
  bool tip = false;                     ///< degenerate, and the face runs into a point there, as a cone does and a sphere at its pole does not
  bool tiny = false;                    ///< shorter than 1e-5 of the part's diagonal: all edges that end at one of its vertices name the first of them
  double min_angle = 0, max_angle = 0;  ///< least and largest interior dihedral angle along it, radians: pi smooth, < pi convex
  double tolerance = 0;                 ///< mm
};

struct FacePoint {
  Vec3 point = Vec3::Zero();  ///< on the trimmed face
  Vec2 uv = Vec2::Zero();
  double distance = 0;  ///< mm, from the asked point
};

struct EdgePoint {
  Vec3 point = Vec3::Zero();
  double t = 0;         ///< curve parameter
  double distance = 0;  ///< mm
};

struct ReadOptions {
  std::string object{};               ///< name or label of the object to take from a FreeCAD document
  bool sew = true;                    ///< take faces without a solid for one if they sew to it within the file's own tolerance
  std::vector<std::string> labels{};  ///< of the solids, in the order of FreeCAD's names, where the shape has none itself
};

/// One valid solid. Copies share the shape. All const members are safe to call from several threads at once.
/// Face, edge and vertex numbers are FreeCAD's: 1-based, the order of TopExp::MapShapes on the whole shape as read. Where that shape holds more than
/// its solid (loose faces, edges, vertices), or its faces had to be sewn, the numbers of the solid's entities have gaps.
class CadModel {
 public:
  /// Reads .step, .stp, .iges, .igs, .brep, .brp, .FCStd; lengths come out in mm. Throws InvalidInput with one line: unreadable, empty, open, not one
  /// solid, self-intersecting, zero volume.
  static CadModel read(const std::string& path, const ReadOptions& options = {}, const Monitor& monitor = Monitor());
  /// From BREP text (what FreeCAD's Shape.exportBrepToString gives). Throws InvalidInput.
  static CadModel from_brep(const std::string& text, const ReadOptions& options = {}, const Monitor& monitor = Monitor());
  /// What the user should know of how the solid was found, one line each: what was left out, what was sewn.
  const std::vector<std::string>& warnings() const;
  /// The solid as BREP text.
  std::string to_brep() const;
  /// Numbers of the solid's entities of dimension 0 to 2 in the order in which TopExp::MapShapes finds them in to_brep().
  const std::vector<int>& brep_order(int dim) const;
  /// The solid with p -> scale * rotation * p + translation (rotation proper orthogonal, scale > 0), entities numbered and edges directed as here.
  /// Every number of its geometry is rounded to a multiple of `grid` (0: left alone), far below OCCT's confusion of 1e-7 mm: solids that differ by
  /// rounding only become the same to the last bit. Throws InvalidInput where the result is no valid solid or has other entities.
  CadModel transformed(const Mat3& rotation, const Vec3& translation, double scale, double grid) const;

  /// Numbers of the entities that the solid has, ascending.
  const std::vector<int>& faces() const;
  const std::vector<int>& edges() const;
  const std::vector<int>& vertices() const;
  /// The largest number: how many there are, unless the numbers have gaps.
  int face_count() const;
  int edge_count() const;
  int vertex_count() const;
  const CadFace& face(int id) const;
  const CadEdge& edge(int id) const;
  const Vec3& vertex(int id) const;

  /// Faces, edges and vertices, faces first, at which the solid touches or crosses itself; empty for a sound one. Seconds for a part of a hundred faces.
  std::vector<CadRef> self_contacts() const;

  Vec3 box_min() const;
  Vec3 box_max() const;
  double diagonal() const;           ///< of the bounding box, mm
  double volume() const;             ///< mm^3
  int euler_characteristic() const;  ///< of the boundary surface

  /// Nearest point of the trimmed face. `seed`, if not null, is a (u, v) near the answer and makes it much faster.
  FacePoint project_to_face(int id, const Vec3& p, const Vec2* seed = nullptr) const;
  /// Nearest point of the edge; `seed`, if not null, is a parameter near the answer.
  EdgePoint project_to_edge(int id, const Vec3& p, const double* seed = nullptr) const;
  /// Unit normal pointing out of the solid.
  Vec3 face_normal(int id, const Vec2& uv) const;
  /// The same at one of the face's vertices.
  Vec3 vertex_normal(int face, int vertex) const;
  /// How the surface bends: a step d in its tangent plane leads to d + (d . bend d) / 2 normals, to second order. Zero where it has no tangent plane.
  Mat3 face_bend(int id, const Vec2& uv) const;
  Vec3 face_point(int id, const Vec2& uv) const;
  Vec3 edge_point(int id, double t) const;
  Vec3 edge_tangent(int id, double t) const;                ///< unit, start to end
  Vec3 edge_bend(int id, double t) const;                   ///< curvature vector, 1 / mm, towards the centre of curvature
  std::array<double, 2> edge_range(int id) const;           ///< parameters of start and end
  std::vector<Vec3> edge_samples(int id, int count) const;  ///< count >= 2 points evenly by parameter, both ends included

  struct Shape;  // OCCT behind it, see cad/shape.h
  const Shape& shape() const { return *shape_; }

 private:
  friend struct Assembly;
  friend class ConformalBuilder;
  explicit CadModel(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {}
  std::shared_ptr<const Shape> shape_;
};

}  // namespace polycube
