#include "pipeline/conform_pad.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/sorted.h"
#include "pipeline/block_ids.h"

namespace polycube {
namespace {

bool is_interface(const ConformalModel& model, int face) {
  return std::any_of(model.interfaces.begin(), model.interfaces.end(), [&](const auto& i) { return i.first == face; });
}

Quad side_of(const Hex& hex, int side) {
  const auto& f = kHexFaces[static_cast<std::size_t>(side)];
  return {hex[f[0]], hex[f[1]], hex[f[2]], hex[f[3]]};
}

/// By sorted nodes: hexes and their sides there, as 6 * hex + side.
using Sides = std::map<Quad, std::vector<int>>;

Sides sides_of(const HexMesh& mesh, const Monitor& monitor) {
  Sides sides;
  for (int h = 0; h < static_cast<int>(mesh.hexes.size()); ++h) {
    if (h % 1024 == 0) monitor.check();
    for (int f = 0; f < 6; ++f) sides[sorted(side_of(mesh.hexes[h], f))].push_back(6 * h + f);
  }
  return sides;
}

template <class Row>
std::set<Segment> edges_of(const Row& quads) {
  std::set<Segment> edges;
  for (const Quad& q : quads)
    for (std::size_t k = 0; k < 4; ++k) edges.insert(sorted(Segment{q[k], q[(k + 1) % 4]}));
  return edges;
}

/// What of an association is on the outside.
Association outside(const ConformalModel& model, const Association& all) {
  Association result;
  result.patches = all.patches;
  result.point_cad.assign(all.point_cad.size(), {3, 1});
  for (std::size_t q = 0; q < all.quads.size(); ++q) {
    if (is_interface(model, all.patches[all.quad_patch[q]].front())) continue;
    result.quads.push_back(all.quads[q]);
    result.quad_patch.push_back(all.quad_patch[q]);
    for (const int n : all.quads[q]) result.point_cad[n] = all.point_cad[n];
  }
  const std::set<Segment> edges = edges_of(result.quads);
  for (std::size_t s = 0; s < all.segments.size(); ++s) {
    if (!edges.contains(sorted(all.segments[s]))) continue;
    result.segments.push_back(all.segments[s]);
    result.segment_edge.push_back(all.segment_edge[s]);
  }
  return result;
}

class Parting {
 public:
  Parting(const ConformalModel& model, const PaddedGrids& before, const PaddedMesh& padded, const Monitor& monitor)
      : model_(model), before_(before), padded_(padded), monitor_(monitor), sides_(sides_of(padded.mesh, monitor)) {
    std::vector<int> solid(before.joined.whole.mesh.hexes.size());
    for (std::size_t s = 0; s < before.joined.hex.size(); ++s)
      for (const int h : before.joined.hex[s]) solid[h] = static_cast<int>(s);
    // Where a layer opens the mesh along an interface, the nodes of that stay with the solid outside of the layer, and its cells are of the one inside.
    std::set<Quad> interfaces;
    const Association& a = before.joined.whole.association;
    for (std::size_t q = 0; q < a.quads.size(); ++q)
      if (is_interface(model, a.patches[a.quad_patch[q]].front())) interfaces.insert(sorted(a.quads[q]));
    solid_ = carry_blocks(padded.mesh, std::move(solid), interfaces);
  }

  /// None where the interfaces cannot be followed through the layers.
  std::optional<PaddedGrids> run() {
    if (!find_interfaces() || !place_nodes() || !keep_inner_segments()) return std::nullopt;
    PaddedGrids result = part_grids(model_, {padded_.mesh, all_}, solid_, before_.solids, monitor_);
    for (std::size_t s = 0; s < result.solids.size(); ++s)
      result.added_hexes.push_back(before_.added_hexes[s] + static_cast<int>(result.solids[s].mesh.hexes.size() - before_.solids[s].mesh.hexes.size()));
    return result;
  }

