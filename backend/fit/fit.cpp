#include "fit/fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/parallel.h"
#include "core/quality.h"
#include "fit/energy.h"
#include "fit/start.h"
#include "fit/tuning.h"

namespace polycube {

namespace {

// Whether the cell has to be looked at inside: good corners vouch for it only where its opposite edges go the same way.
bool suspect(const std::vector<Vec3>& points, const Hex& hex, double scaled_jacobian) {
  if (scaled_jacobian <= kFitTuning.poor) return true;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<Vec3, 4> along;
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const auto& [c, d] : kHexEdges) {
      const int step = kCornerCoordinates[d][axis] - kCornerCoordinates[c][axis];
      if (step == 0) continue;
      along[count] = step * (points[hex[d]] - points[hex[c]]).normalized();
      sum += along[count++];
    }
    const double least = kFitTuning.twisted * sum.norm();
    if (std::any_of(along.begin(), along.end(), [&](const Vec3& e) { return e.dot(sum) < least; })) return true;
  }
  return false;
}

// Inverted at an integration point but at no corner.
bool hollow(const std::vector<Vec3>& points, const Hex& hex, double scaled_jacobian) {
  return scaled_jacobian > 0 && suspect(points, hex, scaled_jacobian) && !(least_inner_determinant(points, hex) > 0);
}

// How good a mesh is: first no inverted and flat cells, then no hollow ones, then the worst cell up to a goal, then the mean.
struct Score {
  int inverted = 0;  // or flat, which untangling takes for the same
  int hollow = 0;
  double worst = 0, mean = 0;
  bool better_than(const Score& other, double goal) const {
    if (inverted != other.inverted) return inverted < other.inverted;
    if (hollow != other.hollow) return hollow < other.hollow;
    const double mine = std::min(worst, goal), theirs = std::min(other.worst, goal);
    return mine != theirs ? mine > theirs : mean > other.mean;
  }
};

// What of the boundary can hold a cell's corner where it is.
class CadHold {
 public:
  explicit CadHold(const Association& association) : point_cad_(association.point_cad) {
    for (std::size_t i = 0; i < association.segments.size(); ++i) {
      const auto [a, b] = association.segments[i];
      on_edges_.emplace_back(Segment{std::min(a, b), std::max(a, b)}, association.segment_edge[i]);
    }
    std::sort(on_edges_.begin(), on_edges_.end());
    quads_.reserve(association.quads.size());
    for (const Quad& q : association.quads) quads_.push_back(sorted(q));
    std::sort(quads_.begin(), quads_.end());
  }

