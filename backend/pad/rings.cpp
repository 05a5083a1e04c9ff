#include "pad/rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "pad/trial.h"
#include "pad/tuning.h"

namespace polycube {

namespace {

constexpr double kPi = std::numbers::pi;

// A part of a patch's border: nodes in order with the patch on the left, and whether the last leads to the first.
struct Stretch {
  std::vector<int> nodes;
  bool closed = false;
  std::vector<char> bad;  // per node
};

struct Candidate {
  std::set<int> inside;   // hexes
  std::set<int> surface;  // quads
  double gain = 0;
};

// The hexes round the mesh edge x-y of a boundary quad, and the quad on their other side.
struct Wedge {
  std::vector<int> hexes;
  int far_quad = -1;
};

Wedge wedge_at(const TrialMesh& whole, int quad, int x, int y) {
  Wedge wedge;
  int side = whole.topology.quad_side[quad];
  while (side >= 0) {
    wedge.hexes.push_back(side / 6);
    side = whole.topology.mate[6 * (side / 6) + other_face(whole.padded.mesh.hexes[side / 6], side % 6, x, y)];
  }
  wedge.far_quad = -1 - side;
  return wedge;
}

// The sheet round a stretch through the hexes under `band`, quads of the patch.
Candidate make_candidate(const TrialMesh& whole, int patch, const Stretch& stretch, const std::vector<int>& band) {
  const Association& a = whole.padded.association;
  Candidate candidate;
  const std::set<int> in_band(band.begin(), band.end());
  for (int q : band) {
    candidate.inside.insert(whole.topology.quad_side[q] / 6);
    // Round an edge between two quads of the band the hexes between theirs come along.
    for (int k = 0; k < 4; ++k) {
      const Wedge between = wedge_at(whole, q, a.quads[q][k], a.quads[q][(k + 1) % 4]);
      if (in_band.count(between.far_quad) > 0) candidate.inside.insert(between.hexes.begin(), between.hexes.end());
    }
  }
  // Where a wedge at the stretch is inside as a whole, the sheet runs between it and the quad on the wedge's other side.
  const int count = static_cast<int>(stretch.nodes.size());
  for (int i = 0; i + (stretch.closed ? 0 : 1) < count; ++i) {
    const int x = stretch.nodes[i], y = stretch.nodes[(i + 1) % count];
    for (int q : whole.node_quads[x]) {
      if (a.quad_patch[q] != patch || in_band.count(q) == 0) continue;
      const Quad& quad = a.quads[q];
      const auto at = std::find(quad.begin(), quad.end(), x) - quad.begin();
      if (quad[(at + 1) % 4] != y) continue;
      const Wedge wedge = wedge_at(whole, q, x, y);
      if (std::all_of(wedge.hexes.begin(), wedge.hexes.end(), [&](int h) { return candidate.inside.count(h) > 0; })) candidate.surface.insert(wedge.far_quad);
    }
  }
  return candidate;
}

// Takes in the hexes round the other CAD edge of a cusp that the stretch ends at: the sheet comes out on the far side of that edge, and the cusp keeps its
// one quad. False if nothing was added.
bool take_cusps(const TrialMesh& whole, const std::vector<Sector>& sectors, int patch, const Stretch& stretch, Candidate& candidate) {
  const std::size_t count = stretch.nodes.size(), before = candidate.inside.size();
  if (stretch.closed || count < 2) return false;
  for (const auto& [end, beside] : {std::array{stretch.nodes[0], stretch.nodes[1]}, std::array{stretch.nodes[count - 1], stretch.nodes[count - 2]}}) {
    auto at = std::lower_bound(sectors.begin(), sectors.end(), end, [](const Sector& s, int node) { return s.node < node; });
    for (; at != sectors.end() && at->node == end; ++at) {
      if (at->patch != patch || at->quads != 1 || at->angle >= kPadTuning.one_cell || (at->first != beside && at->last != beside)) continue;
      const int other = at->first == beside ? at->last : at->first;
      for (int q : whole.node_quads[end]) {
        const Quad& quad = whole.padded.association.quads[q];
        const auto has = [&](int node) { return std::find(quad.begin(), quad.end(), node) != quad.end(); };
        if (whole.padded.association.quad_patch[q] != patch || !has(beside) || !has(other)) continue;
        const Wedge wedge = wedge_at(whole, q, end, other);
        candidate.inside.insert(wedge.hexes.begin(), wedge.hexes.end());
      }
    }
  }
  return candidate.inside.size() > before;
}

SheetCut as_cut(const TrialMesh& whole, const Candidate& candidate) {
  SheetCut cut{std::vector<char>(whole.padded.mesh.hexes.size(), 0), std::vector<char>(whole.padded.association.quads.size(), 0)};
  for (int h : candidate.inside) cut.inside[h] = 1;
  for (int q : candidate.surface) cut.surface[q] = 1;
  return cut;
}

// Fills in the gain; false if the sheet cannot be opened. Takes in more hexes of the patch where that makes it possible.
bool rate(const TrialMesh& whole, int patch, Candidate& candidate) {
  for (int attempt = 0; attempt < kPadTuning.sheet_repairs; ++attempt) {
    const TrialResult result = try_sheet(whole, as_cut(whole, candidate));
    if (result.obstacles.empty()) {
      candidate.gain = result.gain;
      return true;
    }
    const std::size_t before = candidate.inside.size();
    for (int v : result.obstacles) {
      for (int q : whole.node_quads[v]) {
        if (whole.padded.association.quad_patch[q] == patch) candidate.inside.insert(whole.topology.quad_side[q] / 6);
      }
    }
    if (candidate.inside.size() == before) return false;
  }
  return false;
}

class Border {
 public:
  explicit Border(const std::vector<Sector>& sectors) : sectors_(sectors) {
    for (int i = 0; i < static_cast<int>(sectors.size()); ++i) {
      if (sectors[i].first < 0) continue;
      by_next_.push_back({sectors[i].patch, sectors[i].node, sectors[i].first, i});
      by_previous_.push_back({sectors[i].patch, sectors[i].node, sectors[i].last, i});
    }
    std::sort(by_next_.begin(), by_next_.end());
    std::sort(by_previous_.begin(), by_previous_.end());
  }

