#include "deform/foldover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/parallel.h"
#include "deform/tuning.h"

namespace polycube {
namespace {

class Problem {
 public:
  Problem(const TetMesh& mesh, const std::vector<Element>& elements, const std::array<std::unique_ptr<Coordinate>, 3>& system, int threads)
      : mesh_(mesh), elements_(elements), system_(system), threads_(threads), open_(elements.size()) {
    for (int d = 0; d < 3; ++d) first_[d + 1] = first_[d] + system[d]->unknowns();
    // With arbitrary values for the unknowns a tet has volume, or it never has: one trial settles it.
    Vector trial(size());
    std::uint32_t state = 1;
    for (Eigen::Index i = 0; i < trial.size(); ++i) {
      state = state * 1664525u + 1013904223u;
      trial[i] = static_cast<double>(state >> 8) / (1 << 24);
    }
    const std::vector<Vec3> image = scatter(trial);
    for (std::size_t t = 0; t < elements.size(); ++t) {
      Mat3 edges;
      for (int k = 0; k < 3; ++k) edges.col(k) = image[mesh.tets[t][k + 1]] - image[mesh.tets[t][0]];
      open_[t] = std::abs(edges.determinant()) > 1e-9;
      collapsed_ += !open_[t];
    }
  }

  int size() const { return first_[3]; }
  int collapsed() const { return collapsed_; }
  Vector gather(const std::vector<Vec3>& image) const {
    Vector x(size());
    for (int i = 0; i < static_cast<int>(image.size()); ++i) {
      for (int d = 0; d < 3; ++d) x[first_[d] + system_[d]->unknown(i)] = image[i][d];
    }
    return x;
  }
  std::vector<Vec3> scatter(const Vector& x) const {
    std::vector<Vec3> image(mesh_.points.size());
    for (int i = 0; i < static_cast<int>(image.size()); ++i) {
      for (int d = 0; d < 3; ++d) image[i][d] = x[first_[d] + system_[d]->unknown(i)];
    }
    return image;
  }
  // Smallest determinant and number of tets without a positive one.
  std::pair<double, int> worst(const Vector& x) const {
    const std::vector<Vec3> image = scatter(x);
    std::vector<std::pair<double, int>> part(chunks(), {std::numeric_limits<double>::infinity(), 0});
    for_chunks(static_cast<int>(elements_.size()), kChunk, threads_, [&](int chunk, int first, int last) {
      auto& [least, flipped] = part[chunk];
      for (int t = first; t < last; ++t) {
        if (!open_[t]) continue;
        const double d = jacobian(mesh_.tets[t], elements_[t], image).determinant();
        least = std::min(least, d);
        flipped += d <= 0;
      }
    });
    std::pair<double, int> result = part.front();
    for (std::size_t c = 1; c < part.size(); ++c) {
      result.first = std::min(result.first, part[c].first);
      result.second += part[c].second;
    }
    return result;
  }

  double energy(const Vector& x, double epsilon, Vector* gradient) const {
    const std::vector<Vec3> image = scatter(x);
    std::vector<double> part(chunks(), 0);
    if (gradient) force_.resize(elements_.size());
    for_chunks(static_cast<int>(elements_.size()), kChunk, threads_, [&](int chunk, int first, int last) {
      for (int t = first; t < last; ++t) {
        if (open_[t]) part[chunk] += energy_of(t, image, epsilon, gradient ? &force_[t] : nullptr);
      }
    });
    double sum = 0;
    for (double p : part) sum += p;
    if (!gradient) return sum;
    gradient->setZero(size());
    for_chunks(3, 1, threads_, [&](int d, int, int) {
      const Coordinate& system = *system_[d];
      for (std::size_t t = 0; t < elements_.size(); ++t) {
        if (!open_[t]) continue;
        for (int a = 0; a < 4; ++a) (*gradient)[first_[d] + system.unknown(mesh_.tets[t][a])] += force_[t](d, a);
      }
      (*gradient)[first_[d]] = 0;
    });
    return sum;
  }

  Vector precondition(const Vector& g) const {
    Vector x(size());
    for_chunks(3, 1, threads_, [&](int d, int, int) {
      x.segment(first_[d], first_[d + 1] - first_[d]) = system_[d]->precondition(g.segment(first_[d], first_[d + 1] - first_[d]));
    });
    return x;
  }

 private:
  static constexpr int kChunk = 1024;
  std::size_t chunks() const { return elements_.size() / kChunk + 1; }