  // Whether the cell's worst corner lies between two CAD edges, or along a CAD edge between its two faces, at a narrow angle, and is as good as that lets it
  // be.
  bool holds(const std::vector<Vec3>& points, const Hex& hex) const {
    int worst = 0;
    for (int c = 1; c < 8; ++c) {
      if (corner_scaled_jacobian(points, hex, c) < corner_scaled_jacobian(points, hex, worst)) worst = c;
    }
    const double value = corner_scaled_jacobian(points, hex, worst);
    const auto& next = kCornerNeighbours[worst];
    const auto direction = [&](int k) { return Vec3((points[hex[next[k]]] - points[hex[worst]]).normalized()); };
    const auto held_between = [&](const Vec3& a, const Vec3& b) {
      const double cosine = a.dot(b);
      return cosine > kFitTuning.narrow && value >= kFitTuning.nearly * std::sqrt(std::max(0.0, 1 - cosine * cosine));
    };
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      if (edge_at(hex[worst], hex[next[k]]) == 0) continue;
      if (edge_at(hex[worst], hex[next[l]]) != 0 && held_between(direction(k), direction(l))) return true;
      if (!fills_edge(hex, worst, k)) continue;
      const Vec3 along = direction(k);
      const auto across = [&](int axis) { return Vec3((direction(axis) - along * along.dot(direction(axis))).normalized()); };
      if (held_between(across(l), across(m))) return true;
    }
    return false;
  }

  // What the angles of the CAD that the cell's corners fill let its scaled Jacobian be, 1 where they are not narrow.
  double bound(const CadModel& model, const std::vector<Vec3>& points, const Hex& hex) const {
    double least = 1;
    for (int c = 0; c < 8; ++c) {
      if (point_cad_[hex[c]].dim > 1) continue;
      const double value = corner_scaled_jacobian(points, hex, c);
      // Where curves leave a vertex closer together than mesh edges on them do, as in a cusp, other mesh edges may be further apart.
      const auto bounded_by = [&](double angle) {
        if (std::cos(angle) > kFitTuning.narrow && kFitTuning.nearly * value <= std::sin(angle)) least = std::min(least, std::sin(angle));
      };
      for (int k = 0; k < 3; ++k) {
        const int edge = edge_at(hex[c], hex[kCornerNeighbours[c][k]]), other = edge_at(hex[c], hex[kCornerNeighbours[c][(k + 1) % 3]]);
        if (edge == 0) continue;
        if (other != 0) bounded_by(angle_between(model, point_cad_[hex[c]], edge, other));
        if (fills_edge(hex, c, k)) bounded_by(model.edge(edge).max_angle);
      }
    }
    return least;
  }

 private:
  static Quad sorted(Quad q) {
    std::sort(q.begin(), q.end());
    return q;
  }
  // The CAD edge that a mesh edge is a piece of, or 0.
  int edge_at(int a, int b) const {
    const std::pair key(Segment{std::min(a, b), std::max(a, b)}, 0);
    const auto found = std::lower_bound(on_edges_.begin(), on_edges_.end(), key);
    return found != on_edges_.end() && found->first == key.first ? found->second : 0;
  }
  // Between two CAD edges where they leave a vertex; pi where that cannot be told, elsewhere than at one or of an edge that comes back to it.
  static double angle_between(const CadModel& model, CadRef at, int edge, int other) {
    if (at.dim != 0 || model.edge(edge).closed || model.edge(other).closed) return std::numbers::pi;
    const auto leaving = [&](int e) {
      const std::array<double, 2> range = model.edge_range(e);
      return model.edge(e).vertices[0] == at.id ? model.edge_tangent(e, range[0]) : Vec3(-model.edge_tangent(e, range[1]));
    };
    const Vec3 a = leaving(edge), b = leaving(other);
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
  // Whether both sides of the cell that meet in an edge of it lie on the boundary: it fills all of the angle there.
  bool fills_edge(const Hex& hex, int corner, int k) const {
    const auto& next = kCornerNeighbours[corner];
    return on_boundary(hex, corner, next[k], next[(k + 1) % 3]) && on_boundary(hex, corner, next[k], next[(k + 2) % 3]);
  }
  // Whether the cell's side that has the three corners lies on the boundary.
  bool on_boundary(const Hex& hex, int a, int b, int c) const {
    for (const auto& side : kHexFaces) {
      const auto has = [&](int corner) { return std::find(side.begin(), side.end(), corner) != side.end(); };
      if (has(a) && has(b) && has(c)) return std::binary_search(quads_.begin(), quads_.end(), sorted({hex[side[0]], hex[side[1]], hex[side[2]], hex[side[3]]}));
    }
    return false;
  }

  const std::vector<CadRef>& point_cad_;
  std::vector<std::pair<Segment, int>> on_edges_;  // sorted, each with its CAD edge
  std::vector<Quad> quads_;                        // sorted
};

// How far untangling has come.
struct Untangling {
  Energy energy{};
  double deepest = -std::numeric_limits<double>::infinity();  // worst determinant
  int round = 0;
  int idle = 0;  // rounds without progress
  bool done = false;
};

// Inverted cells by powers of four, a few more or less say nothing of what comes of them; then the lack of quality.
using Prospect = std::pair<int, double>;

class Fitting {
 public:
  Fitting(const CadModel& model, HexMesh& mesh, const Association& association, const FitOptions& options, const Monitor& monitor)
      : model_(model),
        mesh_(mesh),
        association_(association),
        options_(options),
        monitor_(monitor),
        graph_(build_hex_graph(mesh)),
        chains_(model, association),
        entities_(model, association, options.threads),
        descent_(mesh, graph_, entities_, options.threads, monitor) {
    whole_.hexes.resize(mesh.hexes.size());
    std::iota(whole_.hexes.begin(), whole_.hexes.end(), 0);
    whole_.nodes = movable(whole_.hexes);
    find_quad_hexes();
  }

  // The first rounds, after which it is to be seen what will come of it.
  void begin() {
    place_on_cad(model_, mesh_, association_, chains_, entities_, monitor_);
    best_ = mesh_.points;
    score_ = rate();
    if (options_.keep_sizes) kept_lengths_ = target_lengths(mesh_, graph_, 0);
    monitor_.progress("fit", 0.15);
    untangle(whole_, 20, start_, kFitTuning.first_rounds);
  }

