#include "deform/foldover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>

namespace polycube {
namespace {

constexpr double kLambda = 0.5;      // weight of keeping volume against keeping angles
constexpr int kOuter = 12;           // epsilon updates
constexpr int kInner = 25;           // L-BFGS steps between them
constexpr int kPatience = 6;         // updates without fewer flips before it ends
constexpr int kRunaway = 60;         // times the flips at the start: it has run away
// Largest epsilon. A tet without size costs 2 lambda / epsilon, a good one 3 + 2 lambda: at 0.25 shrinking the part to a point pays.
constexpr double kWidest = 0.1;
constexpr double kFall = 0.6;        // of epsilon from one update to the next, at least
constexpr std::size_t kMemory = 6;

class Problem {
 public:
  Problem(const TetMesh& mesh, const std::vector<Element>& elements, const std::array<std::unique_ptr<Coordinate>, 3>& system)
      : mesh_(mesh), elements_(elements), system_(system), open_(elements.size()) {
    for (int d = 0; d < 3; ++d) first_[d + 1] = first_[d] + system[d]->unknowns();
    // With arbitrary values for the unknowns a tet has volume, or it never has: one trial settles it.
    Vector trial(size());
    std::uint32_t state = 1;
    for (Eigen::Index i = 0; i < trial.size(); ++i) {
      state = state * 1664525u + 1013904223u;
      trial[i] = static_cast<double>(state >> 8) / (1 << 24);
    }
    for (std::size_t t = 0; t < elements.size(); ++t) {
      Mat3 edges;
      for (int k = 0; k < 3; ++k) edges.col(k) = at(trial, mesh.tets[t][k + 1]) - at(trial, mesh.tets[t][0]);
      open_[t] = std::abs(edges.determinant()) > 1e-9;
      collapsed_ += !open_[t];
    }
  }

  int size() const { return first_[3]; }
  int collapsed() const { return collapsed_; }
  Vec3 at(const Vector& x, int node) const {
    return {x[first_[0] + system_[0]->unknown(node)], x[first_[1] + system_[1]->unknown(node)], x[first_[2] + system_[2]->unknown(node)]};
  }
  Vector gather(const std::vector<Vec3>& image) const {
    Vector x(size());
    for (int i = 0; i < static_cast<int>(image.size()); ++i) {
      for (int d = 0; d < 3; ++d) x[first_[d] + system_[d]->unknown(i)] = image[i][d];
    }
    return x;
  }
  std::vector<Vec3> scatter(const Vector& x) const {
    std::vector<Vec3> image(mesh_.points.size());
    for (int i = 0; i < static_cast<int>(image.size()); ++i) image[i] = at(x, i);
    return image;
  }
  Mat3 gradient_of(const Vector& x, std::size_t t) const {
    Mat3 j = Mat3::Zero();
    for (int a = 0; a < 4; ++a) j += at(x, mesh_.tets[t][a]) * elements_[t].gradient.col(a).transpose();
    return j;
  }
  // Smallest determinant and number of tets without a positive one.
  std::pair<double, int> worst(const Vector& x) const {
    double least = std::numeric_limits<double>::infinity();
    int flipped = 0;
    for (std::size_t t = 0; t < elements_.size(); ++t) {
      if (!open_[t]) continue;
      const double d = gradient_of(x, t).determinant();
      least = std::min(least, d);
      flipped += d <= 0;
    }
    return {least, flipped};
  }

  double energy(const Vector& x, double epsilon, Vector* gradient) const {
    double sum = 0;
    if (gradient) *gradient = Vector::Zero(size());
    for (std::size_t t = 0; t < elements_.size(); ++t) {
      if (!open_[t]) continue;
      const Mat3 j = gradient_of(x, t);
      const double det = j.determinant(), root = std::sqrt(epsilon * epsilon + det * det);
      // For negative determinants the plain sum cancels.
      const double chi = det > 0 ? (det + root) / 2 : epsilon * epsilon / (2 * (root - det));
      const double trace = j.squaredNorm(), power = std::pow(chi, -2.0 / 3);
      sum += elements_[t].volume * (trace * power + kLambda * (det * det + 1) / chi);
      if (!gradient) continue;
      const double slope = chi / root;  // d chi / d det
      Mat3 cofactor;
      cofactor.col(0) = j.col(1).cross(j.col(2));
      cofactor.col(1) = j.col(2).cross(j.col(0));
      cofactor.col(2) = j.col(0).cross(j.col(1));
      const double by_det = -2.0 / 3 * trace * power / chi * slope + kLambda * (2 * det / chi - (det * det + 1) / (chi * chi) * slope);
      const Eigen::Matrix<double, 3, 4> force = elements_[t].volume * (2 * power * j + by_det * cofactor) * elements_[t].gradient;
      for (int a = 0; a < 4; ++a) {
        for (int d = 0; d < 3; ++d) (*gradient)[first_[d] + system_[d]->unknown(mesh_.tets[t][a])] += force(d, a);
      }
    }
    if (gradient) {
      for (int d = 0; d < 3; ++d) (*gradient)[first_[d]] = 0;
    }
    return sum;
  }

