#include "fem/curve.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/parallel.h"
#include "core/union_find.h"
#include "fem/element.h"
#include "fem/tuning.h"

namespace polycube {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint64_t edge_key(int a, int b) { return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b)); }

/// The mesh's edges, ascending by key.
class EdgeList {
 public:
  explicit EdgeList(const std::vector<Hex20>& hexes) {
    keys_.reserve(hexes.size() * 12);
    for (const Hex20& hex : hexes)
      for (const auto& e : kHexEdges) keys_.push_back(edge_key(hex[e[0]], hex[e[1]]));
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }
  int size() const { return static_cast<int>(keys_.size()); }
  int find(int a, int b) const {
    const auto it = std::lower_bound(keys_.begin(), keys_.end(), edge_key(a, b));
    if (it == keys_.end() || *it != edge_key(a, b)) throw StageFailed("fem", "a boundary edge belongs to no cell");
    return static_cast<int>(it - keys_.begin());
  }
  std::array<int, 2> ends(int i) const { return {static_cast<int>(keys_[i] >> 32), static_cast<int>(keys_[i] & 0xffffffffu)}; }

 private:
  std::vector<std::uint64_t> keys_;
};

/// Where a mid-edge node may move: along a CAD edge, over a CAD face, or freely (dimension 3).
struct Support {
  CadRef entity{3, 1};
  Vec2 at = Vec2::Zero();  ///< (t, 0) or (u, v)
  bool fixed = false;
};

/// Cells that are worked on together, since one node touches several of them.
struct Group {
  double before = kInfinity, after = kInfinity;  // least share
  double margin = kInfinity;                     // least of its cells
};

class Curving {
 public:
  Curving(const CadModel& model, FemMesh& mesh, const FemOptions& options, const Monitor& monitor)
      : model_(model),
        mesh_(mesh),
        monitor_(monitor),
        threads_(thread_count(options.threads)),
        base_(mesh.corner_count),
        edges_(mesh.hexes),
        supports_(edges_.size()) {}

  void run() {
    number();
    place();
    find_shares();
    do {
      raise();
    } while (straighten());
  }

 private:
  struct Use {
    int hex, node;  // the edge's mid node is that of the hex's nodes, 8 to 19
  };
  struct Uses {
    const Use *first, *last;
    const Use* begin() const { return first; }
    const Use* end() const { return last; }
  };

  Uses uses(int e) const { return {uses_.data() + first_use_[e], uses_.data() + first_use_[e + 1]}; }
  Vec3& node(int e) { return mesh_.points[base_ + e]; }
  const Vec3& node(int e) const { return mesh_.points[base_ + e]; }
  Vec3 middle(int e) const {
    const auto [a, b] = edges_.ends(e);
    return (mesh_.points[a] + mesh_.points[b]) / 2;
  }
  double length(int e) const {
    const auto [a, b] = edges_.ends(e);
    return (mesh_.points[a] - mesh_.points[b]).norm();
  }
  HexPlaces places(int h) const { return curved_places(mesh_.points, mesh_.hexes[h]); }

  void number();
  void place();
  void find_shares();
  const Determinants& straight(int h);
  double share(int h) { return share(determinants(places(h)), straight(h)); }
  static double share(const Determinants& curved, const Determinants& straight);
  Vec3 moved(int e, const Vec3& step, Support& support) const;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> tangents(int e) const;
  void improve(int e, double barrier);
  void sweep(const std::vector<int>& active);
  void raise();
  bool straighten();

  const CadModel& model_;
  FemMesh& mesh_;
  const Monitor& monitor_;
  int threads_;
  int base_;
  EdgeList edges_;
  std::vector<Support> supports_;  // of each edge
  std::vector<int> first_use_;     // of each edge: CSR over uses_
  std::vector<Use> uses_;
  std::vector<Vec3> home_;              // of each edge: where its node is without moves
  std::vector<double> shares_;          // of each cell
  std::vector<double> margins_;         // of each cell: how far below the least share the barrier stands, of the way up from there to 1
  std::vector<int> straight_slot_;      // of each cell: its place in straight_, -1
  std::vector<Determinants> straight_;  // with straight edges
};

