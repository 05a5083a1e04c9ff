#include <algorithm>
#include <cmath>

#include "core/hexahedron.h"
#include "fit/energy.h"
#include "fit/tuning.h"

namespace polycube {

namespace {

struct Face {
  std::array<int, 4> nodes;  // sorted
  int side;                  // 6 * hex + face
  friend bool operator<(const Face& x, const Face& y) { return x.nodes != y.nodes ? x.nodes < y.nodes : x.side < y.side; }
};

std::array<int, 3> matching_axes(const Hex& hex, int face, const Hex& other, int other_face) {
  std::array<int, 3> axes{};
  axes[face / 2] = other_face / 2;
  const auto& corners = kHexFaces[face];
  for (int k = 0; k < 2; ++k) {
    std::array<int, 2> place;
    for (int e = 0; e < 2; ++e) place[e] = static_cast<int>(std::find(other.begin(), other.end(), hex[corners[k + e]]) - other.begin());
    axes[edge_axis(corners[k], corners[k + 1])] = edge_axis(place[0], place[1]);
  }
  return axes;
}

}  // namespace

HexGraph build_hex_graph(const HexMesh& mesh) {
  HexGraph graph;
  const int hexes = static_cast<int>(mesh.hexes.size());
  graph.first.assign(mesh.points.size() + 1, 0);
  for (const Hex& hex : mesh.hexes) {
    for (int node : hex) ++graph.first[node + 1];
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) graph.first[v + 1] += graph.first[v];
  graph.corners.resize(8 * mesh.hexes.size());
  std::vector<int> cursor(graph.first.begin(), graph.first.end() - 1);
  std::vector<Face> faces;
  faces.reserve(6 * mesh.hexes.size());
  for (int h = 0; h < hexes; ++h) {
    for (int c = 0; c < 8; ++c) graph.corners[cursor[mesh.hexes[h][c]]++] = 8 * h + c;
    for (int f = 0; f < 6; ++f) {
      Face face{{}, 6 * h + f};
      for (int k = 0; k < 4; ++k) face.nodes[k] = mesh.hexes[h][kHexFaces[f][k]];
      std::sort(face.nodes.begin(), face.nodes.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end());
  graph.neighbours.assign(mesh.hexes.size(), {-1, -1, -1, -1, -1, -1});
  graph.axes.resize(mesh.hexes.size());
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    if (faces[i].nodes != faces[i + 1].nodes) continue;
    const int s = faces[i].side, t = faces[i + 1].side;
    graph.neighbours[s / 6][s % 6] = t / 6;
    graph.neighbours[t / 6][t % 6] = s / 6;
    graph.axes[s / 6][s % 6] = matching_axes(mesh.hexes[s / 6], s % 6, mesh.hexes[t / 6], t % 6);
    graph.axes[t / 6][t % 6] = matching_axes(mesh.hexes[t / 6], t % 6, mesh.hexes[s / 6], s % 6);
  }
  return graph;
}

std::vector<Vec3> target_lengths(const HexMesh& mesh, const HexGraph& graph, int smoothing_steps) {
  const int hexes = static_cast<int>(mesh.hexes.size());
  std::vector<Vec3> lengths(hexes), smoothed(hexes);
  for (int h = 0; h < hexes; ++h) {
    Vec3& l = lengths[h];
    l.setZero();
    for (const auto& [c, d] : kHexEdges) l[edge_axis(c, d)] += (mesh.points[mesh.hexes[h][c]] - mesh.points[mesh.hexes[h][d]]).norm() / 4;
    l = l.cwiseMax(l.maxCoeff() / kFitTuning.widest_aspect);
  }
  for (int step = 0; step < smoothing_steps; ++step) {
    for (int h = 0; h < hexes; ++h) {
      Vec3 sum = Vec3::Zero();
      int count = 0;
      for (int f = 0; f < 6; ++f) {
        const int n = graph.neighbours[h][f];
        if (n < 0) continue;
        ++count;
        for (int k = 0; k < 3; ++k) sum[k] += lengths[n][graph.axes[h][f][k]];
      }
      smoothed[h] = count > 0 ? Vec3((lengths[h] + sum / count) / 2) : lengths[h];
    }
    lengths.swap(smoothed);
  }
  return lengths;
}

}  // namespace polycube
