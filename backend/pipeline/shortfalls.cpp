#include "pipeline/shortfalls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "core/error.h"
#include "core/hexahedron.h"
#include "pad/topology.h"
#include "pipeline/circles.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 4> kQuadEdges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};

Vec3 unit_normal(const std::vector<Vec3>& points, const Quad& q) { return (points[q[2]] - points[q[0]]).cross(points[q[3]] - points[q[1]]).normalized(); }

std::string faces_of(const std::vector<int>& patch) {
  std::string text;
  for (int f : patch) text += (text.empty() ? "" : "+") + name({2, f});
  return text;
}

std::string short_text(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", length);
  return text.data();
}

std::string counted(int elements) { return std::to_string(elements) + (elements == 1 ? " element" : " elements"); }

}  // namespace

std::vector<int> elements_on_edges(const Association& association, int edge_count) {
  std::vector<int> count(static_cast<std::size_t>(edge_count) + 1, 0);
  for (const int e : association.segment_edge) ++count[e];
  return count;
}

Shortfalls find_shortfalls(const CadModel& model, const HexMesh& mesh, const Association& association, int min_layers, int per_circle) {
  Shortfalls result;
  if (min_layers > 1) {
    const HexTopology topology = build_topology(mesh, association.quads);
    std::map<std::array<int, 2>, int> least;  // per pair of patches
    for (int q = 0; q < static_cast<int>(association.quads.size()); ++q) {
      int side = topology.quad_side[q], cells = 0;
      while (side >= 0 && cells < min_layers) {
        ++cells;
        side = topology.mate[side ^ 1];
      }
      const int end = -1 - side;
      if (side >= 0 || cells >= min_layers || end >= static_cast<int>(association.quads.size())) continue;
      if (unit_normal(mesh.points, association.quads[q]).dot(unit_normal(mesh.points, association.quads[end])) > kPipelineTuning.opposite) continue;
      const int a = association.quad_patch[q], b = association.quad_patch[end];
      const auto [at, fresh] = least.try_emplace({std::min(a, b), std::max(a, b)}, cells);
      if (!fresh) at->second = std::min(at->second, cells);
    }
    for (const auto& [pair, cells] : least) {
      result.thin_walls.push_back(faces_of(association.patches[pair[0]]) + "-" + faces_of(association.patches[pair[1]]) + ": " + counted(cells) +
                                  " through the wall, not " + std::to_string(min_layers));
    }
  }
  const std::vector<RoundEdge> edges = round_edges(model, per_circle);
  const std::vector<int> missing = missing_elements(edges, elements_on_edges(association, model.edge_count()));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (missing[i] == 0) continue;
    const int wanted = edges[i].circle > 0 ? edges[i].round : edges[i].elements;
    result.coarse_circles.push_back(name({1, edges[i].edge}) + ": " + counted(wanted - missing[i]) + (edges[i].circle > 0 ? " round" : " along") +
                                    " the curve, not " + std::to_string(wanted));
  }
  return result;
}

std::vector<std::string> unmet_sizes(const HexMesh& mesh, const Association& association, const LocalSizes& sizes) {
  std::vector<std::string> lines;
  for (const LocalSize& s : sizes) {
    double sum = 0;
    int count = 0;
    const auto add = [&](const auto& nodes, const auto& edges) {
      double longest = 0;
      for (const auto& [a, b] : edges) longest = std::max(longest, (mesh.points[nodes[a]] - mesh.points[nodes[b]]).norm());
      sum += longest;
      ++count;
    };
    if (s.solid > 0)
      for (const Hex& hex : mesh.hexes) add(hex, kHexEdges);
    for (std::size_t q = 0; q < association.quads.size() && s.face > 0; ++q) {
      const std::vector<int>& faces = association.patches[association.quad_patch[q]];
      if (std::find(faces.begin(), faces.end(), s.face) != faces.end()) add(association.quads[q], kQuadEdges);
    }
    const double found = count > 0 ? sum / count : s.size;
    if (found > kPipelineTuning.size_rounding * s.size || kPipelineTuning.size_rounding * found < s.size)
      lines.push_back("size " + text_of(s) + ": the cells there are " + short_text(found) + " mm long");
  }
  return lines;
}

std::vector<std::string> merged_faces(const CadCapture& capture, const Association& association) {
  constexpr std::size_t kNamed = 6;  // more would hide the other warnings; the report has them all
  std::vector<std::string> lines;
  for (const auto& patch : association.patches) {
    if (patch.size() < 2 || !std::binary_search(capture.ignored_faces.begin(), capture.ignored_faces.end(), patch[0])) continue;
    std::string faces;
    for (std::size_t i = 0; i < std::min(patch.size(), kNamed); ++i) faces += (i == 0 ? "" : ", ") + name({2, patch[i]});
    if (patch.size() > kNamed) faces += " and " + std::to_string(patch.size() - kNamed) + " more";
    lines.push_back(faces +
                    " are one surface to the mesh, as the feature angle asks: the borders of their mesh faces are off the CAD edges between them, and "
                    "their areas differ from the CAD's");
  }
  return lines;
}

}  // namespace polycube
