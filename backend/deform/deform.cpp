#include "deform/deform.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/charts.h"
#include "core/error.h"
#include "core/parallel.h"
#include "deform/foldover.h"
#include "deform/system.h"
#include "deform/tuning.h"

namespace polycube {
namespace {

Mat3 rotation_by_svd(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

// Newton's iteration for the polar factor with Higham's scaling (1986) by the determinant; where m is nearly flat or turned over it would not get there.
Mat3 nearest_rotation(const Mat3& m) {
  Mat3 r = m;
  for (int step = 0; step < 12; ++step) {
    Mat3 cofactor;
    cofactor.col(0) = r.col(1).cross(r.col(2));
    cofactor.col(1) = r.col(2).cross(r.col(0));
    cofactor.col(2) = r.col(0).cross(r.col(1));
    const double det = r.col(0).dot(cofactor.col(0)), size = r.squaredNorm();
    if (!(det * det > 1e-6 * size * size * size)) break;
    const double scale = step < 2 ? 1 / std::cbrt(det) : 1;
    const Mat3 next = 0.5 * (scale * r + cofactor / (scale * det));
    const double change = (next - r).squaredNorm();
    r = next;
    if (change < 1e-18) return r;  // the error after the step is the square of the change
  }
  return rotation_by_svd(m);
}

// Local/global solver of the map (as rigid as possible); the image goes on from round to round.
class Solver {
 public:
  Solver(const TetMesh& mesh, const std::vector<Element>& elements, int threads)
      : mesh_(mesh), elements_(elements), threads_(threads), rotation_(elements.size(), Mat3::Identity()), image_(mesh.points.size(), Vec3::Zero()) {}

  /// Sets up the systems of the dimensions in `which`.
  void set_up(const std::array<UnionFind, 3>& groups, const std::vector<int>& which) {
    for_chunks(static_cast<int>(which.size()), 1, threads_,
               [&](int i, int, int) { system_[which[i]] = std::make_unique<Coordinate>(mesh_, elements_, groups[which[i]]); });
    for (int d : which) {
      if (!system_[d]->ok()) throw StageFailed("deform", std::string("the charts leave no room along ") + "xyz"[d]);
    }
  }
  void start() {
    std::fill(rotation_.begin(), rotation_.end(), Mat3::Identity());
    solve();
  }
  void round() {
    for_chunks(static_cast<int>(elements_.size()), 1024, threads_, [&](int, int first, int last) {
      for (int t = first; t < last; ++t) rotation_[t] = nearest_rotation(jacobian(mesh_.tets[t], elements_[t], image_));
    });
    solve();
  }
  const std::array<std::unique_ptr<Coordinate>, 3>& systems() const { return system_; }
  std::vector<Vec3>& image() { return image_; }

 private:
  void solve() {
    for_chunks(3, 1, threads_, [&](int d, int, int) {
      Vector guess(static_cast<Eigen::Index>(image_.size()));
      for (std::size_t i = 0; i < image_.size(); ++i) guess[static_cast<Eigen::Index>(i)] = image_[i][d];
      const Vector x = system_[d]->solve(mesh_, elements_, rotation_, d, guess);
      for (std::size_t i = 0; i < image_.size(); ++i) image_[i][d] = x[static_cast<Eigen::Index>(i)];
    });
  }

  const TetMesh& mesh_;
  const std::vector<Element>& elements_;
  int threads_;
  std::array<std::unique_ptr<Coordinate>, 3> system_;
  std::vector<Mat3> rotation_;
  std::vector<Vec3> image_;
};

// Charts of one axis whose values differ by less than `merge` become one group. True where some did.
bool merge_charts(const std::vector<Chart>& charts, int axis, double merge, UnionFind& groups) {
  std::vector<const Chart*> order;
  for (const Chart& c : charts) {
    if (c.axis == axis) order.push_back(&c);
  }
  std::stable_sort(order.begin(), order.end(), [](const Chart* a, const Chart* b) { return a->value < b->value; });
  double start = order.empty() ? 0 : order.front()->value;
  bool merged = false;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i]->value - start < merge) {
      const int a = order[i - 1]->nodes.front(), b = order[i]->nodes.front();
      merged = merged || groups.find(a) != groups.find(b);
      groups.unite(a, b);
    } else {
      start = order[i]->value;
    }
  }
  return merged;
}

}  // namespace

PolycuboidMap deform(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels, const std::vector<Chart>& features, const DeformOptions& options,
                     const Monitor& monitor, DeformReport* report) {
  PolycuboidMap map;
  map.charts = find_charts(mesh.triangles, labels);
  map.charts.insert(map.charts.end(), features.begin(), features.end());

  std::vector<Vec3> points(mesh.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = frame * mesh.points[i];
  std::vector<Element> elements;
  elements.reserve(mesh.tets.size());
  for (const Tet& t : mesh.tets) elements.push_back(make_element(points, t));

  std::array<UnionFind, 3> groups{UnionFind(points.size()), UnionFind(points.size()), UnionFind(points.size())};
  for (const Chart& c : map.charts) {
    for (int n : c.nodes) groups[c.axis].unite(c.nodes.front(), n);
  }
  Solver solver(mesh, elements, options.threads);
  const auto rounds = [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      monitor.check();
      solver.round();
    }
  };
  monitor.progress("deform", 0);
  solver.set_up(groups, {0, 1, 2});
  solver.start();
  const int trial = std::min(options.rotations, kDeformTuning.trial_rounds);
  rounds(0, trial);
  for (Chart& c : map.charts) c.value = solver.image()[c.nodes.front()][c.axis];
  // Charts that came out on one plane up to noise are put on it for good, so that their order is no accident.
  std::vector<int> changed;
  for (int d = 0; d < 3; ++d) {
    if (merge_charts(map.charts, d, options.merge, groups[d])) changed.push_back(d);
  }
  monitor.progress("deform", 0.4);
  if (!changed.empty()) {
    solver.set_up(groups, changed);
    solver.start();
  }
  rounds(changed.empty() ? trial : 0, options.rotations);
  map.image = std::move(solver.image());
  const FoldoverReport folds = remove_foldovers(mesh, elements, solver.systems(), map.image, options.threads, monitor);
  monitor.log("deform: " + std::to_string(folds.flipped) + " folds and " + std::to_string(folds.collapsed) + " collapsed tets after " +
              std::to_string(folds.iterations) + " steps");
  for (Chart& c : map.charts) c.value = map.image[c.nodes.front()][c.axis];
  if (report) {
    *report = {};
    double volume = 0;
    for (std::size_t t = 0; t < elements.size(); ++t) {
      const Mat3 j = jacobian(mesh.tets[t], elements[t], map.image);
      const double det = j.determinant();
      if (det <= 0) {
        ++report->flipped;
        report->flipped_tets.push_back(static_cast<int>(t));
      } else {
        report->distortion += elements[t].volume * (j.squaredNorm() / (3 * std::cbrt(det * det)) - 1);
        volume += elements[t].volume;
      }
    }
    if (volume > 0) report->distortion /= volume;
  }
  monitor.progress("deform", 1);
  return map;
}

}  // namespace polycube