  // How it would go on: few inverted cells mended, one descent towards right angles. Less is more promising. Leaves things as they are.
  Prospect prospect() {
    const std::vector<Vec3> points = mesh_.points, best = best_;
    const Score score = score_;
    restore();
    if (score_.inverted > 0 && score_.inverted <= kFitTuning.few) {
      Untangling mending;
      untangle(around(kFitTuning.flat, 2), 50, mending, kFitTuning.prospect_rounds);
      restore();
    }
    if (score_.worst > 0) square_up(whole_, 2, 20);
    // The worst cell will be worked on, the mean hardly changes any more.
    const Prospect result{(std::bit_width(static_cast<unsigned>(score_.inverted)) + 1) / 2, -score_.mean - kFitTuning.worst_weight * score_.worst};
    best_ = best;
    score_ = score;
    mesh_.points = points;
    entities_.project(mesh_.points);
    return result;
  }

  FitReport finish() {
    untangle(whole_, 20, start_, options_.max_rounds);
    for (int layers = 2; score_.inverted > 0 && layers <= 6; layers += 2) {
      restore();
      untangle(around(kFitTuning.flat, layers), 50);
    }
    // Nodes of faces may want to slide out over the border.
    with_skin_ = true;
    for (int layers = 2; score_.inverted > 0 && layers <= 6; layers += 2) {
      restore();
      untangle(around(kFitTuning.flat, layers), 50);
    }
    // A few cells that resist get another start: their surroundings smoothed flat.
    for (int layers = 2; score_.inverted > 0 && score_.inverted <= kFitTuning.few && layers <= 6; layers += 2) {
      restore();
      const CellRegion region = around(kFitTuning.flat, layers);
      smooth(region);
      untangle(region, 50);
    }
    with_skin_ = false;
    restore();
    monitor_.progress("fit", 0.5);
    if (score_.worst > 0) {
      square_up();
      if (score_.hollow > 0) fill_hollow();
      monitor_.progress("fit", 0.8);
      if (score_.worst < goal() || score_.hollow > 0) {
        raise_worst();
        monitor_.progress("fit", 0.9);
        polish();
      }
    }
    restore();
    return report();
  }

  // What `finish` left, made better as a whole.
  FitReport even_out() {
    monitor_.progress("fit", 0.95);
    if (score_.worst > 0) even_cells();
    restore();
    return report();
  }

 private:
  std::vector<Vec3> wanted_lengths() const { return options_.keep_sizes ? kept_lengths_ : target_lengths(mesh_, graph_, kFitTuning.size_smoothing); }

