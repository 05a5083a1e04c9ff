#include "label/strays.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "core/charts.h"
#include "label/straighten.h"
#include "label/tuning.h"
#include "label/validity.h"

namespace polycube {
namespace {

class Strays {
 public:
  Strays(const TetMesh& mesh, Labelling& labelling, const Monitor& monitor)
      : mesh_(mesh), frame_(labelling.frame), labels_(labelling.label), monitor_(monitor), neighbours_(triangle_neighbours(mesh.triangles)) {
    for (const Vec3& p : mesh.points) points_.push_back(labelling.frame * p);
    for (const Triangle& t : mesh.triangles) {
      edge_ += (points_[t[0]] - points_[t[1]]).norm() / static_cast<double>(mesh.triangles.size());
      area_.push_back((points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).norm() / 2);
    }
    for (std::size_t t = 0; t < area_.size(); ++t) face_area_[mesh.triangle_face[t]] += area_[t];
  }

  int run() {
    int absorbed = 0;
    double score = violations();
    // One at a time: what goes can make its neighbour whole.
    for (bool changed = true; changed;) {
      changed = false;
      for (const Chart& chart : find_charts(mesh_.triangles, labels_)) {
        if (!stray(chart)) continue;
        monitor_.check();
        const std::vector<int> before = labels_;
        const int label = best_neighbour(chart);
        for (int t : chart.triangles) labels_[t] = label;
        const double now = violations();
        if (now > score) {
          labels_ = before;
          continue;
        }
        score = now;
        ++absorbed;
        changed = true;
        break;
      }
    }
    return absorbed;
  }

 private:
  bool stray(const Chart& chart) const {
    const int face = mesh_.triangle_face[chart.triangles.front()];
    double area = 0;
    for (int t : chart.triangles) {
      if (mesh_.triangle_face[t] != face) return false;
      area += area_[t];
    }
    const double whole = face_area_.at(face);
    if (area > 0.5 * whole) return false;
    return std::ssize(chart.triangles) <= kLabelTuning.stray_triangles ||
           area < std::min(kLabelTuning.stray_area * edge_ * edge_, kLabelTuning.stray_share * whole);
  }

  // By length of border, inside the CAD face if there is any.
  int best_neighbour(const Chart& chart) const {
    std::map<int, double> inside, any;
    for (int t : chart.triangles) {
      for (int k = 0; k < 3; ++k) {
        const int n = neighbours_[t][k];
        if (n < 0 || labels_[n] == labels_[t]) continue;
        const double length = (points_[mesh_.triangles[t][k]] - points_[mesh_.triangles[t][(k + 1) % 3]]).norm();
        any[labels_[n]] += length;
        if (mesh_.triangle_face[n] == mesh_.triangle_face[t]) inside[labels_[n]] += length;
      }
    }
    const auto& border = inside.empty() ? any : inside;
    return std::max_element(border.begin(), border.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
  }

  double violations() const { return find_violations(mesh_, frame_, labels_).score; }

  const TetMesh& mesh_;
  const Mat3& frame_;
  std::vector<int>& labels_;
  const Monitor& monitor_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Vec3> points_;  // in the frame
  std::vector<double> area_;
  std::map<int, double> face_area_;
  double edge_ = 0;
};

}  // namespace

int absorb_strays(TetMesh& mesh, Labelling& labelling, const Monitor& monitor) {
  const int absorbed = Strays(mesh, labelling, monitor).run();
  if (absorbed > 0) {
    split_tied_edges(mesh, labelling.label, monitor);
    monitor.log("label: " + std::to_string(absorbed) + " stray charts absorbed");
  }
  return absorbed;
}

}  // namespace polycube