 private:
  /// Quads between cells of different solids, each with its CAD face: what was one before has its own, new ones that of the one beside them.
  bool find_interfaces() {
    std::map<int, int> known;  // per side of a hex as before
    const Association& a = before_.joined.whole.association;
    const Sides old = sides_of(before_.joined.whole.mesh, monitor_);
    for (std::size_t q = 0; q < a.quads.size(); ++q) {
      const std::vector<int>& faces = a.patches[a.quad_patch[q]];
      if (!is_interface(model_, faces.front())) continue;
      patch_of_[faces.front()] = a.quad_patch[q];
      for (const int side : old.at(sorted(a.quads[q]))) known[side] = faces.front();
    }
    std::vector<Quad> unknown;
    for (const auto& [quad, sides] : sides_) {
      if (sides.size() != 2 || solid_[sides[0] / 6] == solid_[sides[1] / 6]) continue;
      face_of_[quad] = 0;
      for (const int side : sides)
        if (const auto at = known.find(side); at != known.end()) face_of_[quad] = at->second;
      if (face_of_[quad] == 0) unknown.push_back(quad);
    }
    // From quad to quad over edges where two quads of an interface meet.
    std::map<Segment, std::vector<Quad>> at_edge;
    for (const auto& [quad, face] : face_of_) {
      const Quad round = side_of(padded_.mesh.hexes[sides_.at(quad)[0] / 6], sides_.at(quad)[0] % 6);
      for (std::size_t k = 0; k < 4; ++k) at_edge[sorted(Segment{round[k], round[(k + 1) % 4]})].push_back(quad);
    }
    for (bool changed = true; changed;) {
      changed = false;
      monitor_.check();
      for (const Quad& quad : unknown) {
        if (face_of_[quad] > 0) continue;
        const Quad round = side_of(padded_.mesh.hexes[sides_.at(quad)[0] / 6], sides_.at(quad)[0] % 6);
        for (std::size_t k = 0; k < 4; ++k) {
          const auto& beside = at_edge.at(sorted(Segment{round[k], round[(k + 1) % 4]}));
          if (beside.size() != 2) continue;
          const int face = face_of_[beside[0] == quad ? beside[1] : beside[0]];
          if (face == 0 || solids_at(quad) != solids_of(face)) continue;
          face_of_[quad] = face;
          changed = true;
          break;
        }
      }
    }
    return std::all_of(unknown.begin(), unknown.end(), [&](const Quad& quad) { return face_of_.at(quad) > 0; });
  }

  std::array<int, 2> solids_at(const Quad& quad) const {
    const auto& sides = sides_.at(quad);
    return sorted(std::array<int, 2>{solid_[sides[0] / 6], solid_[sides[1] / 6]});
  }

  std::array<int, 2> solids_of(int face) const {
    for (const auto& [interface, solids] : model_.interfaces)
      if (interface == face) return solids;
    return {-1, -1};
  }

  /// Nodes inside that are on interfaces, and the quads of these, as the first of their solids sees them.
  bool place_nodes() {
    all_ = padded_.association;
    const Association& a = before_.joined.whole.association;
    std::map<int, int> patch_at;
    for (const auto& [quad, face] : face_of_) {
      const int patch = patch_of_.at(face);
      for (const int n : quad) {
        if (padded_.association.point_cad[n].dim < 3) continue;
        if (n < static_cast<int>(a.point_cad.size()) && a.point_cad[n].dim < 2) {
          all_.point_cad[n] = a.point_cad[n];
        } else if (patch_at.try_emplace(n, patch).first->second == patch) {
          all_.point_cad[n] = {2, patch};
        } else {
          return false;  // on an edge between interfaces that has become longer
        }
      }
      const auto& sides = sides_.at(quad);
      const int first = solid_[sides[0] / 6] < solid_[sides[1] / 6] ? sides[0] : sides[1];
      all_.quads.push_back(side_of(padded_.mesh.hexes[first / 6], first % 6));
      all_.quad_patch.push_back(patch);
    }
    return true;
  }

  bool keep_inner_segments() {
    std::vector<Quad> between;
    for (const auto& [quad, face] : face_of_) between.push_back(side_of(padded_.mesh.hexes[sides_.at(quad)[0] / 6], sides_.at(quad)[0] % 6));
    const std::set<Segment> edges = edges_of(between);
    const Association& a = before_.joined.whole.association;
    const std::set<Segment> outer = edges_of(outside(model_, a).quads);
    for (std::size_t s = 0; s < a.segments.size(); ++s) {
      if (outer.contains(sorted(a.segments[s]))) continue;
      if (!edges.contains(sorted(a.segments[s]))) return false;
      all_.segments.push_back(a.segments[s]);
      all_.segment_edge.push_back(a.segment_edge[s]);
    }
    return true;
  }

  const ConformalModel& model_;
  const PaddedGrids& before_;
  const PaddedMesh& padded_;
  const Monitor& monitor_;
  Sides sides_;
  std::vector<int> solid_;       // per hex
  std::map<Quad, int> face_of_;  // of the quads between solids, by sorted nodes
  std::map<int, int> patch_of_;  // per interface
  Association all_;
};

}  // namespace

std::vector<PaddedGrids> pad_across(const ConformalModel& model, const PaddedGrids& grids, const Monitor& monitor) {
  const HexMesh& mesh = grids.joined.whole.mesh;
  std::vector<PaddedMesh> choices;
  try {
    choices = pad_choices(model.outer, mesh, outside(model, grids.joined.whole.association), monitor);
  } catch (const StageFailed& e) {
    monitor.log("conform: layers through several solids: " + std::string(e.what()));
  }
  std::vector<PaddedGrids> result;
  for (const PaddedMesh& choice : choices) {
    if (choice.mesh.hexes.size() == mesh.hexes.size()) continue;
    std::optional<PaddedGrids> parted = Parting(model, grids, choice, monitor).run();
    if (!parted) continue;
    const bool sound = std::all_of(parted->solids.begin(), parted->solids.end(), [](const PaddedMesh& s) { return check(s.mesh, s.association).empty(); });
    if (sound) result.push_back(std::move(*parted));
  }
  return result;
}

}  // namespace polycube
