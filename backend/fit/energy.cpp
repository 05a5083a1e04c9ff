#include "fit/energy.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/hexahedron.h"
#include "core/parallel.h"
#include "core/quality.h"
#include "fit/tuning.h"

namespace polycube {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kChunk = 512;

// Axis of each of the three edges of a corner, in the order of kCornerNeighbours.
constexpr std::array<std::array<int, 3>, 8> corner_axes() {
  std::array<std::array<int, 3>, 8> axes{};
  for (int c = 0; c < 8; ++c) {
    for (int k = 0; k < 3; ++k) {
      const int d = kCornerNeighbours[c][k];
      for (int a = 0; a < 3; ++a) {
        if (kCornerCoordinates[c][a] != kCornerCoordinates[d][a]) axes[c][k] = a;
      }
    }
  }
  return axes;
}
constexpr auto kCornerAxes = corner_axes();

double determinant(const std::vector<Vec3>& points, const Hex& hex, int c, const Vec3& lengths) {
  const Vec3& x = points[hex[c]];
  const auto& n = kCornerNeighbours[c];
  return (points[hex[n[0]]] - x).dot((points[hex[n[1]]] - x).cross(points[hex[n[2]]] - x)) / lengths.prod();
}

// Vectors of N corners at once, a row each: the processor takes several rows in one step.
template <int N>
using Vectors = Eigen::Array<double, N, 3>;
template <int N>
using Values = Eigen::Array<double, N, 1>;

template <int N>
Vectors<N> cross(const Vectors<N>& a, const Vectors<N>& b) {
  Vectors<N> c;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    c.col(k) = a.col(l) * b.col(m) - a.col(m) * b.col(l);
  }
  return c;
}

template <int N>
Values<N> dot(const Vectors<N>& a, const Vectors<N>& b) {
  return a.col(0) * b.col(0) + a.col(1) * b.col(1) + a.col(2) * b.col(2);
}

template <int N>
Values<N> raised(const Values<N>& x, int power) {
  Values<N> result = Values<N>::Ones();
  for (int k = 0; k < power; ++k) result *= x;
  return result;
}

// Sum of the energies of N corners, and their derivatives by the three scaled edge vectors.
template <int N>
double corner_energies(const Energy& energy, const std::array<Vectors<N>, 3>& j, std::array<Vectors<N>, 3>& gradient) {
  const std::array<Vectors<N>, 3> cofactor{cross<N>(j[1], j[2]), cross<N>(j[2], j[0]), cross<N>(j[0], j[1])};
  const std::array<Values<N>, 3> squared{dot<N>(j[0], j[0]), dot<N>(j[1], j[1]), dot<N>(j[2], j[2])};
  const Values<N> det = dot<N>(j[0], cofactor[0]);
  if (energy.eps == 0 && (det <= 0).any()) return kInfinity;
  const Values<N> root = (energy.eps * energy.eps + det.square()).sqrt();
  // The second form of chi keeps its digits where det is far below 0.
  const Values<N> chi = (det >= 0).select((det + root) / 2, energy.eps * energy.eps / (2 * (root - det)));
  if ((chi < 1e-200).any()) return kInfinity;
  const Values<N> inverse = chi.inverse(), slope = chi / root;  // d chi / d det
  const Values<N> mean = ((squared[0] + squared[1] + squared[2]) / 3).sqrt();
  const Values<N> both = mean.cube() * inverse + (det.square() + 1) * inverse / 2;
  double value = energy.shape * both.sum();
  Values<N> by_det = energy.shape * inverse * (det - both * slope);
  const Values<N> by_shape = energy.shape * mean * inverse;
  std::array<Values<N>, 3> by_edge{by_shape, by_shape, by_shape};
  if (energy.right > 0) {
    const int half = energy.power / 2;
    const Values<N> skewness = squared[0] * squared[1] * squared[2] * inverse.square();  // 1 / scaled Jacobian^2
    Values<N> steep;                                                                     // by the logarithm of the inverse scaled Jacobian
    if (energy.gathered > 0) {
      const Values<N> terms = raised<N>(skewness, energy.gathered / 2);
      const double sum = terms.sum();
      value += energy.right * 2 * N / energy.gathered * std::log(sum / N);
      steep = energy.right * 2 * N / sum * terms;
    } else {
      const Values<N> right = energy.right * raised<N>(skewness, half);
      value += right.sum();
      steep = energy.power * right;
    }
    if (energy.floor > 0) {
      const Values<N> near = energy.right / (energy.floor * energy.floor) * raised<N>(energy.floor * energy.floor * skewness, kFitTuning.half_floor_power);
      value += near.sum();
      steep += 2 * kFitTuning.half_floor_power * near;
    }
    by_det -= steep * inverse * slope;
    for (int k = 0; k < 3; ++k) {
      const Values<N> per_length = squared[k].max(1e-300).inverse();
      const Values<N> shortness = energy.right * raised<N>(kFitTuning.short_edge * kFitTuning.short_edge * per_length, half);
      value += shortness.sum();
      by_edge[k] += (steep - energy.power * shortness) * per_length;
    }
  }
  for (int k = 0; k < 3; ++k) gradient[k] = j[k].colwise() * by_edge[k] + cofactor[k].colwise() * by_det;
  return value;
}