/// Gives every edge its node and the CAD entity that it stands on.
void Curving::number() {
  first_use_.assign(edges_.size() + 1, 0);
  for (Hex20& hex : mesh_.hexes)
    for (int k = 0; k < 12; ++k) {
      const int e = edges_.find(hex[kHexEdges[k][0]], hex[kHexEdges[k][1]]);
      hex[8 + k] = base_ + e;
      ++first_use_[e + 1];
    }
  for (int e = 0; e < edges_.size(); ++e) first_use_[e + 1] += first_use_[e];
  uses_.resize(first_use_.back());
  std::vector<int> next(first_use_.begin(), first_use_.end() - 1);
  for (int h = 0; h < std::ssize(mesh_.hexes); ++h)
    for (int k = 8; k < 20; ++k) uses_[next[mesh_.hexes[h][k] - base_]++] = {h, k};
  for (std::size_t s = 0; s < mesh_.segments.size(); ++s) {
    const int e = edges_.find(mesh_.segments[s][0], mesh_.segments[s][1]);
    mesh_.segments[s][2] = base_ + e;
    supports_[e].entity = {1, mesh_.segment_edge[s]};
  }
}

/// Nodes at the nearest points of the CAD to the middles of their edges.
void Curving::place() {
  std::vector<std::array<int, 2>> faces(edges_.size(), {0, 0});
  for (std::size_t q = 0; q < mesh_.quads.size(); ++q)
    for (int k = 0; k < 4; ++k) {
      const int e = edges_.find(mesh_.quads[q][k], mesh_.quads[q][(k + 1) % 4]);
      mesh_.quads[q][4 + k] = base_ + e;
      faces[e][faces[e][0] == 0 ? 0 : 1] = mesh_.quad_face[q];
    }
  mesh_.points.resize(base_ + edges_.size());
  constexpr int kChunk = 64;
  for_chunks(edges_.size(), kChunk, threads_, [&](int, int first, int last) {
    monitor_.check();
    for (int e = first; e < last; ++e) {
      Vec3& point = node(e) = middle(e);
      Support& support = supports_[e];
      if (support.entity.dim == 1) {
        const EdgePoint foot = model_.project_to_edge(support.entity.id, point);
        point = foot.point;
        support.at = Vec2(foot.t, 0);
      } else if (faces[e][0] != 0) {
        FacePoint best = model_.project_to_face(faces[e][0], point);
        support.entity = {2, faces[e][0]};
        if (faces[e][1] != 0 && faces[e][1] != faces[e][0]) {
          // Two faces of one patch meet here without a chain of mesh edges between them.
          const FacePoint other = model_.project_to_face(faces[e][1], point);
          if (other.distance < best.distance) {
            best = other;
            support.entity = {2, faces[e][1]};
          }
        }
        point = best.point;
        support.at = best.uv;
      }
    }
  });
  home_.assign(mesh_.points.begin() + base_, mesh_.points.end());
}

double Curving::share(const Determinants& curved, const Determinants& straight) {
  double least = kInfinity;
  for (int p = 0; p < kPoints; ++p)
    if (straight[p] > 0) least = std::min(least, curved[p] / straight[p]);
  return least;
}

void Curving::find_shares() {
  const auto count = static_cast<int>(mesh_.hexes.size());
  shares_.assign(mesh_.hexes.size(), 1);
  straight_slot_.assign(mesh_.hexes.size(), -1);
  constexpr int kChunk = 256;
  for_chunks(count, kChunk, threads_, [&](int, int first, int last) {
    monitor_.check();
    for (int h = first; h < last; ++h) {
      const HexPlaces curved = places(h), flat = straight_places(mesh_.points, mesh_.hexes[h]);
      if (curved != flat) shares_[h] = share(determinants(curved), determinants(flat));
    }
  });
}

