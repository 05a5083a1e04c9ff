#include <algorithm>
#include <map>

#include "cad/conformal.h"
#include "core/sorted.h"
#include "pipeline/conform_labels.h"
#include "pipeline/label_part.h"
#include "pipeline/part_mesh.h"
#include "tet/classify.h"

namespace polycube {
namespace {

/// Joins what is seen of each solid, by the numbers of the assembly.
class Seen {
 public:
  Seen(const ConformalModel& model, const ConformalLabels& labels, const std::vector<char>& left_out, const Monitor& monitor)
      : model_(model), labels_(labels), left_out_(left_out), monitor_(monitor) {
    for (std::size_t t = 0; t < labels.mesh.triangles.size(); ++t) label_at_[sorted(labels.mesh.triangles[t])] = labels.labelling.label[t];
    for (std::size_t t = 0; t < labels.mesh.inner_triangles.size(); ++t) label_at_[sorted(labels.mesh.inner_triangles[t])] = labels.inner_label[t];
  }

  void add(int s, LabelledPart& part) const {
    std::vector<int> points;
    const TetMesh own = tets_of_solid(labels_.mesh, s, &points);
    const Origin& origin = model_.origins[static_cast<std::size_t>(s)];
    const int first = static_cast<int>(part.tets.points.size());
    Labelling labelling{labels_.labelling.frame, {}};
    for (std::size_t t = 0; t < own.triangles.size(); ++t) {
      Triangle whole = own.triangles[t];
      for (int& p : whole) p = points[p];
      labelling.label.push_back(label_at_.at(sorted(whole)) ^ (seen_from_other_side(s, own.triangle_face[t]) ? 1 : 0));
      part.tets.triangle_face.push_back(origin.faces[static_cast<std::size_t>(own.triangle_face[t])]);
    }
    part.tets.points.insert(part.tets.points.end(), own.points.begin(), own.points.end());
    part.tets.point_cad.insert(part.tets.point_cad.end(), own.point_cad.begin(), own.point_cad.end());
    append(part.tets.tets, own.tets, first);
    append(part.tets.triangles, own.triangles, first);
    part.labelling.label.insert(part.labelling.label.end(), labelling.label.begin(), labelling.label.end());
    for (std::size_t i = 0; i < own.segments.size(); ++i) {
      const int edge = origin.edges[static_cast<std::size_t>(own.segment_edge[i])];
      if (edge == 0) continue;
      append(part.tets.segments, {own.segments[i]}, first);
      part.tets.segment_edge.push_back(edge);
    }
    add_features(find_features(model_.solids[static_cast<std::size_t>(s)], own, labelling, left_out_, monitor_), origin, first, part.features);
  }

 private:
  template <class Row>
  static void append(std::vector<Row>& rows, const std::vector<Row>& more, int first) {
    for (Row row : more) {
      for (int& p : row) p += first;
      rows.push_back(row);
    }
  }

  /// An edge of several pieces, or of several solids, is captured as far as all of it is.
  static void add_features(const Features& found, const Origin& origin, int first, Features& all) {
    for (FeatureEdge e : found.edges) {
      e.edge = origin.edges[static_cast<std::size_t>(e.edge)];
      if (e.edge == 0) continue;
      const auto known = std::find_if(all.edges.begin(), all.edges.end(), [&](const FeatureEdge& other) { return other.edge == e.edge; });
      if (known == all.edges.end()) {
        all.edges.push_back(e);
      } else if (e.capture > known->capture) {
        *known = e;
      }
    }
    for (FeatureChart f : found.charts) {
      f.edge = origin.edges[static_cast<std::size_t>(f.edge)];
      if (f.edge == 0) continue;
      for (int& node : f.chart.nodes) node += first;
      all.charts.push_back(std::move(f));
    }
  }

  bool seen_from_other_side(int s, int face) const {
    return std::any_of(model_.interfaces.begin(), model_.interfaces.end(), [&](const auto& i) { return i.first == face && i.second[1] == s; });
  }

  const ConformalModel& model_;
  const ConformalLabels& labels_;
  const std::vector<char>& left_out_;
  const Monitor& monitor_;
  std::map<Triangle, int> label_at_;
};

}  // namespace

LabelledPart labelled_solids(const ConformalModel& model, const ConformalLabels& labels, const std::vector<char>& left_out, const Monitor& monitor) {
  LabelledPart part;
  part.labelling.frame = labels.labelling.frame;
  const Seen seen(model, labels, left_out, monitor);
  for (int s = 0; s < static_cast<int>(model.solids.size()); ++s) seen.add(s, part);
  part.failure = StageFailed("deform", "of several solids the labels are shown without a map");
  return part;
}

LabelledPart label_part(const Assembly& assembly, const MeshOptions& options, const Monitor& monitor, Until until) {
  // Of one solid no more is made than is looked at: a session would go on to blocks.
  if (assembly.solids.size() == 1) return label_part(assembly.solids.front(), options, monitor, until);
  return AssemblySession(assembly, options).labels(options, monitor, until);
}

}  // namespace polycube
