#include "pad/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include "core/hexahedron.h"
#include "pad/tuning.h"

namespace polycube {

namespace {

constexpr double kPi = std::numbers::pi;

struct Regions {
  std::vector<int> of_quad;
  std::vector<double> own;  // cost of padding less cost of not padding, at edges inside the region
  std::vector<int> patch;   // least patch: the region's name while sheets come and go
  int size() const { return static_cast<int>(own.size()); }
};

Regions find_regions(const Association& association, const std::vector<BoundaryEdge>& edges, const std::vector<double>& angles) {
  const int quads = static_cast<int>(association.quads.size());
  std::vector<int> root(quads);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int x) {
    while (root[x] != x) x = root[x] = root[root[x]];
    return x;
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (angles[e] <= kPadTuning.widest_end || angles[e] >= kPadTuning.concave) continue;
    const int x = find(edges[e].quads[0]), y = find(edges[e].quads[1]);
    root[std::max(x, y)] = std::min(x, y);
  }
  Regions regions;
  regions.of_quad.resize(quads);
  for (int q = 0; q < quads; ++q) {
    const int r = find(q);
    if (r == q) {
      regions.of_quad[q] = regions.size();
      regions.own.push_back(0);
      regions.patch.push_back(association.quad_patch[q]);
    } else {
      regions.of_quad[q] = regions.of_quad[r];
    }
    regions.own[regions.of_quad[q]] += kPadTuning.quad_price;
    regions.patch[regions.of_quad[q]] = std::min(regions.patch[regions.of_quad[q]], association.quad_patch[q]);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int r = regions.of_quad[edges[e].quads[0]];
    if (r != regions.of_quad[edges[e].quads[1]]) continue;
    regions.own[r] += angle_cost(2, angles[e]) + angle_cost(edges[e].hexes + 2, 2 * kPi) - angle_cost(edges[e].hexes, angles[e]);
  }
  return regions;
}

// Walks round the edge (x, y) from `side` through its hex: the sides by which the hexes are left, up to the boundary or back to the start.
struct Fan {
  std::vector<int> exits;
  int quad = -1;  // boundary quad reached, -1 if the fan closes
};

Fan walk_round(const HexMesh& mesh, const HexTopology& topology, int side, int x, int y) {
  Fan fan;
  for (int at = side;;) {
    const int hex = at / 6, exit = 6 * hex + other_face(mesh.hexes[hex], at % 6, x, y);
    fan.exits.push_back(exit);
    at = topology.mate[exit];
    if (at < 0) {
      fan.quad = -1 - at;
      return fan;
    }
    if (at == side) return fan;
  }
}

// The best layer found for a region so far.
struct Choice {
  SheetCut cut;
  double gain = 0;
  int quads = 0;
};

class Chooser {
 public:
  explicit Chooser(const TrialMesh& whole)
      : whole_(whole),
        mesh_(whole.padded.mesh),
        association_(whole.padded.association),
        edges_(boundary_edges(mesh_, association_.quads, whole.topology)),
        angles_(dihedral_angles(whole.model, mesh_, association_, edges_)),
        regions_(find_regions(association_, edges_, angles_)) {
    std::vector<char> ends(mesh_.points.size(), 0);
    for (const Segment& s : association_.segments) ends[s[0]] = ends[s[1]] = 1;
    for (int v = 0; v < static_cast<int>(ends.size()); ++v) {
      const int hexes = whole.topology.node_first[v + 1] - whole.topology.node_first[v];
      if (association_.point_cad[v].dim == 0 && !ends[v] && hexes == 1) tips_.push_back(v);
    }
  }

  const Regions& regions() const { return regions_; }

  Choice choose(int region) const {
    Choice best;
    std::vector<char> alone(regions_.own.size(), 0);
    alone[region] = 1;
    consider(alone, true, best);
    consider(beyond_concave(alone), false, best);
    consider(std::vector<char>(regions_.own.size(), 1), false, best);
    return best;
  }