/// The determinants of a cell with straight edges, those of the few cells that are asked for kept.
const Determinants& Curving::straight(int h) {
  if (straight_slot_[h] < 0) {
    straight_slot_[h] = static_cast<int>(straight_.size());
    straight_.push_back(determinants(straight_places(mesh_.points, mesh_.hexes[h])));
  }
  return straight_[straight_slot_[h]];
}

/// Where a step leads that is bent onto the node's support.
Vec3 Curving::moved(int e, const Vec3& step, Support& support) const {
  Vec3 to = node(e) + step;
  support = supports_[e];
  if (support.entity.dim == 1) {
    const EdgePoint foot = model_.project_to_edge(support.entity.id, to, &supports_[e].at[0]);
    support.at[0] = foot.t;
    return foot.point;
  }
  if (support.entity.dim == 2) {
    const FacePoint foot = model_.project_to_face(support.entity.id, to, &supports_[e].at);
    support.at = foot.uv;
    return foot.point;
  }
  return to;
}

/// Orthonormal columns: the directions in which a node may move.
Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> Curving::tangents(int e) const {
  const Support& support = supports_[e];
  if (support.entity.dim == 1) return model_.edge_tangent(support.entity.id, support.at[0]);
  if (support.entity.dim == 3) return Mat3::Identity();
  const Vec3 normal = model_.face_normal(support.entity.id, support.at);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = normal.unitOrthogonal();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

/// One node to the least of the sum of -log(share - barrier) over its cells' points, bent so that a point is best at a share of 1. The sum
/// is convex, since determinants are linear in the place of one node: Newton. A pull as weak as one point's holds the node at home.
void Curving::improve(int e, double barrier) {
  struct Row {
    double share;
    Vec3 slope;
  };
  if (supports_[e].fixed) return;
  std::vector<Row> rows;
  for (const auto& [h, k] : uses(e)) {
    DeterminantSlopes slopes;
    const Determinants now = determinants(places(h), k, slopes);
    const Determinants& flat = straight(h);
    for (int p = 0; p < kPoints; ++p)
      if (flat[p] > 0) rows.push_back({now[p] / flat[p], slopes.col(p) / flat[p]});
  }
  const double size = length(e), pull = 1 / (size * size), bend = 1 / (1 - barrier);
  const auto energy = [&](const Vec3& step) {
    double sum = pull / 2 * (node(e) + step - home_[e]).squaredNorm();
    for (const Row& row : rows) {
      const double room = row.share + row.slope.dot(step) - barrier;
      if (!(room > 0)) return kInfinity;
      sum += bend * room - std::log(room);
    }
    return sum;
  };
  for (int step = 0; step < kFemTuning.steps; ++step) {
    Vec3 gradient = pull * (node(e) - home_[e]);
    Mat3 hessian = pull * Mat3::Identity();
    for (const Row& row : rows) {
      const double room = row.share - barrier;
      gradient += row.slope * (bend - 1 / room);
      hessian += row.slope * row.slope.transpose() / (room * room);
    }
    const auto basis = tangents(e);
    Vec3 move = -basis * (basis.transpose() * hessian * basis).ldlt().solve(basis.transpose() * gradient);
    const double far = move.norm();
    if (!(far > kFemTuning.shortest * size)) return;
    if (far > kFemTuning.longest * size) move *= kFemTuning.longest * size / far;
    const double before = energy(Vec3::Zero());
    bool fell = false;
    for (int half = 0; half < kFemTuning.halves && !fell; ++half, move /= 2) {
      Support support;
      const Vec3 to = moved(e, move, support), made = to - node(e);
      if (!(energy(made) < before)) continue;
      fell = true;
      for (Row& row : rows) row.share += row.slope.dot(made);
      node(e) = to;
      supports_[e] = support;
    }
    if (!fell) return;
  }
}

/// A few rounds over the active nodes with one barrier a group of cells, taken back where the group's least share fell. A group that gains
/// nothing gets its barrier nearer, which leaves the worst points more weight.
void Curving::sweep(const std::vector<int>& active) {
  UnionFind joined(mesh_.hexes.size());
  std::vector<int> cells;
  for (int e : active)
    for (const auto& [h, k] : uses(e)) {
      joined.unite(uses(e).first->hex, h);
      cells.push_back(h);
    }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<int> slots(mesh_.hexes.size(), -1);
  std::vector<Group> groups;
  const auto group_of = [&](int h) -> Group& { return groups[slots[joined.find(h)]]; };
  for (int h : cells) {
    int& slot = slots[joined.find(h)];
    if (slot < 0) {
      slot = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    Group& group = groups[slot];
    group.before = std::min(group.before, shares_[h]);
    group.margin = std::min(group.margin, margins_[h]);
  }
  std::vector<std::pair<Vec3, Support>> start;
  start.reserve(active.size());
  for (int e : active) start.emplace_back(node(e), supports_[e]);
  for (int round = 0; round < kFemTuning.sweeps; ++round)
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (i % 256 == 0) monitor_.check();
      const Group& group = group_of(uses(active[i]).first->hex);
      improve(active[i], group.before - group.margin * (1 - group.before));
    }
  for (int h : cells) group_of(h).after = std::min(group_of(h).after, share(h));
  for (std::size_t i = 0; i < active.size(); ++i) {
    const Group& group = group_of(uses(active[i]).first->hex);
    if (group.after < group.before) std::tie(node(active[i]), supports_[active[i]]) = start[i];
  }
  for (int h : cells) {
    const Group& group = group_of(h);
    shares_[h] = share(h);
    margins_[h] = group.after < group.before + kFemTuning.gain * (1 - group.before) ? group.margin / 2 : group.margin;
  }
}

/// Moves the mid-edge nodes of cells whose share is less than wanted, until it is not or no move helps.
void Curving::raise() {
  margins_.assign(mesh_.hexes.size(), kFemTuning.margin);
  for (int round = 0; round < kFemTuning.rounds; ++round) {
    std::vector<int> active;
    for (int h = 0; h < std::ssize(mesh_.hexes); ++h)
      if (shares_[h] < kFemTuning.wanted && margins_[h] >= kFemTuning.least_margin)
        for (int k = 8; k < 20; ++k) active.push_back(mesh_.hexes[h][k] - base_);
    if (active.empty()) return;
    std::sort(active.begin(), active.end());
    active.erase(std::unique(active.begin(), active.end()), active.end());
    sweep(active);
  }
}

/// Takes the most curved edge of every cell that is still spoilt off the CAD, straight and free to move; where there is none on the CAD,
/// holds the most curved one straight. False if no cell is spoilt.
bool Curving::straighten() {
  std::vector<int> found;
  for (int h = 0; h < std::ssize(mesh_.hexes); ++h) {
    if (shares_[h] > kFemTuning.accepted) continue;
    int worst = -1;
    std::pair<bool, double> most{false, 0};
    for (int k = 8; k < 20; ++k) {
      const int e = mesh_.hexes[h][k] - base_;
      const std::pair<bool, double> bow{supports_[e].entity.dim < 3, (node(e) - middle(e)).norm() / length(e)};
      if (supports_[e].fixed || !(bow.second > 0) || bow <= most) continue;
      most = bow;
      worst = e;
    }
    if (worst >= 0) found.push_back(worst);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (int e : found) {
    Support& support = supports_[e];
    node(e) = home_[e] = middle(e);
    if (support.entity.dim < 3) {
      mesh_.straight_nodes.push_back(base_ + e);
      support.entity = {3, 1};
    } else {
      support.fixed = true;
    }
  }
  for (int e : found)
    for (const auto& [h, k] : uses(e)) shares_[h] = share(h);
  return !found.empty();
}

}  // namespace

void add_mid_nodes(const CadModel& model, FemMesh& mesh, const FemOptions& options, const Monitor& monitor) {
  Curving(model, mesh, options, monitor).run();
  std::sort(mesh.straight_nodes.begin(), mesh.straight_nodes.end());
}

}  // namespace polycube
