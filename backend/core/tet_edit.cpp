#include "core/tet_edit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "core/tuning.h"

namespace polycube {
namespace {

double six_volumes(const std::array<Vec3, 4>& p) { return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]); }

Segment sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

template <class Cell>
bool contains(const Cell& cell, int node) {
  return std::find(cell.begin(), cell.end(), node) != cell.end();
}

}  // namespace

TetEditor::TetEditor(TetMesh& mesh)
    : mesh_(mesh), tets_at_(mesh.points.size()), triangles_at_(mesh.points.size()), inner_at_(mesh.points.size()), parent_(mesh.triangles.size()) {
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int n : mesh.tets[t]) tets_at_[n].push_back(t);
  }
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int n : mesh.triangles[t]) triangles_at_[n].push_back(t);
  }
  for (int t = 0; t < static_cast<int>(mesh.inner_triangles.size()); ++t) {
    for (int n : mesh.inner_triangles[t]) inner_at_[n].push_back(t);
  }
  for (int i = 0; i < static_cast<int>(mesh.inner_segments.size()); ++i) inner_segment_[sorted(mesh.inner_segments[i][0], mesh.inner_segments[i][1])] = i;
  for (int i = 0; i < static_cast<int>(mesh.segments.size()); ++i) segment_[sorted(mesh.segments[i][0], mesh.segments[i][1])] = i;
  std::iota(parent_.begin(), parent_.end(), 0);
}

std::vector<int> TetEditor::around(const std::vector<std::vector<int>>& at, int a, int b) const {
  std::vector<int> result;
  std::set_intersection(at[a].begin(), at[a].end(), at[b].begin(), at[b].end(), std::back_inserter(result));
  return result;
}

bool TetEditor::keeps_volumes(int a, int b, const Vec3& point) const {
  for (int t : around(tets_at_, a, b)) {
    for (int end : {a, b}) {
      std::array<Vec3, 4> p;
      for (int k = 0; k < 4; ++k) p[k] = mesh_.tets[t][k] == end ? point : mesh_.points[mesh_.tets[t][k]];
      if (six_volumes(p) <= 0) return false;
    }
  }
  return true;
}

bool TetEditor::move(int node, const Vec3& to) {
  for (int t : tets_at_[node]) {
    std::array<Vec3, 4> before, after;
    for (int k = 0; k < 4; ++k) {
      const int n = mesh_.tets[t][k];
      before[k] = mesh_.points[n];
      after[k] = n == node ? to : mesh_.points[n];
    }
    if (six_volumes(after) <= kCoreTuning.least_share * six_volumes(before)) return false;
  }
  mesh_.points[node] = to;
  return true;
}

bool TetEditor::is_segment(int a, int b) const { return segment_.count(sorted(a, b)) > 0; }

int TetEditor::split_edge(int a, int b, const Vec3& point) {
  const int middle = static_cast<int>(mesh_.points.size());
  mesh_.points.push_back(point);
  mesh_.point_cad.push_back({3, 1});
  tets_at_.emplace_back();
  triangles_at_.emplace_back();
  inner_at_.emplace_back();
  // In each piece one end is replaced; indices stay ascending in the lists because new cells come last.
  const auto split = [&](auto& cells, std::vector<std::vector<int>>& at, const std::vector<int>& which) {
    for (int c : which) {
      auto other = cells[c];
      std::replace(other.begin(), other.end(), a, middle);
      std::replace(cells[c].begin(), cells[c].end(), b, middle);
      std::erase(at[b], c);
      const int fresh = static_cast<int>(cells.size());
      cells.push_back(other);
      for (int n : other) at[n].push_back(fresh);
      at[middle].push_back(c);
    }
    std::sort(at[middle].begin(), at[middle].end());
  };
  const std::vector<int> triangles = around(triangles_at_, a, b);
  const std::vector<int> tets = around(tets_at_, a, b), inner = around(inner_at_, a, b);
  split(mesh_.tets, tets_at_, tets);
  for (int t : tets) {
    if (!mesh_.tet_solid.empty()) mesh_.tet_solid.push_back(mesh_.tet_solid[t]);
  }
  split(mesh_.inner_triangles, inner_at_, inner);
  for (int t : inner) mesh_.inner_face.push_back(mesh_.inner_face[t]);
  split(mesh_.triangles, triangles_at_, triangles);
  for (int t : triangles) {
    mesh_.triangle_face.push_back(mesh_.triangle_face[t]);
    parent_.push_back(t);
    mesh_.point_cad[middle] = {2, mesh_.triangle_face[t]};
  }
  const auto split_segment = [&](std::vector<Segment>& segments, std::vector<int>& edges, std::map<Segment, int>& index) {
    const auto it = index.find(sorted(a, b));
    if (it == index.end()) return 0;
    const int i = it->second, edge = edges[i];
    index.erase(it);
    segments[i] = {a, middle};
    index[sorted(a, middle)] = i;
    index[sorted(middle, b)] = static_cast<int>(segments.size());
    segments.push_back({middle, b});
    edges.push_back(edge);
    return edge;
  };
  if (const int edge = split_segment(mesh_.segments, mesh_.segment_edge, segment_); edge > 0) mesh_.point_cad[middle] = {1, edge};
  split_segment(mesh_.inner_segments, mesh_.inner_segment_edge, inner_segment_);
  return middle;
}

}  // namespace polycube