// The two edges of the corner over their wanted lengths.
std::array<Vec3, 2> sides(const SkinCorner& corner, const std::vector<Vec3>& points) {
  const Vec3& x = points[corner.nodes[0]];
  return {(points[corner.nodes[1]] - x) / corner.lengths[0], (points[corner.nodes[2]] - x) / corner.lengths[1]};
}

double dot(const std::vector<Vec3>& x, const std::vector<Vec3>& y, int threads) {
  const int count = static_cast<int>(x.size());
  std::vector<double> partial((count + 8 * kChunk - 1) / (8 * kChunk));
  for_chunks(count, 8 * kChunk, threads, [&](int chunk, int first, int last) {
    double sum = 0;
    for (int i = first; i < last; ++i) sum += x[i].dot(y[i]);
    partial[chunk] = sum;
  });
  double total = 0;
  for (double p : partial) total += p;
  return total;
}

// x += factor * y
void add(std::vector<Vec3>& x, double factor, const std::vector<Vec3>& y, int threads) {
  for_chunks(static_cast<int>(x.size()), 8 * kChunk, threads, [&](int, int first, int last) {
    for (int i = first; i < last; ++i) x[i] += factor * y[i];
  });
}

// The last pairs of steps and gradient changes, and the direction they give.
class History {
 public:
  History(const std::vector<double>& sizes, std::size_t memory, int threads) : sizes_(sizes), memory_(memory), threads_(threads) {}

  void add_pair(std::vector<Vec3> step, std::vector<Vec3> change) {
    const double curvature = dot(step, change, threads_);
    double scaled = 0;
    for (std::size_t i = 0; i < change.size(); ++i) scaled += sizes_[i] * sizes_[i] * change[i].squaredNorm();
    if (!(curvature > 1e-12 * scaled) || !(scaled > 0)) return;
    if (pairs_.size() == memory_) pairs_.erase(pairs_.begin());
    pairs_.push_back({std::move(step), std::move(change), 1 / curvature});
    scale_ = curvature / scaled;
  }
  void clear() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  std::vector<Vec3> direction(const std::vector<Vec3>& gradient) const {
    std::vector<Vec3> d = gradient;
    std::vector<double> alpha(pairs_.size());
    for (int i = static_cast<int>(pairs_.size()) - 1; i >= 0; --i) {
      alpha[i] = pairs_[i].rho * dot(pairs_[i].step, d, threads_);
      add(d, -alpha[i], pairs_[i].change, threads_);
    }
    for (std::size_t i = 0; i < d.size(); ++i) d[i] *= -scale_ * sizes_[i] * sizes_[i];
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const double beta = -pairs_[i].rho * dot(pairs_[i].change, d, threads_);
      add(d, beta - alpha[i], pairs_[i].step, threads_);
    }
    return d;
  }

 private:
  struct Pair {
    std::vector<Vec3> step, change;
    double rho;
  };
  const std::vector<double>& sizes_;
  std::size_t memory_;
  int threads_;
  std::vector<Pair> pairs_;
  double scale_ = 0.02;
};

}  // namespace

Descent::Descent(HexMesh& mesh, const HexGraph& graph, const Entities& entities, int threads, const Monitor& monitor)
    : mesh_(mesh), graph_(graph), entities_(entities), threads_(threads), monitor_(monitor), slot_(mesh.hexes.size(), -1), node_slot_(mesh.points.size(), -1) {}

double Descent::min_determinant(const std::vector<Vec3>& targets, const CellRegion& region, const std::vector<SkinCorner>& skin) const {
  const int count = static_cast<int>(region.hexes.size());
  std::vector<double> partial((count + kChunk - 1) / kChunk, kInfinity);
  for_chunks(count, kChunk, threads_, [&](int chunk, int first, int last) {
    for (int i = first; i < last; ++i) {
      const int h = region.hexes[i];
      for (int c = 0; c < 8; ++c) partial[chunk] = std::min(partial[chunk], determinant(mesh_.points, mesh_.hexes[h], c, targets[h]));
      if (region.watched.empty() || !region.watched[i]) continue;
      partial[chunk] = std::min(partial[chunk], 8 * least_inner_determinant(mesh_.points, mesh_.hexes[h]) / targets[h].prod());  // of [-1, 1]^3
    }
  });
  double least = partial.empty() ? kInfinity : *std::min_element(partial.begin(), partial.end());
  for (const SkinCorner& corner : skin) {
    const auto [first, second] = sides(corner, mesh_.points);
    least = std::min(least, first.cross(second).dot(corner.normal));
  }
  return least;
}