  // From a sector along the border, forward or backward, up to and with the first corner; true if it comes back to the start.
  bool walk(int start, bool forward, std::vector<int>& found) const {
    for (int at = start;;) {
      const Sector& s = sectors_[at];
      const int to = forward ? s.first : s.last;
      const auto& index = forward ? by_previous_ : by_next_;
      const auto it = std::lower_bound(index.begin(), index.end(), std::array{s.patch, to, s.node, -1});
      if (it == index.end() || (*it)[0] != s.patch || (*it)[1] != to || (*it)[2] != s.node) return false;
      at = (*it)[3];
      if (at == start) return true;
      found.push_back(at);
      if (is_corner(at)) return false;
    }
  }
  bool is_corner(int i) const { return std::abs(sectors_[i].angle - kPi) > kPadTuning.straight; }

  // The stretches a sheet for this sector can follow.
  std::vector<Stretch> stretches(int start) const {
    std::vector<int> forward, backward;
    if (walk(start, true, forward)) {
      forward.insert(forward.begin(), start);
      return {as_stretch(forward, true)};
    }
    walk(start, false, backward);
    std::vector<int> both(backward.rbegin(), backward.rend());
    both.push_back(start);
    std::vector<Stretch> found;
    if (is_corner(start)) {
      found.push_back(as_stretch(both, false));
      forward.insert(forward.begin(), start);
      found.push_back(as_stretch(forward, false));
      both.insert(both.end(), forward.begin() + 1, forward.end());
    } else {
      both.insert(both.end(), forward.begin(), forward.end());
    }
    found.push_back(as_stretch(both, false));
    return found;
  }

 private:
  Stretch as_stretch(const std::vector<int>& list, bool closed) const {
    Stretch stretch;
    stretch.closed = closed;
    for (int i : list) {
      stretch.nodes.push_back(sectors_[i].node);
      stretch.bad.push_back(angle_cost(sectors_[i].quads, sectors_[i].angle) >= kPadTuning.bad_sector);
    }
    return stretch;
  }

