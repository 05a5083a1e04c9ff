#include "pipeline/label_part.h"

#include <algorithm>
#include <fstream>
#include <numbers>

#include "core/charts.h"
#include "core/error.h"
#include "pipeline/pose.h"
#include "pipeline/realise.h"
#include "tet/tet.h"

namespace polycube {
namespace {

// The image needs enough tets to bend; more than that costs time and brings nothing, the hexahedra need not be as fine.
double tet_size(double size, double diagonal) { return std::clamp(size, diagonal / 50, diagonal / 28); }

struct Line {
  Segment nodes;
  int kind;  // 0 chart boundary, 1 + axis: feature chart
};

std::vector<Line> lines(const LabelledPart& part) {
  std::vector<Line> result;
  const auto neighbours = triangle_neighbours(part.tets.triangles);
  for (int t = 0; t < static_cast<int>(neighbours.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int n = neighbours[t][k];
      if (n > t && part.labelling.label[n] != part.labelling.label[t]) result.push_back({{part.tets.triangles[t][k], part.tets.triangles[t][(k + 1) % 3]}, 0});
    }
  }
  for (const auto& [edge, c] : part.features.charts) {
    for (const Segment& s : part.tets.segments) {
      const auto on = [&](int n) { return std::binary_search(c.nodes.begin(), c.nodes.end(), n); };
      if (on(s[0]) && on(s[1])) result.push_back({s, 1 + c.axis});
    }
  }
  return result;
}

}  // namespace

LabelledPart label_part(const CadModel& model, const MeshOptions& given, const Monitor& monitor) {
  LabelledPart part;
  auto start = Monitor::Clock::now();
  const auto book = [&](const std::string& name) {
    const auto now = Monitor::Clock::now();
    part.stages.push_back({name, std::chrono::duration<double>(now - start).count()});
    start = now;
  };
  const Pose pose = canonical_pose(model, given.frame);
  const MeshOptions options = pose.posed(given);
  const double size = effective_size(options, pose.model.diagonal());
  TetOptions tet;
  tet.size = tet_size(size, pose.model.diagonal());
  part.tets = tetrahedralise(pose.model, tet, monitor);
  pose.check_labels(part.tets, options.labels);
  book("tet");
  LabelOptions label_options;
  label_options.fidelity = options.fidelity;
  label_options.compactness = options.compactness;
  label_options.face_labels = options.labels;
  label_options.frame_given = true;
  label_options.frame = pose.frame;
  part.labelling = label(pose.model, part.tets, label_options, monitor, &part.label_report);
  part.features = find_features(pose.model, part.tets, part.labelling, options.feature_angle * std::numbers::pi / 180, monitor);
  book("label");
  DeformOptions deform_options;
  deform_options.merge = 0.02 * size;
  RealisedMap realised = realise(pose.model, part.tets, part.labelling, part.features, deform_options, monitor);
  part.map = std::move(realised.map);
  part.flipped = realised.report.flipped;
  book("deform");
  for (Vec3& p : part.tets.points) p = pose.back(p);
  part.labelling.frame = pose.user_frame;
  for (int& l : part.labelling.label) l = pose.user_label(l);
  for (FeatureChart& f : part.features.charts) pose.map_back(f.chart);
  for (Vec3& p : part.map.image) p = pose.map_back(p);
  for (Chart& c : part.map.charts) pose.map_back(c);
  return part;
}

void write_vtu(const std::string& path, const LabelledPart& part) {
  std::ofstream out(path);
  out.precision(9);
  const auto& triangles = part.tets.triangles;
  const std::vector<Line> edges = lines(part);
  std::vector<int> chart(triangles.size(), -1);
  for (int c = 0; c < static_cast<int>(part.map.charts.size()); ++c) {
    for (int t : part.map.charts[c].triangles) chart[t] = c;
  }
  const auto array = [&](const std::string& type, const std::string& name, int components, const auto& write) {
    out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components << "\" format=\"ascii\">\n";
    write();
    out << "</DataArray>\n";
  };
  const auto each_cell = [&](const auto& of_triangle, const auto& of_line) {
    for (std::size_t t = 0; t < triangles.size(); ++t) out << of_triangle(t) << '\n';
    for (const Line& l : edges) out << of_line(l) << '\n';
  };
  out << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n<Piece NumberOfPoints=\""
      << part.tets.points.size() << "\" NumberOfCells=\"" << triangles.size() + edges.size() << "\">\n<PointData>\n";
  array("Float64", "image", 3, [&] {
    for (const Vec3& p : part.map.image) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  });
  out << "</PointData>\n<CellData>\n";
  array("Int32", "label", 1, [&] { each_cell([&](std::size_t t) { return part.labelling.label[t]; }, [](const Line& l) { return -1 - l.kind; }); });
  array("Int32", "chart", 1, [&] { each_cell([&](std::size_t t) { return chart[t]; }, [](const Line&) { return -1; }); });
  array("Int32", "face", 1, [&] { each_cell([&](std::size_t t) { return part.tets.triangle_face[t]; }, [](const Line&) { return 0; }); });
  out << "</CellData>\n<Points>\n";
  array("Float64", "Points", 3, [&] {
    for (const Vec3& p : part.tets.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  });
  out << "</Points>\n<Cells>\n";
  array("Int32", "connectivity", 1, [&] {
    for (const Triangle& t : triangles) out << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    for (const Line& l : edges) out << l.nodes[0] << ' ' << l.nodes[1] << '\n';
  });
  array("Int32", "offsets", 1, [&] {
    std::size_t at = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) out << (at += 3) << '\n';
    for (std::size_t l = 0; l < edges.size(); ++l) out << (at += 2) << '\n';
  });
  array("UInt8", "types", 1, [&] { each_cell([](std::size_t) { return 5; }, [](const Line&) { return 3; }); });
  out << "</Cells>\n</Piece>\n</UnstructuredGrid></VTKFile>\n";
  if (!out) throw InvalidInput("cannot write " + path);
}

}  // namespace polycube