double Descent::evaluate(const Energy& energy, const std::vector<Vec3>& targets, const CellRegion& region, const std::vector<Turn>& turns,
                         const std::vector<SkinCorner>& skin, const std::vector<Vec3>& points, const std::vector<Vec3>& steps, std::vector<Vec3>& gradient) {
  const std::array<InnerDerivatives, 3>& inner = inner_derivatives();
  const int count = static_cast<int>(region.hexes.size());
  std::vector<double> partial((count + kChunk - 1) / kChunk);
  for_chunks(count, kChunk, threads_, [&](int chunk, int first, int last) {
    double sum = 0;
    for (int i = first; i < last; ++i) {
      const int h = region.hexes[i];
      const Hex& hex = mesh_.hexes[h];
      const Vec3 inverse = targets[h].cwiseInverse();
      Vectors<8> corners;
      for (int c = 0; c < 8; ++c) corners.row(c) = points[hex[c]].transpose();
      std::array<Values<8>, 3> scale;
      std::array<Vectors<8>, 3> j, by;
      for (int k = 0; k < 3; ++k) {
        for (int c = 0; c < 8; ++c) {
          scale[k][c] = inverse[kCornerAxes[c][k]];
          j[k].row(c) = corners.row(kCornerNeighbours[c][k]);
        }
        j[k] = (j[k] - corners).colwise() * scale[k];
      }
      const double value = corner_energies<8>(energy, j, by);
      sum += value;
      if (value == kInfinity) break;
      Eigen::Map<Eigen::Matrix<double, 3, 8>> g(corner_gradient_.data() + 24 * static_cast<std::size_t>(i));
      for (int k = 0; k < 3; ++k) by[k] = by[k].colwise() * scale[k];
      g = -(by[0] + by[1] + by[2]).matrix().transpose();
      for (int c = 0; c < 8; ++c) {
        for (int k = 0; k < 3; ++k) g.col(kCornerNeighbours[c][k]) += by[k].row(c).matrix().transpose();
      }
      if (region.watched.empty() || !region.watched[i]) continue;
      std::array<Vectors<kInnerPoints>, 3> inner_j, inner_by;
      for (int a = 0; a < 3; ++a) inner_j[a] = (inner[a] * corners.matrix() * (2 * inverse[a])).array();  // of [0, 1]^3
      const double inside = corner_energies<kInnerPoints>(energy, inner_j, inner_by);
      sum += inside;
      if (inside == kInfinity) break;
      for (int a = 0; a < 3; ++a) g += 2 * inverse[a] * inner_by[a].matrix().transpose() * inner[a];
    }
    partial[chunk] = sum;
  });
  double total = 0;
  for (double p : partial) total += p;
  if (!(total < kInfinity)) return kInfinity;
  for_chunks(static_cast<int>(region.nodes.size()), kChunk, threads_, [&](int, int first, int last) {
    for (int i = first; i < last; ++i) {
      const int v = region.nodes[i];
      Vec3 sum = Vec3::Zero();
      for (int k = graph_.first[v]; k < graph_.first[v + 1]; ++k) {
        const int at = slot_[graph_.corners[k] / 8];
        if (at >= 0) sum += Eigen::Map<const Vec3>(corner_gradient_.data() + 3 * (8 * static_cast<std::size_t>(at) + graph_.corners[k] % 8));
      }
      gradient[i] = entities_.along(v, sum, steps[i]);
    }
  });
  for (const SkinCorner& corner : skin) {
    const auto [first, second] = sides(corner, points);
    std::array<Vectors<1>, 3> by{Vectors<1>::Zero(), Vectors<1>::Zero(), Vectors<1>::Zero()};
    total += corner_energies<1>({energy.shape, 0, 2, 0, energy.eps}, {first.transpose(), second.transpose(), corner.normal.transpose()}, by);
    if (!(total < kInfinity)) return kInfinity;
    const Vec3 by_first = by[0].matrix().transpose() / corner.lengths[0], by_second = by[1].matrix().transpose() / corner.lengths[1];
    const std::array<Vec3, 3> slopes{-by_first - by_second, by_first, by_second};
    for (int k = 0; k < 3; ++k) {
      const int slot = node_slot_[corner.nodes[k]];
      if (slot >= 0) gradient[slot] += entities_.along(corner.nodes[k], slopes[k], steps[slot]);
    }
  }
  const int power = std::max(2, energy.power);
  for (const Turn& turn : turns) {
    const std::array<int, 2> slots{node_slot_[turn.nodes[0]], node_slot_[turn.nodes[1]]};
    if (slots[0] < 0 && slots[1] < 0) continue;
    double angle = turn.angle;
    for (int k = 0; k < 2; ++k) angle += turn.slopes[k].dot(points[turn.nodes[k]] - turn.places[k]);
    if (angle <= 0) continue;
    double slope = kFitTuning.turn_weight / kFitTuning.wide_turn;
    for (int k = 1; k < power; ++k) slope *= angle / kFitTuning.wide_turn;
    total += slope * angle;
    for (int k = 0; k < 2; ++k) {
      if (slots[k] >= 0) gradient[slots[k]] += power * slope * turn.slopes[k];
    }
  }
  return total;
}