  const std::vector<Sector>& sectors_;
  std::vector<std::array<int, 4>> by_next_, by_previous_;  // patch, node, neighbour, sector
};

// A stretch cut down to its bad nodes and two more on each side.
Stretch trimmed(const Stretch& stretch) {
  if (stretch.closed) return stretch;
  const int count = static_cast<int>(stretch.nodes.size());
  int first = count, last = -1;
  for (int i = 0; i < count; ++i) {
    if (!stretch.bad[i]) continue;
    first = std::min(first, i);
    last = i;
  }
  first = std::max(0, first - 2);
  last = std::min(count - 1, last + 2);
  return {{stretch.nodes.begin() + first, stretch.nodes.begin() + last + 1}, false, {stretch.bad.begin() + first, stretch.bad.begin() + last + 1}};
}

// A stretch cut down to `reach` nodes on both sides of one.
Stretch window(const Stretch& stretch, int node, int reach) {
  const int count = static_cast<int>(stretch.nodes.size());
  const int at = static_cast<int>(std::find(stretch.nodes.begin(), stretch.nodes.end(), node) - stretch.nodes.begin());
  Stretch part;
  for (int i = at - reach; i <= at + reach; ++i) {
    if (!stretch.closed && (i < 0 || i >= count)) continue;
    const int k = (i + count) % count;
    part.nodes.push_back(stretch.nodes[k]);
    part.bad.push_back(stretch.bad[k]);
  }
  return part;
}

// Quads of the patch along a stretch.
std::vector<int> band_of(const TrialMesh& whole, int patch, const Stretch& stretch) {
  std::vector<int> band;
  const std::size_t skip = stretch.closed ? 0 : 1;  // quads that only touch an end stay out
  for (std::size_t i = skip; i + skip < stretch.nodes.size(); ++i) {
    for (int q : whole.node_quads[stretch.nodes[i]]) {
      if (whole.padded.association.quad_patch[q] == patch) band.push_back(q);
    }
  }
  std::sort(band.begin(), band.end());
  band.erase(std::unique(band.begin(), band.end()), band.end());
  return band;
}

// One quad in a straight angle. The chords of curved edges leave it less: such a quad is poor, not lost.
bool is_lost(const TrialMesh& whole, const Sector& sector) {
  const HexMesh& mesh = whole.padded.mesh;
  const Association& association = whole.padded.association;
  const CadRef& at = association.point_cad[sector.node];
  if (sector.quads > 1 || sector.angle < kPadTuning.straight_angle) return false;
  if (at.dim != 1) return true;
  const auto tangent = [&](int node) { return whole.model.edge_tangent(at.id, whole.model.project_to_edge(at.id, mesh.points[node]).t); };
  return tangent(sector.first).dot(tangent(sector.last)) > std::cos(kPadTuning.straight);
}

// The best sheet for a bad sector; no hexes if none gains.
Candidate best_sheet(const TrialMesh& whole, const Border& border, const std::vector<Sector>& sectors, int bad, RingWay way) {
  const int patch = sectors[bad].patch;
  std::vector<int> all;
  for (int q = 0; q < static_cast<int>(whole.padded.association.quads.size()); ++q) {
    if (whole.padded.association.quad_patch[q] == patch) all.push_back(q);
  }
  Candidate best;
  best.gain = kPadTuning.least_gain;
  const auto consider = [&](const Stretch& stretch, const std::vector<int>& band, double handicap = 0) {
    if (band.empty()) return;
    Candidate candidate = make_candidate(whole, patch, stretch, band);
    if (way == RingWay::kThroughCusps) {
      Candidate wider = candidate;
      if (take_cusps(whole, sectors, patch, stretch, wider) && rate(whole, patch, wider) && wider.gain > best.gain + handicap) best = std::move(wider);
    }
    if (rate(whole, patch, candidate) && candidate.gain > best.gain + handicap) best = std::move(candidate);
  };
  for (const Stretch& stretch : border.stretches(bad)) {
    const auto band = band_of(whole, patch, stretch);
    consider(stretch, band);
    if (all.size() <= 4 * band.size()) consider(stretch, all);
    const Stretch shorter = trimmed(stretch);
    if (shorter.nodes.size() < stretch.nodes.size()) consider(shorter, band_of(whole, patch, shorter));
    for (int reach = 2; reach <= kPadTuning.sheet_reach; ++reach) {
      if (2 * reach + 1 >= static_cast<int>(stretch.nodes.size())) break;
      const Stretch part = window(stretch, sectors[bad].node, reach);
      consider(part, band_of(whole, patch, part));
    }
  }
  // Round one node alone, where longer sheets leave a cell flat: they take cells from a corner that is two cells away.
  if (!is_lost(whole, sectors[bad])) return best;
  for (const Stretch& stretch : border.stretches(bad)) {
    if (stretch.nodes.size() < 4) continue;
    const Stretch part = window(stretch, sectors[bad].node, 1);
    consider(part, band_of(whole, patch, part), kPadTuning.flat);
  }
  return best;
}

}  // namespace

RingCount insert_rings(const CadModel& model, PaddedMesh& padded, RingWay way, const Monitor& monitor) {
  std::set<std::array<int, 2>> given_up;  // node, patch
  RingCount count;
  for (bool again = true; again && count.sheets < kPadTuning.max_sheets;) {
    again = false;
    std::vector<char> on_edge(padded.mesh.points.size(), 0);
    for (std::size_t v = 0; v < on_edge.size(); ++v) on_edge[v] = padded.association.point_cad[v].dim <= 1;
    const auto sectors = find_sectors(model, padded.mesh, padded.association, on_edge);
    count.flat =
        std::any_of(sectors.begin(), sectors.end(), [](const Sector& s) { return s.first >= 0 && s.quads == 1 && s.angle >= kPadTuning.straight_angle; });
    count.cusps = std::any_of(sectors.begin(), sectors.end(), [](const Sector& s) { return s.first >= 0 && s.angle < kPadTuning.one_cell; });
    std::vector<int> bad;
    for (int i = 0; i < static_cast<int>(sectors.size()); ++i) {
      if (sectors[i].first >= 0 && angle_cost(sectors[i].quads, sectors[i].angle) >= kPadTuning.bad_sector &&
          given_up.count({sectors[i].node, sectors[i].patch}) == 0) {
        bad.push_back(i);
      }
    }
    if (bad.empty()) break;
    const TrialMesh whole(model, padded);
    const Border border(sectors);
    for (int i : bad) {
      monitor.check();
      const Candidate best = best_sheet(whole, border, sectors, i, way);
      if (best.inside.empty()) {
        given_up.insert({sectors[i].node, sectors[i].patch});
        continue;
      }
      const SheetCut cut = as_cut(whole, best);
      insert_sheet(padded.mesh, padded.association, cut, whole.topology);
      ++count.sheets;
      count.gain += best.gain;
      again = true;
      break;
    }
  }
  return count;
}

}  // namespace polycube
