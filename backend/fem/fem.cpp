#include "fem/fem.h"

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <thread>

#include "core/error.h"
#include "core/hexahedron.h"

namespace polycube {
namespace {

constexpr int kPoints = 8 + 27;
/// Curving may take a cell's least Jacobian down to this share of what it is with straight edges.
constexpr double kCurvedShare = 0.1;

using Gradients = std::array<std::array<Vec3, 20>, kPoints>;
using Hex20 = std::array<int, 20>;

/// Abaqus' face number (0 = S1) of each face of core/hexahedron.h.
constexpr std::array<int, 6> kAbaqusFace{5, 3, 2, 4, 0, 1};

/// Reference coordinates in [-1, 1]^3 of the 20 nodes.
std::array<Vec3, 20> reference_nodes() {
  std::array<Vec3, 20> nodes;
  for (int c = 0; c < 8; ++c)
    for (int d = 0; d < 3; ++d) nodes[c][d] = 2 * kCornerCoordinates[c][d] - 1;
  for (int e = 0; e < 12; ++e) nodes[8 + e] = (nodes[kHexEdges[e][0]] + nodes[kHexEdges[e][1]]) / 2;
  return nodes;
}

/// Gradients of the serendipity shape functions at the corners and the 3 x 3 x 3 Gauss points.
Gradients make_gradients() {
  const auto nodes = reference_nodes();
  std::vector<Vec3> at(nodes.begin(), nodes.begin() + 8);
  const double g = std::sqrt(0.6);
  for (double r : {-g, 0.0, g})
    for (double s : {-g, 0.0, g})
      for (double t : {-g, 0.0, g}) at.emplace_back(r, s, t);
  Gradients gradients;
  for (int p = 0; p < kPoints; ++p) {
    for (int i = 0; i < 20; ++i) {
      for (int d = 0; d < 3; ++d) {
        // The two other directions.
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        const Vec3& x = at[p];
        const Vec3& n = nodes[i];
        const double se = 1 + x[e] * n[e], sf = 1 + x[f] * n[f];
        if (i < 8) {
          const double sd = 1 + x[d] * n[d];
          gradients[p][i][d] = n[d] * se * sf * (x.dot(n) - 2 + sd) / 8;
        } else if (n[d] == 0) {
          gradients[p][i][d] = -2 * x[d] * se * sf / 4;
        } else {
          const double bubble_e = n[e] == 0 ? 1 - x[e] * x[e] : se, bubble_f = n[f] == 0 ? 1 - x[f] * x[f] : sf;
          gradients[p][i][d] = n[d] * bubble_e * bubble_f / 4;
        }
      }
    }
  }
  return gradients;
}

double least_determinant(const std::array<Vec3, 20>& x) {
  static const Gradients gradients = make_gradients();
  double least = std::numeric_limits<double>::infinity();
  for (const auto& gradient : gradients) {
    Mat3 jacobian = Mat3::Zero();
    for (int i = 0; i < 20; ++i) jacobian += x[i] * gradient[i].transpose();
    least = std::min(least, jacobian.determinant());
  }
  return least;
}

std::array<Vec3, 20> straight_nodes(const std::vector<Vec3>& points, const Hex20& hex) {
  std::array<Vec3, 20> x;
  for (int c = 0; c < 8; ++c) x[c] = points[hex[c]];
  for (int e = 0; e < 12; ++e) x[8 + e] = (x[kHexEdges[e][0]] + x[kHexEdges[e][1]]) / 2;
  return x;
}

std::array<Vec3, 20> curved_nodes(const std::vector<Vec3>& points, const Hex20& hex) {
  std::array<Vec3, 20> x;
  for (int i = 0; i < 20; ++i) x[i] = points[hex[i]];
  return x;
}

/// Calls work(i) for i in [0, count); each call writes only its own results, so the outcome does not depend on the threads.
template <typename Work>
void parallel_for(int count, int threads, const Monitor& monitor, const Work& work) {
  constexpr int kChunk = 64;
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  const auto run = [&] {
    try {
      for (int begin = next.fetch_add(kChunk); begin < count && !failed; begin = next.fetch_add(kChunk)) {
        monitor.check();
        for (int i = begin; i < std::min(begin + kChunk, count); ++i) work(i);
      }
    } catch (...) {
      if (!failed.exchange(true)) failure = std::current_exception();
    }
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(run);
  run();
  for (auto& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

std::uint64_t edge_key(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
}

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

/// The CAD face of the patch nearest to the quad's centre; the first of equally near ones.
int nearest_face(const CadModel& model, const std::vector<int>& faces, const Vec3& centre) {
  if (faces.size() == 1) return faces.front();
  int best = faces.at(0);
  double least = std::numeric_limits<double>::infinity();
  for (int face : faces) {
    const double distance = model.project_to_face(face, centre).distance;
    if (distance < least) {
      least = distance;
      best = face;
    }
  }
  return best;
}

/// Which hex and which of its faces (Abaqus' numbering) each quad is.
std::vector<std::array<int, 2>> find_owners(const std::vector<Hex20>& hexes, const std::vector<Quad>& quads) {
  std::map<Quad, int> wanted;
  const auto sorted = [](Quad quad) {
    std::sort(quad.begin(), quad.end());
    return quad;
  };
  for (int q = 0; q < std::ssize(quads); ++q) wanted[sorted(quads[q])] = q;
  std::vector<std::array<int, 2>> owners(quads.size(), {-1, -1});
  for (int h = 0; h < std::ssize(hexes); ++h)
    for (int f = 0; f < 6; ++f) {
      const auto& c = kHexFaces[f];
      const auto it = wanted.find(sorted({hexes[h][c[0]], hexes[h][c[1]], hexes[h][c[2]], hexes[h][c[3]]}));
      if (it != wanted.end()) owners[it->second] = {h, kAbaqusFace[f]};
    }
  for (const auto& owner : owners)
    if (owner[0] < 0) throw StageFailed("fem", "a boundary quad belongs to no cell");
  return owners;
}

/// Adds the mid-edge nodes of every element, curved onto the CAD where it stands on it. Returns per edge whether it is curved.
std::vector<char> add_mid_nodes(const CadModel& model, FemMesh& mesh, const EdgeList& edges, const FemOptions& options, const Monitor& monitor) {
  std::vector<int> on_edge(edges.size(), 0);
  std::vector<std::array<int, 2>> on_faces(edges.size(), {0, 0});
  const int base = mesh.corner_count;
  for (auto& hex : mesh.hexes)
    for (int e = 0; e < 12; ++e) hex[8 + e] = base + edges.find(hex[kHexEdges[e][0]], hex[kHexEdges[e][1]]);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (int k = 0; k < 4; ++k) {
      const int e = edges.find(mesh.quads[q][k], mesh.quads[q][(k + 1) % 4]);
      mesh.quads[q][4 + k] = base + e;
      on_faces[e][on_faces[e][0] == 0 ? 0 : 1] = mesh.quad_face[q];
    }
  for (std::size_t s = 0; s < mesh.segments.size(); ++s) {
    const int e = edges.find(mesh.segments[s][0], mesh.segments[s][1]);
    mesh.segments[s][2] = base + e;
    on_edge[e] = mesh.segment_edge[s];
  }

  std::vector<int> boundary;
  mesh.points.resize(base + edges.size());
  for (int e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.ends(e);
    mesh.points[base + e] = (mesh.points[a] + mesh.points[b]) / 2;
    if (on_faces[e][0] != 0) boundary.push_back(e);
  }
  const auto count = static_cast<int>(boundary.size());
  const int threads = options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  parallel_for(count, threads, monitor, [&](int i) {
    const int e = boundary[i];
    Vec3& point = mesh.points[base + e];
    if (on_edge[e] != 0) {
      point = model.project_to_edge(on_edge[e], point).point;
      return;
    }
    FacePoint best = model.project_to_face(on_faces[e][0], point);
    if (on_faces[e][1] != 0 && on_faces[e][1] != on_faces[e][0]) {
      // Two faces of one patch meet here without a chain of mesh edges between them.
      const FacePoint other = model.project_to_face(on_faces[e][1], point);
      if (other.distance < best.distance) best = other;
    }
    point = best.point;
  });
  std::vector<char> curved(edges.size(), 0);
  for (int e : boundary) {
    const auto [a, b] = edges.ends(e);
    const Vec3 middle = (mesh.points[a] + mesh.points[b]) / 2;
    curved[e] = mesh.points[base + e] != middle;
  }
  return curved;
}

/// Straightens curved edges, the most curved of a cell first, until no cell is spoilt by them.
void straighten(FemMesh& mesh, const EdgeList& edges, std::vector<char>& curved, const Monitor& monitor) {
  const int base = mesh.corner_count;
  std::map<int, std::vector<int>> cells;  // of each curved edge
  std::vector<int> work;
  for (int h = 0; h < std::ssize(mesh.hexes); ++h) {
    bool any = false;
    for (int e = 0; e < 12; ++e) {
      const int edge = mesh.hexes[h][8 + e] - base;
      if (!curved[edge]) continue;
      cells[edge].push_back(h);
      any = true;
    }
    if (any) work.push_back(h);
  }
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (i % 256 == 0) monitor.check();
    const Hex20& hex = mesh.hexes[work[i]];
    const double floor = kCurvedShare * least_determinant(straight_nodes(mesh.points, hex));
    if (least_determinant(curved_nodes(mesh.points, hex)) > std::max(floor, 0.0)) continue;
    int worst = -1;
    double most = -1;
    for (int e = 0; e < 12; ++e) {
      const int edge = hex[8 + e] - base;
      if (!curved[edge]) continue;
      const auto [a, b] = edges.ends(edge);
      const double bow = (mesh.points[base + edge] - (mesh.points[a] + mesh.points[b]) / 2).norm() / (mesh.points[a] - mesh.points[b]).norm();
      if (bow > most) {
        most = bow;
        worst = edge;
      }
    }
    if (worst < 0) continue;
    const auto [a, b] = edges.ends(worst);
    mesh.points[base + worst] = (mesh.points[a] + mesh.points[b]) / 2;
    curved[worst] = 0;
    ++mesh.straightened;
    work.insert(work.end(), cells[worst].begin(), cells[worst].end());
  }
}

void add_groups(FemMesh& mesh, const Association& association) {
  std::map<CadRef, FemGroup> groups;
  const int quad_nodes = mesh.order == 2 ? 8 : 4, segment_nodes = mesh.order == 2 ? 3 : 2;
  for (int p = 0; p < std::ssize(association.point_cad); ++p)
    if (association.point_cad[p].dim == 0) groups[association.point_cad[p]].nodes.push_back(p);
  for (int s = 0; s < std::ssize(mesh.segments); ++s) {
    FemGroup& group = groups[{1, mesh.segment_edge[s]}];
    group.elements.push_back(s);
    group.nodes.insert(group.nodes.end(), mesh.segments[s].begin(), mesh.segments[s].begin() + segment_nodes);
  }
  for (int q = 0; q < std::ssize(mesh.quads); ++q) {
    FemGroup& group = groups[{2, mesh.quad_face[q]}];
    group.elements.push_back(q);
    group.nodes.insert(group.nodes.end(), mesh.quads[q].begin(), mesh.quads[q].begin() + quad_nodes);
  }
  FemGroup& solid = groups[{3, 1}];
  for (int h = 0; h < std::ssize(mesh.hexes); ++h) solid.elements.push_back(h);
  for (int p = 0; p < std::ssize(mesh.points); ++p) solid.nodes.push_back(p);
  for (auto& [entity, group] : groups) {
    group.entity = entity;
    std::sort(group.nodes.begin(), group.nodes.end());
    group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
    mesh.groups.push_back(std::move(group));
  }
}

void require_positive(const FemMesh& mesh) {
  std::vector<int> bad_cells;
  std::vector<CadRef> faces;
  for (int h = 0; h < std::ssize(mesh.hexes); ++h)
    if (!(least_jacobian(mesh, h) > 0)) bad_cells.push_back(h);
  if (bad_cells.empty()) return;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    if (std::binary_search(bad_cells.begin(), bad_cells.end(), mesh.quad_hex[q][0])) faces.push_back({2, mesh.quad_face[q]});
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  throw StageFailed("fem", std::to_string(bad_cells.size()) + " cells have a Jacobian that is not positive at an integration point", faces);
}

}  // namespace

double least_jacobian(const FemMesh& mesh, int hex) {
  const Hex20& nodes = mesh.hexes[hex];
  return least_determinant(mesh.order == 2 ? curved_nodes(mesh.points, nodes) : straight_nodes(mesh.points, nodes));
}

FemMesh build_fem_mesh(const CadModel& model, const HexMesh& mesh, const Association& association, const FemOptions& options,
                       const Monitor& monitor) {
  monitor.progress("fem", 0);
  FemMesh fem;
  fem.order = options.order;
  fem.points = mesh.points;
  fem.corner_count = static_cast<int>(mesh.points.size());
  for (const Hex& hex : mesh.hexes) {
    Hex20& nodes = fem.hexes.emplace_back();
    nodes.fill(-1);
    std::copy(hex.begin(), hex.end(), nodes.begin());
  }
  fem.quad_hex = find_owners(fem.hexes, association.quads);
  for (std::size_t q = 0; q < association.quads.size(); ++q) {
    auto& nodes = fem.quads.emplace_back();
    nodes.fill(-1);
    std::copy(association.quads[q].begin(), association.quads[q].end(), nodes.begin());
    Vec3 centre = Vec3::Zero();
    for (int p : association.quads[q]) centre += mesh.points[p] / 4;
    if (q % 256 == 0) monitor.check();
    fem.quad_face.push_back(nearest_face(model, association.patches.at(association.quad_patch[q]), centre));
  }
  for (const Segment& segment : association.segments) fem.segments.push_back({segment[0], segment[1], -1});
  fem.segment_edge = association.segment_edge;
  monitor.progress("fem", 0.3);
  if (fem.order == 2) {
    const EdgeList edges(fem.hexes);
    auto curved = add_mid_nodes(model, fem, edges, options, monitor);
    monitor.progress("fem", 0.8);
    straighten(fem, edges, curved, monitor);
  }
  require_positive(fem);
  add_groups(fem, association);
  monitor.progress("fem", 1);
  return fem;
}

}  // namespace polycube
