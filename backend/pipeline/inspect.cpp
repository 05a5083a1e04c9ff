#include "pipeline/inspect.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/charts.h"
#include "core/error.h"
#include "label/tuning.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

using Json = nlohmann::ordered_json;

double mean_edge(const TetMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += (mesh.points[t[0]] - mesh.points[t[1]]).norm();
  return sum / static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
}

// The points of a chain where it reverses along an axis by more than the noise.
void add_reversals(const std::vector<Vec3>& points, const std::vector<int>& chain, int axis, double noise, std::vector<int>& found) {
  const double sign = points[chain.back()][axis] >= points[chain.front()][axis] ? 1 : -1;
  int furthest = chain.front();
  bool back = false;
  for (int n : chain) {
    const double ahead = sign * (points[n][axis] - points[furthest][axis]);
    if (ahead > 0) {
      furthest = n;
      back = false;
    } else if (!back && -ahead > noise) {
      found.push_back(furthest);
      back = true;
    }
  }
}

void add_zigzags(const TetMesh& mesh, const std::vector<int>& chain, std::vector<int>& found) {
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    if (mesh.point_cad[chain[i]].dim != 2) continue;
    const Vec3 in = mesh.points[chain[i]] - mesh.points[chain[i - 1]], out = mesh.points[chain[i + 1]] - mesh.points[chain[i]];
    if (in.dot(out) < kPipelineTuning.zigzag * in.norm() * out.norm()) found.push_back(chain[i]);
  }
}

struct Cell {
  std::vector<int> nodes;
  int kind = 0, label = -1, chart = -1, face = 0, edge = 0, axis = -1;
};

std::vector<Cell> cells_of(const LabelledPart& part, const Inspection& inspection) {
  std::vector<Cell> cells;
  const auto& triangles = part.tets.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    cells.push_back({{triangles[t].begin(), triangles[t].end()}, 0, part.labelling.label[t], inspection.chart[t], part.tets.triangle_face[t]});
  const auto neighbours = triangle_neighbours(triangles);
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int n = neighbours[t][k];
      if (n > t && part.labelling.label[n] != part.labelling.label[t]) cells.push_back({{triangles[t][k], triangles[t][(k + 1) % 3]}, 1});
    }
  }
  std::vector<std::vector<const Chart*>> feature;
  std::vector<int> kind;
  for (const FeatureEdge& e : part.features.edges) {
    kind.resize(std::max<std::size_t>(kind.size(), static_cast<std::size_t>(e.edge) + 1), 4);
    kind[e.edge] = e.capture == EdgeCapture::kBoundary ? 2 : e.capture == EdgeCapture::kFeature ? 3 : 4;
  }
  feature.resize(kind.size());
  for (const FeatureChart& f : part.features.charts) feature[f.edge].push_back(&f.chart);
  for (std::size_t s = 0; s < part.tets.segments.size(); ++s) {
    const int e = part.tets.segment_edge[s];
    const Segment& nodes = part.tets.segments[s];
    if (e >= static_cast<int>(kind.size())) continue;  // a seam
    Cell cell{{nodes[0], nodes[1]}, kind[e], -1, -1, 0, e};
    for (const Chart* c : feature[e]) {
      const auto on = [&](int n) { return std::binary_search(c->nodes.begin(), c->nodes.end(), n); };
      if (on(nodes[0]) && on(nodes[1])) cell.axis = c->axis;
    }
    cells.push_back(std::move(cell));
  }
  const std::array<const std::vector<int>*, 4> points{&inspection.corners, &inspection.bad_corners, &inspection.turning_points, &inspection.zigzags};
  for (int k = 0; k < 4; ++k) {
    for (int n : *points[k]) cells.push_back({{n}, 5 + k});
  }
  return cells;
}

}  // namespace

Inspection inspect(const LabelledPart& part) {
  const TetMesh& mesh = part.tets;
  Inspection result;
  const std::vector<Chart> charts = find_charts(mesh.triangles, part.labelling.label);
  result.charts = static_cast<int>(charts.size());
  result.chart.resize(mesh.triangles.size());
  const double edge = mean_edge(mesh), noise = 0.75 * edge;
  std::vector<int> label;
  for (int c = 0; c < result.charts; ++c) {
    double area = 0;
    for (int t : charts[c].triangles) {
      const auto& [p, q, r] = mesh.triangles[t];
      area += (mesh.points[q] - mesh.points[p]).cross(mesh.points[r] - mesh.points[p]).norm() / 2;
      result.chart[t] = c;
    }
    label.push_back(2 * charts[c].axis + (charts[c].sign < 0));
    if (std::ssize(charts[c].triangles) <= kLabelTuning.stray_triangles || area < 4 * edge * edge) result.stray_charts.push_back(c);
  }
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points) points.push_back(part.labelling.frame * p);
  const RegionGraph graph = build_region_graph(mesh, result.chart);
  result.boundaries = static_cast<int>(graph.arcs.size());
  result.violations = find_violations(graph, points, label, noise);
  for (const Junction& j : graph.junctions) result.corners.push_back(j.node);
  for (int j : result.violations.corners) result.bad_corners.push_back(graph.junctions[j].node);
  for (const Arc& arc : graph.arcs) {
    add_zigzags(mesh, arc.nodes, result.zigzags);
    const int a = label_axis(label[arc.left]), b = label_axis(label[arc.right]);
    if (a != b && arc.start >= 0) add_reversals(points, arc.nodes, 3 - a - b, noise, result.turning_points);
  }
  for (auto* list : {&result.corners, &result.bad_corners, &result.turning_points, &result.zigzags}) std::sort(list->begin(), list->end());
  return result;
}