  Vector precondition(const Vector& g) const {
    Vector x(size());
    for (int d = 0; d < 3; ++d) x.segment(first_[d], first_[d + 1] - first_[d]) = system_[d]->precondition(g.segment(first_[d], first_[d + 1] - first_[d]));
    return x;
  }

 private:
  const TetMesh& mesh_;
  const std::vector<Element>& elements_;
  const std::array<std::unique_ptr<Coordinate>, 3>& system_;
  std::array<int, 4> first_{};
  std::vector<char> open_;
  int collapsed_ = 0;
};

// L-BFGS with the inverse of the quadratic part as initial Hessian. Returns the steps made.
int descend(const Problem& problem, Vector& x, double epsilon, int steps, const Monitor& monitor) {
  struct Pair {
    Vector s, y;
    double rho;
  };
  std::deque<Pair> memory;
  Vector g;
  double e = problem.energy(x, epsilon, &g);
  for (int step = 0; step < steps; ++step) {
    monitor.check();
    Vector q = g;
    std::vector<double> alpha(memory.size());
    for (std::size_t i = memory.size(); i-- > 0;) {
      alpha[i] = memory[i].rho * memory[i].s.dot(q);
      q -= alpha[i] * memory[i].y;
    }
    Vector r = problem.precondition(q);
    if (!memory.empty()) {
      const Pair& last = memory.back();
      r *= 1 / (last.rho * last.y.dot(problem.precondition(last.y)));
    }
    for (std::size_t i = 0; i < memory.size(); ++i) r += memory[i].s * (alpha[i] - memory[i].rho * memory[i].y.dot(r));
    const double slope = -g.dot(r);
    if (!(slope < 0)) return step;
    double length = 1, next_e = 0;
    Vector next, next_g;
    for (int halving = 0;; ++halving) {
      next = x - length * r;
      next_e = problem.energy(next, epsilon, nullptr);
      if (next_e <= e + 1e-4 * length * slope) break;
      if (halving == 20) return step;
      length *= 0.5;
    }
    problem.energy(next, epsilon, &next_g);
    Pair pair{next - x, next_g - g, 0};
    const double curvature = pair.s.dot(pair.y);
    if (curvature > 1e-14 * pair.s.norm() * pair.y.norm()) {
      pair.rho = 1 / curvature;
      memory.push_back(std::move(pair));
      if (memory.size() > kMemory) memory.pop_front();
    }
    const double gain = (e - next_e) / std::abs(e);
    x = std::move(next);
    g = std::move(next_g);
    e = next_e;
    if (gain < 1e-5) return step + 1;
  }
  return steps;
}

}  // namespace

FoldoverReport remove_foldovers(const TetMesh& mesh, const std::vector<Element>& elements, const std::array<std::unique_ptr<Coordinate>, 3>& system,
                                std::vector<Vec3>& image, const Monitor& monitor) {
  const Problem problem(mesh, elements, system);
  Vector x = problem.gather(image);
  FoldoverReport report;
  report.collapsed = problem.collapsed();
  int start = -1, idle = 0;
  double epsilon = kWidest / kFall;
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
    if (report.flipped == 0 || outer == kOuter || idle > kPatience || flipped > kRunaway * (start + 10)) break;
    epsilon = least > 0 ? 1e-3 : std::min({std::sqrt(1e-6 + 0.25 * least * least), kWidest, kFall * epsilon});
    const int steps = descend(problem, x, epsilon, kInner, monitor);
    if (steps == 0) break;
    report.iterations += steps;
  }
  x = std::move(best);
  image = problem.scatter(x);
  return report;
}

}  // namespace polycube