  // Chains of edges at fault, inside smooth regions or concave, by edge index.
  std::vector<std::vector<int>> faults() const {
    std::vector<std::vector<int>> node_edges(mesh_.points.size()), chains;
    std::vector<char> open(edges_.size(), 0);
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      if (angles_[e] <= kPadTuning.widest_end || angle_cost(edges_[e].hexes, angles_[e]) < kPadTuning.bad_edge) continue;
      open[e] = 1;
      node_edges[edges_[e].a].push_back(e);
      node_edges[edges_[e].b].push_back(e);
    }
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      if (!open[e]) continue;
      open[e] = 0;
      std::vector<int> chain{e};
      for (std::size_t i = 0; i < chain.size(); ++i) {
        for (int v : {edges_[chain[i]].a, edges_[chain[i]].b}) {
          for (int next : node_edges[v]) {
            if (open[next]) chain.push_back(next);
            open[next] = 0;
          }
        }
      }
      chains.push_back(std::move(chain));
    }
    return chains;
  }
  // The least node of a chain: its name while sheets come and go.
  int name_of(const std::vector<int>& chain) const {
    int name = edges_[chain[0]].a;
    for (int e : chain) name = std::min(name, edges_[e].a);
    return name;
  }

  Choice choose_band(const std::vector<int>& chain) const {
    Choice best;
    std::vector<int> band;
    for (int e : chain) band.insert(band.end(), edges_[e].quads.begin(), edges_[e].quads.end());
    for (int width = 1; width <= 3; ++width) {
      consider_band(band, best);
      std::vector<int> wider = band;
      for (int q : band) {
        for (int v : association_.quads[q]) {
          for (int other : whole_.node_quads[v]) {
            if (regions_.of_quad[other] == regions_.of_quad[q]) wider.push_back(other);
          }
        }
      }
      std::sort(wider.begin(), wider.end());
      wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
      band.swap(wider);
    }
    return best;
  }

  Choice choose_together(bool through) const {
    Choice best;
    std::vector<char> wanted(regions_.own.size());
    for (std::size_t r = 0; r < wanted.size(); ++r) wanted[r] = regions_.own[r] < 0;
    if (through) {
      consider(wanted, true, best);
    } else {
      consider(beyond_concave(wanted), false, best);
    }
    return best;
  }

 private:
  // Rates a layer under the chosen regions; where it cannot be opened it takes in one more region.
  void consider(std::vector<char> chosen, bool extend, Choice& best) const {
    for (int attempt = 0; attempt < regions_.size(); ++attempt) {
      std::vector<char> surface(association_.quads.size());
      for (std::size_t q = 0; q < surface.size(); ++q) surface[q] = chosen[regions_.of_quad[q]];
      SheetCut cut{std::vector<char>(mesh_.hexes.size(), 1), surface};
      if (extend && !extend_cut(mesh_, whole_.topology, edges_, angles_, surface, cut)) return;
      spare_tips(cut);
      const TrialResult result = try_sheet(whole_, cut);
      if (result.obstacles.empty()) {
        const int quads = static_cast<int>(std::count(surface.begin(), surface.end(), 1));
        const double gain = result.gain - kPadTuning.small_price * quads;
        if (gain > best.gain) best = {std::move(cut), gain, quads};
        return;
      }
      if (!take_in(result.obstacles, chosen)) return;
    }
  }

  // The one hex at the tip of a cone stays outside of the layer: three cells under it would share a corner that is too narrow for one already.
  void spare_tips(SheetCut& cut) const {
    for (int v : tips_) {
      const int hex = whole_.topology.node_hexes[whole_.topology.node_first[v]];
      const std::vector<int>& quads = whole_.node_quads[v];
      if (!std::all_of(quads.begin(), quads.end(), [&](int q) { return cut.surface[q]; })) continue;
      cut.inside[hex] = 0;
      for (int q : quads) cut.surface[q] = 0;
    }
  }

  std::vector<char> beyond_concave(std::vector<char> chosen) const {
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        const int r = regions_.of_quad[edges_[e].quads[0]], s = regions_.of_quad[edges_[e].quads[1]];
        if (angles_[e] < kPadTuning.concave || chosen[r] == chosen[s]) continue;
        chosen[r] = chosen[s] = 1;
        grown = true;
      }
    }
    return chosen;
  }

  // Rates a pillow round the hexes under the band; where it cannot be opened it takes in more of the region.
  void consider_band(std::vector<int> band, Choice& best) const {
    for (int attempt = 0; attempt < kPadTuning.band_repairs; ++attempt) {
      SheetCut cut{std::vector<char>(mesh_.hexes.size(), 0), std::vector<char>(association_.quads.size(), 0)};
      for (int q : band) cut.surface[q] = 1;
      for (int q : band) {
        const Quad& quad = association_.quads[q];
        const int side = whole_.topology.quad_side[q];
        cut.inside[side / 6] = 1;
        for (int k = 0; k < 4; ++k) {
          const Fan fan = walk_round(mesh_, whole_.topology, side, quad[k], quad[(k + 1) % 4]);
          if (!cut.surface[fan.quad]) continue;
          for (int exit : fan.exits) cut.inside[exit / 6] = 1;
        }
      }
      spare_tips(cut);
      const TrialResult result = try_sheet(whole_, cut);
      if (result.obstacles.empty()) {
        const int quads = static_cast<int>(std::count(cut.surface.begin(), cut.surface.end(), 1));
        const double gain = result.gain - kPadTuning.small_price * quads;
        if (gain > best.gain) best = {std::move(cut), gain, quads};
        return;
      }
      const std::size_t before = band.size();
      const int region = regions_.of_quad[band[0]];
      for (int v : result.obstacles) {
        for (int q : whole_.node_quads[v]) {
          if (regions_.of_quad[q] == region && !cut.surface[q]) {
            band.push_back(q);
            cut.surface[q] = 1;
          }
        }
      }
      if (band.size() == before) return;
    }
  }

  bool take_in(const std::vector<int>& nodes, std::vector<char>& chosen) const {
    bool grown = false;
    for (int v : nodes) {
      int cheapest = -1;
      for (int q : whole_.node_quads[v]) {
        const int r = regions_.of_quad[q];
        if (!chosen[r] && (cheapest < 0 || regions_.own[r] < regions_.own[cheapest])) cheapest = r;
      }
      if (cheapest < 0) continue;
      chosen[cheapest] = 1;
      grown = true;
    }
    return grown;
  }

  const TrialMesh& whole_;
  const HexMesh& mesh_;
  const Association& association_;
  std::vector<BoundaryEdge> edges_;
  std::vector<double> angles_;
  Regions regions_;
  std::vector<int> tips_;  // nodes of CAD vertices without CAD edges, with one hex there
};

}  // namespace

