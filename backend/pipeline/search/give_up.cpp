#include "pipeline/search/give_up.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "core/error.h"
#include "label/features.h"
#include "pipeline/gate.h"
#include "pipeline/search/tuning.h"

namespace polycube {
namespace {

// Of the edges that bend less than `limit` and are not `kept` (per CAD edge; empty for none), those with most nodes of faulty cells.
bool drop(const CadModel& model, const PaddedMesh& padded, const std::vector<char>& kept, double limit, int count, AssociateOptions& options,
          const Monitor& monitor) {
  std::vector<std::set<int>> edges_at(padded.mesh.points.size());
  for (std::size_t i = 0; i < padded.association.segments.size(); ++i) {
    for (int n : padded.association.segments[i]) edges_at[n].insert(padded.association.segment_edge[i]);
  }
  std::map<int, int> blame;
  for (const Hex& h : padded.mesh.hexes) {
    if (!is_faulty(model, padded.mesh, h)) continue;
    for (int n : h) {
      for (int e : edges_at[n]) {
        if (!options.edge_chains[e].empty() && bend(model.edge(e)) < limit && (kept.empty() || !kept[e])) ++blame[e];
      }
    }
  }
  if (blame.empty()) return false;
  std::vector<std::pair<int, int>> worst;  // (minus blame, edge)
  worst.reserve(blame.size());
  for (const auto& [edge, nodes] : blame) worst.emplace_back(-nodes, edge);
  std::sort(worst.begin(), worst.end());
  for (int i = 0; i < std::min(count, static_cast<int>(worst.size())); ++i) {
    options.edge_chains[worst[i].second].clear();
    monitor.log("pad: " + name({1, worst[i].second}) + " is given up");
  }
  return true;
}

}  // namespace

bool give_up_edges(const CadModel& model, const FaceList& keep_faces, const PaddedMesh& padded, int count, AssociateOptions& options, const Monitor& monitor) {
  std::vector<char> kept(static_cast<std::size_t>(model.edge_count()) + 1, 0);
  for (const int e : model.edges()) {
    for (int f : model.edge(e).faces) kept[e] |= std::find(keep_faces.begin(), keep_faces.end(), f) != keep_faces.end();
  }
  return drop(model, padded, kept, kSearchTuning.smooth_bend, count, options, monitor) ||
         drop(model, padded, kept, std::numbers::pi, count, options, monitor) ||
         drop(model, padded, {}, std::numeric_limits<double>::infinity(), count, options, monitor);
}

void give_up_around(const CadModel& model, const PaddedMesh& padded, int rings, AssociateOptions& options, const Monitor& monitor) {
  std::vector<char> near(padded.mesh.points.size(), 0);
  const auto reach = [&](const auto& which) {
    std::vector<int> nodes;
    for (const Hex& h : padded.mesh.hexes) {
      if (which(h)) nodes.insert(nodes.end(), h.begin(), h.end());
    }
    for (int n : nodes) near[n] = 1;
  };
  reach([&](const Hex& h) { return is_faulty(model, padded.mesh, h); });
  for (int ring = 0; ring < rings; ++ring) reach([&](const Hex& h) { return std::any_of(h.begin(), h.end(), [&](int n) { return near[n] != 0; }); });
  for (std::size_t i = 0; i < padded.association.segments.size(); ++i) {
    const int edge = padded.association.segment_edge[i];
    const auto& [a, b] = padded.association.segments[i];
    if ((!near[a] && !near[b]) || options.edge_chains[edge].empty()) continue;
    options.edge_chains[edge].clear();
    monitor.log("pad: " + name({1, edge}) + " is given up");
  }
}

}  // namespace polycube