DescentResult Descent::run(const Energy& energy, const std::vector<Vec3>& targets, const CellRegion& region, const std::vector<Turn>& turns,
                           const std::vector<SkinCorner>& skin, int max_iterations) {
  for (std::size_t i = 0; i < region.hexes.size(); ++i) slot_[region.hexes[i]] = static_cast<int>(i);
  corner_gradient_.resize(24 * region.hexes.size());
  const std::size_t count = region.nodes.size();
  for (std::size_t i = 0; i < count; ++i) node_slot_[region.nodes[i]] = static_cast<int>(i);
  std::vector<double> sizes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int v = region.nodes[i];
    double sum = 0;
    for (int k = graph_.first[v]; k < graph_.first[v + 1]; ++k) sum += std::cbrt(targets[graph_.corners[k] / 8].prod());
    sizes[i] = sum / std::max(1, graph_.first[v + 1] - graph_.first[v]);
  }
  const std::vector<Vec3> start = mesh_.points;
  std::vector<Vec3> gradient(count), trial_gradient(count), moved = mesh_.points, steps(count, Vec3::Zero()), trial_steps(count);
  DescentResult result;
  result.start_energy = result.energy = evaluate(energy, targets, region, turns, skin, mesh_.points, steps, gradient);
  History history(sizes, energy.gathered > 0 ? kFitTuning.long_memory : kFitTuning.memory, threads_);
  while (result.energy < kInfinity && result.iterations < max_iterations) {
    monitor_.check();
    std::vector<Vec3> direction = history.direction(gradient);
    const auto limit = [&] {
      for (std::size_t i = 0; i < count; ++i) {
        const double length = direction[i].norm(), longest = kFitTuning.longest_step * sizes[i];
        if (length > longest) direction[i] *= longest / length;
      }
    };
    limit();
    double slope = dot(direction, gradient, threads_);
    if (!(slope < 0)) {
      history.clear();
      direction = history.direction(gradient);
      limit();
      slope = dot(direction, gradient, threads_);
      if (!(slope < 0)) break;
    }
    double step = 1, value = kInfinity;
    for (int attempt = 0; attempt < 14; ++attempt, step /= 2) {
      for (std::size_t i = 0; i < count; ++i) {
        trial_steps[i] = steps[i] + step * direction[i];
        moved[region.nodes[i]] = start[region.nodes[i]] + entities_.bent(region.nodes[i], trial_steps[i]);
      }
      value = evaluate(energy, targets, region, turns, skin, moved, trial_steps, trial_gradient);
      if (value <= result.energy + 1e-4 * step * slope) break;
      value = kInfinity;
    }
    if (value == kInfinity) {
      if (history.empty()) break;
      history.clear();
      continue;
    }
    ++result.iterations;
    std::vector<Vec3> change(count);
    for (std::size_t i = 0; i < count; ++i) {
      const int v = region.nodes[i];
      mesh_.points[v] = moved[v];
      direction[i] *= step;
      change[i] = trial_gradient[i] - gradient[i];
    }
    gradient.swap(trial_gradient);
    steps.swap(trial_steps);
    history.add_pair(std::move(direction), std::move(change));
    const double gain = result.energy - value;
    result.energy = value;
    if (gain < 1e-6 * value) break;
    bool far = false;
    for (std::size_t i = 0; i < count && !far; ++i) far = entities_.turned(region.nodes[i], steps[i]) > kFitTuning.far_turn;
    if (far) break;
  }
  for (int h : region.hexes) slot_[h] = -1;
  for (int v : region.nodes) node_slot_[v] = -1;
  return result;
}

}  // namespace polycube