  std::vector<int> movable(const std::vector<int>& hexes) const {
    std::vector<int> nodes;
    for (int h : hexes) nodes.insert(nodes.end(), mesh_.hexes[h].begin(), mesh_.hexes[h].end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::erase_if(nodes, [&](int v) { return entities_.dimension(v) == 0; });
    return nodes;
  }

  Score rate() const {
    Score score{.worst = 1};
    for (const Hex& hex : mesh_.hexes) {
      const double value = scaled_jacobian(mesh_.points, hex);
      score.inverted += value <= kFitTuning.flat;
      score.hollow += hollow(mesh_.points, hex, value);
      score.worst = std::min(score.worst, value);
      score.mean += value;
    }
    score.mean /= static_cast<double>(mesh_.hexes.size());
    return score;
  }

  // Notes the mesh if it is the best so far.
  bool note_if_best() {
    const Score now = rate();
    if (!now.better_than(score_, std::min(goal(), held_))) return false;
    score_ = now;
    best_ = mesh_.points;
    return true;
  }

  void restore() {
    mesh_.points = best_;
    entities_.project(mesh_.points);
  }

  // The same where only nodes of the region have moved since.
  void restore(const CellRegion& region) {
    for (int v : region.nodes) mesh_.points[v] = best_[v];
    entities_.project(mesh_.points, &region.nodes);
  }

  // The cells with a scaled Jacobian of at most `limit` and some layers round them; nodes on the rim stay.
  CellRegion around(double limit, int layers) const {
    std::vector<int> bad;
    for (int h : whole_.hexes) {
      if (scaled_jacobian(mesh_.points, mesh_.hexes[h]) <= limit) bad.push_back(h);
    }
    return around(std::move(bad), layers);
  }
  CellRegion around(std::vector<int> front, int layers) const {
    std::vector<char> in(mesh_.hexes.size(), 0);
    for (int h : front) in[h] = 1;
    CellRegion region;
    for (int layer = 0; layer < layers; ++layer) {
      std::vector<int> next;
      for (int h : front) {
        for (int v : mesh_.hexes[h]) {
          for (int k = graph_.first[v]; k < graph_.first[v + 1]; ++k) {
            const int other = graph_.corners[k] / 8;
            if (!in[other]) next.push_back(other);
            in[other] = 1;
          }
        }
      }
      front.swap(next);
    }
    for (int h : whole_.hexes) {
      if (in[h]) region.hexes.push_back(h);
    }
    region.nodes = movable(region.hexes);
    std::erase_if(region.nodes, [&](int v) {
      return std::any_of(graph_.corners.begin() + graph_.first[v], graph_.corners.begin() + graph_.first[v + 1], [&](int corner) { return !in[corner / 8]; });
    });
    return region;
  }

  // Takes the nodes of patches and the inside to the mean of their neighbours, those of patches to the mean of their neighbours on the
  // boundary.
  void smooth(const CellRegion& region) {
    std::vector<int> nodes = region.nodes;
    std::erase_if(nodes, [&](int v) { return entities_.dimension(v) < 2; });
    for (int round = 0; round < kFitTuning.smooth_rounds; ++round) {
      monitor_.check();
      std::vector<Vec3> means;
      for (int v : nodes) {
        Vec3 sum = Vec3::Zero();
        int count = 0;
        for (int k = graph_.first[v]; k < graph_.first[v + 1]; ++k) {
          const Hex& hex = mesh_.hexes[graph_.corners[k] / 8];
          for (int c : kCornerNeighbours[graph_.corners[k] % 8]) {
            if (entities_.dimension(v) == 2 && entities_.dimension(hex[c]) > 2) continue;
            sum += mesh_.points[hex[c]];
            ++count;
          }
        }
        means.push_back(count > 0 ? Vec3(sum / count) : mesh_.points[v]);
      }
      for (std::size_t i = 0; i < nodes.size(); ++i) mesh_.points[nodes[i]] = means[i];
      entities_.project(mesh_.points, &nodes);
    }
  }

  void find_quad_hexes() {
    for (const Quad& quad : association_.quads) {
      const auto has_all = [&](int corner) {
        const Hex& hex = mesh_.hexes[corner / 8];
        return std::all_of(quad.begin(), quad.end(), [&](int v) { return std::find(hex.begin(), hex.end(), v) != hex.end(); });
      };
      const auto begin = graph_.corners.begin() + graph_.first[quad[0]], end = graph_.corners.begin() + graph_.first[quad[0] + 1];
      quad_hex_.push_back(*std::find_if(begin, end, has_all) / 8);
    }
  }

  // The corners of the region's boundary quads, where they lie on one CAD face and not between two CAD edges: the CAD holds those.
  std::vector<SkinCorner> skin(const std::vector<Vec3>& targets, const CellRegion& region) const {
    std::vector<SkinCorner> corners;
    for (std::size_t q = 0; q < association_.quads.size(); ++q) {
      if (association_.patches[association_.quad_patch[q]].size() != 1 || !std::binary_search(region.hexes.begin(), region.hexes.end(), quad_hex_[q])) continue;
      const Quad& quad = association_.quads[q];
      const Hex& hex = mesh_.hexes[quad_hex_[q]];
      const auto wanted = [&](int a, int b) {
        const auto& c = kCornerCoordinates[std::find(hex.begin(), hex.end(), a) - hex.begin()];
        const auto& d = kCornerCoordinates[std::find(hex.begin(), hex.end(), b) - hex.begin()];
        int axis = 0;
        while (c[axis] == d[axis]) ++axis;
        return targets[quad_hex_[q]][axis];
      };
      for (int k = 0; k < 4; ++k) {
        const int at = quad[k], next = quad[(k + 1) % 4], previous = quad[(k + 3) % 4];
        const auto inside = [&](int v) { return entities_.dimension(v) == 2; };
        if (!inside(at) && !inside(next) && !inside(previous)) continue;
        const int normal_at = inside(at) ? at : inside(next) ? next : previous;
        corners.push_back({{at, next, previous}, {wanted(at, next), wanted(at, previous)}, entities_.normal(normal_at)});
      }
    }
    return corners;
  }

  // Foldover-free energy with eps driven to 0 as the worst determinant rises (Garanzha et al. 2021, section 3).
  // Stops where neither the worst determinant nor the mesh has become better for some rounds.
  void untangle(const CellRegion& region, int iterations) {
    Untangling from_nothing;
    untangle(region, iterations, from_nothing, options_.max_rounds);
  }

  // Goes on from `state` up to so many rounds in all.
  void untangle(const CellRegion& region, int iterations, Untangling& state, int max_rounds) {
    const int cells = static_cast<int>(mesh_.hexes.size());
    const bool is_whole = region.hexes.size() == mesh_.hexes.size();
    auto& [energy, deepest, round, idle, done] = state;
    for (; !done && round < max_rounds && idle < kFitTuning.patience; ++round, ++idle) {
      const auto targets = wanted_lengths();
      const std::vector<SkinCorner> corners = with_skin_ ? skin(targets, region) : std::vector<SkinCorner>{};
      const double least = std::min(descent_.min_determinant(targets, region, corners), 0.0);
      if (round == 0 || least < 0) energy.eps = std::max(energy.eps, std::sqrt(1e-6 + 0.04 * least * least));
      const DescentResult result = descent_.run(energy, targets, region, chains_.turns(mesh_.points, entities_), corners, iterations);
      entities_.project(mesh_.points);
      chains_.keep_order(mesh_.points, entities_);
      const bool improved = note_if_best();
      monitor_.progress("fit", 0.15 + 0.35 * round / options_.max_rounds);
      const double reached = descent_.min_determinant(targets, region, corners);
      if (improved || reached > deepest + 0.01 * std::abs(deepest)) idle = 0;
      deepest = std::max(deepest, reached);
      const double gain = 1 - result.energy / result.start_energy;
      done = gain < kFitTuning.converged &&
             (reached > 0 || (is_whole && score_.inverted > 0 && score_.inverted <= std::max(kFitTuning.few, cells / kFitTuning.rare)));
      if (done) break;
      const double rate_of_fall = std::max(gain, 0.1);
      const double chi = (reached + std::sqrt(energy.eps * energy.eps + reached * reached)) / 2;
      const double wanted = (1 - rate_of_fall) * chi;
      energy.eps = reached < wanted ? 2 * std::sqrt(wanted * (wanted - reached)) : 1e-9;
    }
  }

  // Corners all positive do not make a cell positive inside: such cells are untangled at their integration points, and watched from then
  // on.
  void fill_hollow() {
    for (int layers = 2; score_.hollow > 0 && layers <= 6; layers += 2) {
      std::vector<int> cells;
      for (int h : whole_.hexes) {
        if (hollow(mesh_.points, mesh_.hexes[h], scaled_jacobian(mesh_.points, mesh_.hexes[h]))) cells.push_back(h);
      }
      untangle(watching(around(std::move(cells), layers)), 50);
      restore();
    }
    watching_ = score_.hollow == 0;
  }

  // The same region, with an eye on the inside of doubtful cells.
  CellRegion watching(CellRegion region) const {
    for (int h : region.hexes) region.watched.push_back(suspect(mesh_.points, mesh_.hexes[h], scaled_jacobian(mesh_.points, mesh_.hexes[h])));
    return region;
  }

  // One descent on a power of the inverse scaled Jacobian from the best mesh so far. True if that made a better one; else the mesh is as
  // before.
  bool square_up(const CellRegion& region, int power, int iterations, double* gain = nullptr, double floor = 0) {
    const auto targets = wanted_lengths();
    const DescentResult result =
        descent_.run({0.1, 1, power, floor}, targets, watching_ ? watching(region) : region, chains_.turns(mesh_.points, entities_), {}, iterations);
    if (gain) *gain = 1 - result.energy / result.start_energy;
    entities_.project(mesh_.points, &region.nodes);
    monitor_.check();
    if (note_if_best()) return true;
    restore(region);
    return false;
  }

  // The whole mesh towards right angles.
  void square_up() {
    double gain = 1;
    for (int round = 0; round < 5 && gain > 1e-3; ++round) {
      if (!square_up(whole_, 2, 20, &gain)) break;
    }
  }

  // The worst cells with their surroundings, by higher and higher powers: each as long as it brings something.
  void raise_worst() {
    for (int round = 0, stage = 0; round < options_.max_rounds && stage < kFitTuning.raise_stages && score_.worst < goal(); ++round) {
      const double before = score_.worst;
      square_up(around(std::min(goal(), before + 0.15), 2 + stage), 4 << std::min(stage, kFitTuning.raise_highest), 60);
      if (score_.worst <= before + kFitTuning.raise_progress) ++stage;
    }
  }

  // Raising the worst cells bends those round them: the whole mesh once more, with the worst held nearly where they are. The floor rises
  // with them, and where it did not hold them.
  void polish() {
    held_ = kFitTuning.held * score_.worst;
    double gain = 1, floor = 1.2;
    for (int round = 0; round < 5 && gain > 1e-3; ++round) {
      if (square_up(whole_, 2, 40, &gain, floor * score_.worst)) continue;
      floor *= kFitTuning.higher;
      if (floor > kFitTuning.highest) break;
    }
  }

  // No energy so far looks at cells as a whole: the mesh by about the worst corner of each cell, the worst cells held where they are. While they are below
  // the goal a floor that lies above them, and rises with them, raises them too; where it did not hold them it rises further.
  void even_cells() {
    const double least = kFitTuning.held * score_.worst;
    const auto merit = [&](const Score& s) { return s.mean + kFitTuning.worst_weight * std::min(s.worst, goal()); };
    double above = score_.worst < goal() ? kFitTuning.raising : 1;
    for (int round = 0; round < kFitTuning.even_rounds && above <= kFitTuning.highest && !options_.hurry(); ++round) {
      const Energy energy{.shape = options_.keep_sizes ? kFitTuning.kept_shape : kFitTuning.even_shape,
                          .right = 1,
                          .floor = above * score_.worst,
                          .gathered = kFitTuning.gathered};
      // Cells that are good already stay, but for those beside others.
      const CellRegion region = around(kFitTuning.even_good, kFitTuning.even_layers);
      descent_.run(energy, wanted_lengths(), watching_ ? watching(region) : region, chains_.turns(mesh_.points, entities_), {}, kFitTuning.even_steps);
      entities_.project(mesh_.points, &region.nodes);
      monitor_.check();
      const Score now = rate();
      const double gain = merit(now) - merit(score_);
      if (now.inverted > score_.inverted || now.hollow > score_.hollow || now.worst < least || gain <= 0) {
        restore(region);
        if (gain <= 0 && now.worst >= score_.worst) break;
        above *= kFitTuning.higher;
        continue;
      }
      const bool rising = now.worst < options_.target_scaled_jacobian && now.worst > kFitTuning.rising * score_.worst;
      score_ = now;
      best_ = mesh_.points;
      if (gain < kFitTuning.even_gain && !rising) break;
    }
  }

  // Cells are worked on until they are somewhat better than asked for.
  double goal() const { return 1.5 * options_.target_scaled_jacobian; }

  FitReport report() const {
    FitReport report;
    const Score now = rate();
    for (const Hex& hex : mesh_.hexes) report.inverted += scaled_jacobian(mesh_.points, hex) <= 0;
    report.min_scaled_jacobian = now.worst;
    report.mean_scaled_jacobian = now.mean;
    std::vector<double> off(entities_.boundary().size());
    for_chunks(static_cast<int>(off.size()), 64, options_.threads, [&](int, int first, int last) {
      for (int i = first; i < last; ++i) off[i] = entities_.distance(entities_.boundary()[i], mesh_.points[entities_.boundary()[i]]);
    });
    if (!off.empty()) report.max_off = *std::max_element(off.begin(), off.end());
    std::vector<char> touches_bad(mesh_.points.size(), 0);
    for (const Hex& hex : mesh_.hexes) {
      if (scaled_jacobian(mesh_.points, hex) > 0) continue;
      for (int node : hex) touches_bad[node] = 1;
    }
    for (std::size_t q = 0; q < association_.quads.size(); ++q) {
      if (std::none_of(association_.quads[q].begin(), association_.quads[q].end(), [&](int v) { return touches_bad[v]; })) continue;
      const auto& faces = association_.patches[association_.quad_patch[q]];
      report.bad_faces.insert(report.bad_faces.end(), faces.begin(), faces.end());
    }
    std::sort(report.bad_faces.begin(), report.bad_faces.end());
    report.bad_faces.erase(std::unique(report.bad_faces.begin(), report.bad_faces.end()), report.bad_faces.end());
    return report;
  }

  const CadModel& model_;
  HexMesh& mesh_;
  const Association& association_;
  const FitOptions& options_;
  const Monitor& monitor_;
  HexGraph graph_;
  Chains chains_;
  Entities entities_;
  Descent descent_;
  CellRegion whole_;
  std::vector<Vec3> best_;
  Score score_;
  Untangling start_;                                       // of the whole mesh
  std::vector<int> quad_hex_;                              // per boundary quad: the hex it is a side of
  std::vector<Vec3> kept_lengths_;                         // per hex: what its edges are to be like, where sizes are kept
  bool with_skin_ = false;                                 // untangling looks at boundary quads too
  bool watching_ = false;                                  // cells were inverted inside, and are no more
  double held_ = std::numeric_limits<double>::infinity();  // while polishing: a worst cell above this is no gain
};

}  // namespace

