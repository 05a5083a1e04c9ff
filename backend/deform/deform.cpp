#include "deform/deform.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/charts.h"
#include "core/error.h"
#include "deform/foldover.h"
#include "deform/system.h"

namespace polycube {
namespace {

Mat3 nearest_rotation(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

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
  for (const Tet& t : mesh.tets) elements.push_back(make_element(points, t));

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
      for (std::size_t t = 0; t < elements.size(); ++t) rotation[t] = nearest_rotation(jacobian(mesh.tets[t], elements[t], map.image));
      map.image = solve_all(mesh, elements, system, rotation);
    }
    if (pass == 1) {
      std::vector<Vec3> unfolded = map.image;
      const FoldoverReport folds = remove_foldovers(mesh, elements, system, unfolded, monitor);
      map.image = std::move(unfolded);
      monitor.log("deform: " + std::to_string(folds.flipped) + " folds and " + std::to_string(folds.collapsed) + " collapsed tets after " +
                  std::to_string(folds.iterations) + " steps");
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
      const Mat3 j = jacobian(mesh.tets[t], elements[t], map.image);
      if (j.determinant() <= 0) {
        ++report->flipped;
        report->flipped_tets.push_back(static_cast<int>(t));
      } else {
        report->worst_stretch = std::max(report->worst_stretch, Eigen::JacobiSVD<Mat3>(j).singularValues()[0]);
      }
    }
  }
  monitor.progress("deform", 1);
  return map;
}

}  // namespace polycube