bool extend_cut(const HexMesh& mesh, const HexTopology& topology, const std::vector<BoundaryEdge>& edges, const std::vector<double>& angles,
                const std::vector<char>& region, SheetCut& cut) {
  constexpr char kOutside = 0, kInside = 1, kUnknown = 2;
  std::vector<char> inner(topology.mate.size(), 0);  // per side: a face of the cut seen from inside
  std::vector<int> queue;
  const auto add = [&](int side) {
    if (inner[side]) return;
    inner[side] = 1;
    queue.push_back(side);
  };
  const auto is_cut = [&](int side) { return inner[side] || (topology.mate[side] >= 0 && inner[topology.mate[side]]); };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [first, second] = edges[e].quads;
    if (angles[e] < kPadTuning.concave || region[first] == region[second] || edges[e].hexes < 2) continue;
    const Fan fan = walk_round(mesh, topology, topology.quad_side[region[first] ? first : second], edges[e].a, edges[e].b);
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int j = 1; j < edges[e].hexes; ++j) {
      const double cost = angle_cost(edges[e].hexes - j + 2, angles[e]) + angle_cost(j + 2, 2 * kPi);
      if (cost >= least) continue;
      least = cost;
      best = j;
    }
    add(fan.exits[best - 1]);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const int side = queue[i];
    for (int k = 0; k < 4; ++k) {
      const Hex& hex = mesh.hexes[side / 6];
      const auto& corners = kHexFaces[side % 6];
      const int x = hex[corners[k]], y = hex[corners[(k + 1) % 4]];
      const Fan fan = walk_round(mesh, topology, side, x, y);
      if (fan.quad >= 0) {
        // The cut ends at the boundary, or meets the region there from inside.
        const Fan behind = walk_round(mesh, topology, topology.mate[side], x, y);
        if (region[behind.quad]) return false;
        continue;
      }
      const int count = static_cast<int>(fan.exits.size());
      if (std::any_of(fan.exits.begin(), fan.exits.end() - 1, is_cut)) continue;
      add(fan.exits[count / 2 - 1]);
    }
  }
  // Hexes on the inner side, by flooding from both sides of the cut.
  cut.inside.assign(mesh.hexes.size(), kUnknown);
  cut.surface = region;
  std::vector<int> front;
  const auto mark = [&](int hex, char what) {
    if (cut.inside[hex] == kUnknown) {
      cut.inside[hex] = what;
      front.push_back(hex);
    }
    return cut.inside[hex] == what;
  };
  for (std::size_t q = 0; q < region.size(); ++q) {
    if (region[q] && !mark(topology.quad_side[q] / 6, kInside)) return false;
  }
  for (int side : queue) {
    if (!mark(side / 6, kInside) || !mark(topology.mate[side] / 6, kOutside)) return false;
  }
  for (std::size_t i = 0; i < front.size(); ++i) {
    for (int f = 0; f < 6; ++f) {
      const int side = 6 * front[i] + f;
      if (topology.mate[side] >= 0 && !is_cut(side) && !mark(topology.mate[side] / 6, cut.inside[front[i]])) return false;
    }
  }
  return true;
}