  double energy_of(int t, const std::vector<Vec3>& image, double epsilon, Eigen::Matrix<double, 3, 4>* force) const {
    const Mat3 j = jacobian(mesh_.tets[t], elements_[t], image);
    const double det = j.determinant(), root = std::sqrt(epsilon * epsilon + det * det);
    // For negative determinants the plain sum cancels.
    const double chi = det > 0 ? (det + root) / 2 : epsilon * epsilon / (2 * (root - det));
    const double cube_root = std::cbrt(chi), trace = j.squaredNorm(), power = 1 / (cube_root * cube_root);
    const double energy = elements_[t].volume * (trace * power + kDeformTuning.lambda * (det * det + 1) / chi);
    if (!force) return energy;
    const double slope = chi / root;  // d chi / d det
    Mat3 cofactor;
    cofactor.col(0) = j.col(1).cross(j.col(2));
    cofactor.col(1) = j.col(2).cross(j.col(0));
    cofactor.col(2) = j.col(0).cross(j.col(1));
    const double by_det = -2.0 / 3 * trace * power / chi * slope + kDeformTuning.lambda * (2 * det / chi - (det * det + 1) / (chi * chi) * slope);
    *force = elements_[t].volume * (2 * power * j + by_det * cofactor) * elements_[t].gradient;
    return energy;
  }

  const TetMesh& mesh_;
  const std::vector<Element>& elements_;
  const std::array<std::unique_ptr<Coordinate>, 3>& system_;
  int threads_;
  std::array<int, 4> first_{};
  std::vector<char> open_;
  int collapsed_ = 0;
  mutable std::vector<Eigen::Matrix<double, 3, 4>> force_;  // per tet, from one evaluation to the next
};

// L-BFGS with the inverse of the quadratic part as initial Hessian. That is linear: of the differences of gradients it is the difference of what it makes of
// the gradients, so that one application a step does. Returns the steps made.
int descend(const Problem& problem, Vector& x, double epsilon, int steps, const Monitor& monitor) {
  struct Pair {
    Vector s, y, inverse_y;  // the last: preconditioned
    double rho;
  };
  std::deque<Pair> memory;
  Vector g;
  double e = problem.energy(x, epsilon, &g);
  Vector inverse_g = problem.precondition(g);
  for (int step = 0; step < steps; ++step) {
    monitor.check();
    Vector q = g, r = inverse_g;
    std::vector<double> alpha(memory.size());
    for (std::size_t i = memory.size(); i-- > 0;) {
      alpha[i] = memory[i].rho * memory[i].s.dot(q);
      q -= alpha[i] * memory[i].y;
      r -= alpha[i] * memory[i].inverse_y;
    }
    if (!memory.empty()) {
      const Pair& last = memory.back();
      r *= 1 / (last.rho * last.y.dot(last.inverse_y));
    }
    for (std::size_t i = 0; i < memory.size(); ++i) r += memory[i].s * (alpha[i] - memory[i].rho * memory[i].y.dot(r));
    const double slope = -g.dot(r);
    if (!(slope < 0)) return step;
    double length = 1, next_e = 0;
    Vector next, next_g;
    for (int halving = 0;; ++halving) {
      next = x - length * r;
      next_e = problem.energy(next, epsilon, halving == 0 ? &next_g : nullptr);
      if (next_e <= e + 1e-4 * length * slope) break;
      if (halving == 20) return step;
      length *= 0.5;
    }
    if (length < 1) problem.energy(next, epsilon, &next_g);
    Vector next_inverse = problem.precondition(next_g);
    Pair pair{next - x, next_g - g, next_inverse - inverse_g, 0};
    const double curvature = pair.s.dot(pair.y);
    if (curvature > 1e-14 * pair.s.norm() * pair.y.norm()) {
      pair.rho = 1 / curvature;
      memory.push_back(std::move(pair));
      if (memory.size() > kDeformTuning.memory) memory.pop_front();
    }
    const double gain = (e - next_e) / std::abs(e);
    x = std::move(next);
    g = std::move(next_g);
    inverse_g = std::move(next_inverse);
    e = next_e;
    if (gain < 1e-5) return step + 1;
  }
  return steps;
}

}  // namespace

FoldoverReport remove_foldovers(const TetMesh& mesh, const std::vector<Element>& elements, const std::array<std::unique_ptr<Coordinate>, 3>& system,
                                std::vector<Vec3>& image, int threads, const Monitor& monitor) {
  const Problem problem(mesh, elements, system, threads);
  Vector x = problem.gather(image);
  FoldoverReport report;
  report.collapsed = problem.collapsed();
  int start = -1, idle = 0;
  double epsilon = kDeformTuning.widest / kDeformTuning.fall;
  Vector best = x;
  for (int outer = 0;; ++outer) {
    const auto [least, flipped] = problem.worst(x);
    if (start < 0) start = report.flipped = flipped;
    ++idle;
    if (flipped < report.flipped) {
      report.flipped = flipped;
      best = x;
      idle = 0;
    }
    // Charts that no map can realise make the optimisation run away.
    if (report.flipped == 0 || outer == kDeformTuning.outer || idle > kDeformTuning.patience || flipped > kDeformTuning.runaway * (start + 10)) break;
    epsilon = least > 0 ? 1e-3 : std::min({std::sqrt(1e-6 + 0.25 * least * least), kDeformTuning.widest, kDeformTuning.fall * epsilon});
    const int steps = descend(problem, x, epsilon, kDeformTuning.inner, monitor);
    if (steps == 0) break;
    report.iterations += steps;
  }
  x = std::move(best);
  image = problem.scatter(x);
  return report;
}

}  // namespace polycube
