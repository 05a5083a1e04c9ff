#include "deform/deform.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/charts.h"
#include "core/error.h"

namespace polycube {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(int a, int b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

// Gradients of the four hat functions of a tet (columns) and its volume.
struct Element {
  Eigen::Matrix<double, 3, 4> gradient;
  double volume;
};

Element element(const std::vector<Vec3>& p, const Tet& t) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = p[t[k + 1]] - p[t[0]];
  const double det = edges.determinant();
  const Mat3 inverse = edges.inverse();
  Element e;
  for (int k = 0; k < 3; ++k) e.gradient.col(k + 1) = inverse.row(k).transpose();
  e.gradient.col(0) = -e.gradient.rightCols<3>().rowwise().sum();
  e.volume = det / 6;
  return e;
}

Mat3 nearest_rotation(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

// The least squares problem of one coordinate, nodes of a chart sharing one unknown.
class Coordinate {
 public:
  Coordinate(const TetMesh& mesh, const std::vector<Element>& elements, UnionFind groups) : unknown_(mesh.points.size(), -1) {
    const int n = static_cast<int>(mesh.points.size());
    for (int i = 0; i < n; ++i) {
      if (groups.find(i) == i) unknown_[i] = count_++;
    }
    for (int i = 0; i < n; ++i) unknown_[i] = unknown_[groups.find(i)];
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(elements.size() * 16);
    for (std::size_t t = 0; t < elements.size(); ++t) {
      const Eigen::Matrix4d k = elements[t].volume * elements[t].gradient.transpose() * elements[t].gradient;
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) {
          const int i = unknown_[mesh.tets[t][a]], j = unknown_[mesh.tets[t][b]];
          // Unknown 0 is held at zero: a coordinate is known up to a constant.
          if (i > 0 && j > 0 && i >= j) entries.emplace_back(i - 1, j - 1, k(a, b));
        }
      }
    }
    if (count_ < 2) return;
    Sparse matrix(count_ - 1, count_ - 1);
    matrix.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(matrix);
    ok_ = solver_.info() == Eigen::Success;
  }

  bool ok() const { return ok_; }

  // target: per tet the wished gradient of this coordinate.
  Vector solve(const TetMesh& mesh, const std::vector<Element>& elements, const std::vector<Vec3>& target) const {
    Vector rhs = Vector::Zero(count_);
    for (std::size_t t = 0; t < elements.size(); ++t) {
      const Eigen::Vector4d b = elements[t].volume * elements[t].gradient.transpose() * target[t];
      for (int a = 0; a < 4; ++a) rhs[unknown_[mesh.tets[t][a]]] += b[a];
    }
    const Vector x = solver_.solve(rhs.tail(count_ - 1));
    Vector result(static_cast<Eigen::Index>(unknown_.size()));
    for (std::size_t i = 0; i < unknown_.size(); ++i) result[static_cast<Eigen::Index>(i)] = unknown_[i] == 0 ? 0.0 : x[unknown_[i] - 1];
    return result;
  }

 private:
  std::vector<int> unknown_;
  int count_ = 0;
  bool ok_ = false;
  Eigen::SimplicialLDLT<Sparse> solver_;
};

std::vector<Vec3> solve_all(const TetMesh& mesh, const std::vector<Element>& elements, const std::array<std::unique_ptr<Coordinate>, 3>& system,
                            const std::vector<Mat3>& rotation) {
  std::vector<Vec3> image(mesh.points.size());
  std::vector<Vec3> target(elements.size());
  for (int d = 0; d < 3; ++d) {
    for (std::size_t t = 0; t < elements.size(); ++t) target[t] = rotation[t].row(d).transpose();
    const Vector x = system[d]->solve(mesh, elements, target);
    for (std::size_t i = 0; i < image.size(); ++i) image[i][d] = x[static_cast<Eigen::Index>(i)];
  }
  return image;
}

Mat3 gradient(const TetMesh& mesh, const Element& e, const std::vector<Vec3>& image, std::size_t t) {
  Mat3 j = Mat3::Zero();
  for (int a = 0; a < 4; ++a) j += image[mesh.tets[t][a]] * e.gradient.col(a).transpose();
  return j;
}

}  // namespace

PolycuboidMap deform(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels, const std::vector<Chart>& features,
                     const DeformOptions& options, const Monitor& monitor, DeformReport* report) {
  PolycuboidMap map;
  map.charts = find_charts(mesh.triangles, labels);
  map.charts.insert(map.charts.end(), features.begin(), features.end());

  std::vector<Vec3> points(mesh.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = frame * mesh.points[i];
  std::vector<Element> elements;
  elements.reserve(mesh.tets.size());
  for (const Tet& t : mesh.tets) elements.push_back(element(points, t));

  std::array<UnionFind, 3> groups{UnionFind(points.size()), UnionFind(points.size()), UnionFind(points.size())};
  for (const Chart& c : map.charts) {
    for (int n : c.nodes) groups[c.axis].unite(c.nodes.front(), n);
  }
  // Twice: the second time with charts that came out on one plane up to noise put on it for good, so that their order is no accident.
  for (int pass = 0; pass < 2; ++pass) {
    std::array<std::unique_ptr<Coordinate>, 3> system;
    for (int d = 0; d < 3; ++d) {
      monitor.progress("deform", (3.0 * pass + d) / 8);
      system[d] = std::make_unique<Coordinate>(mesh, elements, groups[d]);
      if (!system[d]->ok()) throw StageFailed("deform", std::string("the charts leave no room along ") + "xyz"[d]);
    }
    std::vector<Mat3> rotation(elements.size(), Mat3::Identity());
    map.image = solve_all(mesh, elements, system, rotation);
    const int rounds = pass == 0 ? std::min(options.rotations, 4) : options.rotations;
    for (int round = 0; round < rounds; ++round) {
      monitor.check();
      for (std::size_t t = 0; t < elements.size(); ++t) rotation[t] = nearest_rotation(gradient(mesh, elements[t], map.image, t));
      map.image = solve_all(mesh, elements, system, rotation);
    }
    for (Chart& c : map.charts) c.value = map.image[c.nodes.front()][c.axis];
    if (pass == 1) break;
    for (int d = 0; d < 3; ++d) {
      std::vector<const Chart*> order;
      for (const Chart& c : map.charts) {
        if (c.axis == d) order.push_back(&c);
      }
      std::stable_sort(order.begin(), order.end(), [](const Chart* a, const Chart* b) { return a->value < b->value; });
      double start = order.empty() ? 0 : order.front()->value;
      for (std::size_t i = 1; i < order.size(); ++i) {
        if (order[i]->value - start < options.merge) {
          groups[d].unite(order[i - 1]->nodes.front(), order[i]->nodes.front());
        } else {
          start = order[i]->value;
        }
      }
    }
  }
  if (report) {
    *report = {};
    for (std::size_t t = 0; t < elements.size(); ++t) {
      const Mat3 j = gradient(mesh, elements[t], map.image, t);
      if (j.determinant() <= 0) {
        ++report->flipped;
      } else {
        report->worst_stretch = std::max(report->worst_stretch, Eigen::JacobiSVD<Mat3>(j).singularValues()[0]);
      }
    }
  }
  monitor.progress("deform", 1);
  return map;
}

}  // namespace polycube