FitReport fit(const CadModel& model, HexMesh& mesh, const Association& association, const FitOptions& options, const Monitor& monitor) {
  const auto good = [](std::size_t, const FitReport&) { return true; };
  return fit_best(model, {{mesh, association}}, options, 1, good, monitor).report;
}

namespace {

struct Begun {
  std::vector<std::unique_ptr<Fitting>> fittings;
  std::vector<std::size_t> order;  // the most promising first
};

Begun begin_all(const CadModel& model, const std::vector<FitCandidate>& candidates, const FitOptions& options, const Monitor& monitor) {
  Begun result;
  auto& fittings = result.fittings;
  for (const auto& [mesh, association] : candidates) {
    if (association.point_cad.size() != mesh.points.size()) throw StageFailed("fit", "the association has not one entry a node");
    if (mesh.hexes.empty()) throw StageFailed("fit", "the mesh has no cells");
    monitor.progress("fit", 0);
    fittings.push_back(std::make_unique<Fitting>(model, mesh, association, options, monitor));
    fittings.back()->begin();
  }
  result.order.resize(candidates.size());
  std::iota(result.order.begin(), result.order.end(), 0);
  if (fittings.size() == 1) return result;
  std::vector<Prospect> prospects;
  for (std::size_t i = 0; i < fittings.size(); ++i) {
    prospects.push_back(fittings[i]->prospect());
    prospects[i].second += kFitTuning.doubt * static_cast<double>(std::min<std::size_t>(i, 1));
  }
  std::stable_sort(result.order.begin(), result.order.end(), [&](std::size_t a, std::size_t b) { return prospects[a] < prospects[b]; });
  return result;
}

}  // namespace