LayerCount insert_surface_layers(const CadModel& model, PaddedMesh& padded, LayerPlan plan, const Monitor& monitor) {
  LayerCount count;
  const auto insert = [&](const Choice& best) {
    if (best.quads == 0) return false;
    insert_sheet(padded.mesh, padded.association, best.cut);
    count.quads += best.quads;
    count.gain += best.gain;
    return true;
  };
  std::set<int> tried_chains;
  for (bool again = plan == LayerPlan::kBands; again;) {
    again = false;
    const TrialMesh whole(model, padded);
    const Chooser chooser(whole);
    for (const auto& chain : chooser.faults()) {
      if (again || !tried_chains.insert(chooser.name_of(chain)).second) continue;
      monitor.check();
      again = insert(chooser.choose_band(chain));
    }
  }
  if (plan == LayerPlan::kTogether || plan == LayerPlan::kTogetherThrough) {
    const TrialMesh whole(model, padded);
    insert(Chooser(whole).choose_together(plan == LayerPlan::kTogetherThrough));
  }
  std::set<int> tried;  // regions by their name: one layer is enough for each
  for (bool again = true; again;) {
    again = false;
    const TrialMesh whole(model, padded);
    const Chooser chooser(whole);
    if (tried.empty()) {
      count.regions = static_cast<int>(std::count_if(chooser.regions().own.begin(), chooser.regions().own.end(), [](double cost) { return cost < 0; }));
    }
    for (int r = 0; r < chooser.regions().size() && !again; ++r) {
      if (chooser.regions().own[r] >= 0 || !tried.insert(chooser.regions().patch[r]).second) continue;
      monitor.check();
      again = insert(chooser.choose(r));
    }
  }
  return count;
}

bool insert_layer_under(const CadModel& model, PaddedMesh& padded, const std::vector<char>& region) {
  const TrialMesh whole(model, padded);
  const auto edges = boundary_edges(padded.mesh, padded.association.quads, whole.topology);
  const auto angles = dihedral_angles(model, padded.mesh, padded.association, edges);
  SheetCut cut{std::vector<char>(padded.mesh.hexes.size(), 1), region};
  if (!extend_cut(padded.mesh, whole.topology, edges, angles, region, cut)) return false;
  const TrialResult result = try_sheet(whole, cut);
  if (!result.obstacles.empty() || result.gain + kPadTuning.hex_price * result.added < -kPadTuning.flat) return false;
  insert_sheet(padded.mesh, padded.association, cut, whole.topology);
  return true;
}

}  // namespace polycube