EdgeTable edge_table(const LabelledPart& part) {
  EdgeTable table;
  for (const FeatureEdge& e : part.features.edges) {
    ++table.edges;
    ++(e.capture == EdgeCapture::kBoundary ? table.boundary : e.capture == EdgeCapture::kFeature ? table.feature : table.lost);
  }
  return table;
}

std::vector<int> face_labels(const LabelledPart& part, int face_count) {
  std::vector<std::array<double, 6>> area(static_cast<std::size_t>(face_count) + 1);
  for (auto& a : area) a.fill(0);
  for (std::size_t t = 0; t < part.tets.triangles.size(); ++t) {
    const auto& [a, b, c] = part.tets.triangles[t];
    const auto& p = part.tets.points;
    area[part.tets.triangle_face[t]][part.labelling.label[t]] += (p[b] - p[a]).cross(p[c] - p[a]).norm();
  }
  std::vector<int> labels;
  labels.reserve(area.size());
  for (const auto& a : area) labels.push_back(static_cast<int>(std::max_element(a.begin(), a.end()) - a.begin()));
  return labels;
}

std::string report_json(const std::string& name, const Assembly& assembly, const LabelledPart& part, const Inspection& inspection) {
  const Violations& v = inspection.violations;
  const std::vector<int> faces = assembly.faces();
  Json json;
  json["part"] = name;
  json["valid"] = v.valid();
  json["monotone"] = v.turning_points == 0;
  json["violations"] = {{"opposite_boundaries", v.opposite_arcs},
                        {"missing_corners", v.poor_loops},
                        {"bad_corners", v.bad_corners},
                        {"turning_points", v.turning_points},
                        {"bad_turns", v.bad_turns}};
  json["counts"] = {{"faces", faces.size()},
                    {"tets", part.tets.tets.size()},
                    {"triangles", part.tets.triangles.size()},
                    {"charts", inspection.charts},
                    {"boundaries", inspection.boundaries},
                    {"corners", inspection.corners.size()},
                    {"stray_charts", inspection.stray_charts.size()},
                    {"zigzags", inspection.zigzags.size()},
                    {"flipped", part.flipped}};
  const EdgeTable edges = edge_table(part);
  json["edges"] = {{"total", edges.edges}, {"boundary", edges.boundary}, {"feature", edges.feature}, {"lost", Json::array()}};
  for (const FeatureEdge& e : part.features.edges) {
    if (e.capture == EdgeCapture::kLost) json["edges"]["lost"].push_back({{"edge", polycube::name({1, e.edge})}, {"reason", e.reason}});
  }
  json["frame"] = Json::array();
  for (int k = 0; k < 3; ++k) json["frame"].push_back({part.labelling.frame(k, 0), part.labelling.frame(k, 1), part.labelling.frame(k, 2)});
  const std::vector<int> labels = face_labels(part, faces.back());
  json["faces"] = Json::object();
  for (const int f : faces) json["faces"][polycube::name({2, f})] = label_name(labels[f]);
  json["map"] = part.failure ? Json(part.failure->what()) : Json("made");
  json["warnings"] = assembly.all_warnings();
  json["stages"] = Json::array();
  for (const StageRecord& stage : part.stages) json["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  return json.dump(2) + "\n";
}

void write_vtu(const std::string& path, const LabelledPart& part, const Inspection& inspection) {
  std::ofstream out(path);
  out.precision(9);
  const std::vector<Cell> cells = cells_of(part, inspection);
  const auto array = [&](const char* type, const char* name, int components, const auto& rows, const auto& write) {
    out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components << "\" format=\"ascii\">\n";
    for (const auto& row : rows) write(row);
    out << "</DataArray>\n";
  };
  const auto point = [&](const Vec3& p) { out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n'; };
  out << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n<Piece NumberOfPoints=\""
      << part.tets.points.size() << "\" NumberOfCells=\"" << cells.size() << "\">\n<PointData>\n";
  if (!part.map.image.empty()) array("Float64", "g", 3, part.map.image, point);
  out << "</PointData>\n<CellData>\n";
  for (const auto& [name, member] :
       {std::pair{"kind", &Cell::kind}, {"label", &Cell::label}, {"chart", &Cell::chart}, {"face", &Cell::face}, {"edge", &Cell::edge}, {"axis", &Cell::axis}})
    array("Int32", name, 1, cells, [&, value = member](const Cell& c) { out << c.*value << '\n'; });
  out << "</CellData>\n<Points>\n";
  array("Float64", "Points", 3, part.tets.points, point);
  out << "</Points>\n<Cells>\n";
  array("Int32", "connectivity", 1, cells, [&](const Cell& c) {
    for (int n : c.nodes) out << n << ' ';
    out << '\n';
  });
  std::size_t at = 0;
  array("Int32", "offsets", 1, cells, [&](const Cell& c) { out << (at += c.nodes.size()) << '\n'; });
  // VTK's vertex, line and triangle.
  array("UInt8", "types", 1, cells, [&](const Cell& c) { out << std::array{1, 3, 5}[c.nodes.size() - 1] << '\n'; });
  out << "</Cells>\n</Piece>\n</UnstructuredGrid></VTKFile>\n";
  out.close();
  if (!out) throw InvalidInput("cannot write " + path);
}

}  // namespace polycube