std::size_t most_promising(const CadModel& model, const std::vector<FitCandidate>& candidates, const FitOptions& options, const Monitor& monitor) {
  return candidates.size() == 1 ? 0 : begin_all(model, candidates, options, monitor).order.front();
}

FitChoice fit_best(const CadModel& model, const std::vector<FitCandidate>& candidates, const FitOptions& options, int most,
                   const std::function<bool(std::size_t, const FitReport&)>& good, const Monitor& monitor) {
  const Begun begun = begin_all(model, candidates, options, monitor);
  const auto rank = [](const FitReport& r) { return std::pair(-r.inverted, r.min_scaled_jacobian); };
  FitChoice choice;
  std::pair<int, double> best;  // before its cells were evened out, which costs as much as what it brings in the end
  for (std::size_t i : begun.order) {
    if (choice.fitted == most) break;
    const FitReport report = begun.fittings[i]->finish();
    if (choice.fitted++ == 0 || rank(report) > best) {
      best = rank(report);
      choice.index = i;
      choice.report = begun.fittings[i]->even_out();
    }
    if (good(choice.index, choice.report)) break;
  }
  monitor.progress("fit", 1);
  return choice;
}

bool at_cad_bound(const CadModel& model, const HexMesh& mesh, const Association& association) {
  const CadHold cad(association);
  double least = 1, bound = 1;
  for (const Hex& hex : mesh.hexes) {
    least = std::min(least, scaled_jacobian(mesh.points, hex));
    bound = std::min(bound, cad.bound(model, mesh.points, hex));
  }
  return bound < 1 && least >= kFitTuning.nearly * bound;
}

double free_scaled_jacobian(const HexMesh& mesh, const Association& association) {
  const CadHold cad(association);
  double least = 1;
  for (const Hex& hex : mesh.hexes) {
    const double value = scaled_jacobian(mesh.points, hex);
    if (value < least && !cad.holds(mesh.points, hex)) least = value;
  }
  return least;
}

}  // namespace polycube
