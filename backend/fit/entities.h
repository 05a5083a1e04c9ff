// The CAD entities on which the nodes of a mesh slide.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"

namespace polycube {

/// Keeps for every boundary node its vertex, edge or faces, a seed for the next projection and the tangent space there.
class Entities {
 public:
  Entities(const CadModel& model, const Association& association, int threads);

  /// Moves the listed nodes (all if null) to the nearest point of their entity and notes the tangent space there. Nodes of dimension 3
  /// stay.
  void project(std::vector<Vec3>& points, const std::vector<int>* nodes = nullptr);
  /// One node, from place p.
  Vec3 project(int node, const Vec3& p);
  /// How far p is from the node's entity, found without seed.
  double distance(int node, const Vec3& p) const;
  /// Tells the seed of an edge node before its first projection.
  void set_edge_parameter(int node, double t) {
    seeds_[node] = Vec2(t, 0);
    seeded_[node] = 1;
  }

  double edge_parameter(int node) const { return seeds_[node][0]; }

  int dimension(int node) const { return association_.point_cad[node].dim; }
  const CadRef& cad(int node) const { return association_.point_cad[node]; }
  /// Where a step along the entity from the node's last projection leads, bent with it to second order.
  Vec3 bent(int node, const Vec3& step) const;
  /// A gradient by the node's place, taken at bent(step), as gradient by the step: along the entity at the node's last projection.
  Vec3 along(int node, const Vec3& gradient, const Vec3& step) const;
  /// The angle by which the entity turns over a step, radians.
  double turned(int node, const Vec3& step) const;
  /// Boundary nodes, ascending.
  const std::vector<int>& boundary() const { return boundary_; }
  /// Outward normal of the CAD face at a patch node's last projection.
  const Vec3& normal(int node) const { return frames_[node]; }
  /// CAD face a patch node stands on, 0 for others.
  int face(int node) const { return faces_[node]; }

 private:
  const CadModel& model_;
  const Association& association_;
  int threads_;
  std::vector<int> boundary_;
  std::vector<Vec2> seeds_;  // (u, v) or (t, 0)
  std::vector<char> seeded_;
  std::vector<int> faces_;
  std::vector<Vec3> frames_;  // unit normal of a face node, unit tangent of an edge node
  std::vector<Mat3> bends_;   // of a face node; the first column is that of an edge node
};

}  // namespace polycube
