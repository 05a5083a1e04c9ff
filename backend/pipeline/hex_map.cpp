#include "pipeline/hex_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/charts.h"
#include "core/error.h"
#include "core/quality.h"
#include "fem/fem.h"
#include "quantize/monotone.h"
#include "quantize/problem.h"

namespace polycube {
namespace {

constexpr std::array<std::array<int, 3>, 4> kFacets{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct MeditTets {
  std::vector<Vec3> points;
  std::vector<Tet> tets;
};

MeditTets read_medit(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InvalidInput("cannot read " + path);
  MeditTets mesh;
  std::string word;
  while (in >> word && word != "End") {
    if (word == "Vertices") {
      std::size_t count = 0;
      in >> count;
      for (std::size_t i = 0; i < count && in; ++i) {
        Vec3 p;
        int reference = 0;
        in >> p[0] >> p[1] >> p[2] >> reference;
        mesh.points.push_back(p);
      }
    } else if (word == "Tetrahedra") {
      std::size_t count = 0;
      in >> count;
      for (std::size_t i = 0; i < count && in; ++i) {
        Tet tet;
        int reference = 0;
        for (int& v : tet) in >> v;
        in >> reference;
        for (int& v : tet) --v;
        mesh.tets.push_back(tet);
      }
    }
    if (!in) throw InvalidInput(path + " is not a complete Medit mesh");
  }
  const int points = static_cast<int>(mesh.points.size());
  for (const Tet& tet : mesh.tets) {
    for (int v : tet) {
      if (v < 0 || v >= points) throw InvalidInput(path + ": a tetrahedron refers to a vertex that does not exist");
    }
  }
  if (mesh.tets.empty()) throw InvalidInput(path + " holds no tetrahedra");
  return mesh;
}

double seconds_since(Monitor::Clock::time_point start) { return std::chrono::duration<double>(Monitor::Clock::now() - start).count(); }

}  // namespace

void place_charts(PolycuboidInput& input, const std::vector<int>& triangle_labels) {
  PolycuboidMap& map = input.map;
  map.charts = find_charts(input.tets.triangles, triangle_labels);
  std::vector<int> leader(map.charts.size());
  std::vector<std::array<int, 3>> chart_at(map.image.size(), {-1, -1, -1});
  for (std::size_t c = 0; c < map.charts.size(); ++c) leader[c] = static_cast<int>(c);
  const auto find = [&](int c) {
    while (leader[c] != c) c = leader[c];
    return c;
  };
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    for (int n : map.charts[c].nodes) {
      int& at = chart_at[n][map.charts[c].axis];
      if (at < 0) at = c;
      const int a = find(at), b = find(c);
      leader[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<double> sum(map.charts.size(), 0), count(map.charts.size(), 0);
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    for (int n : map.charts[c].nodes) {
      sum[find(c)] += map.image[n][map.charts[c].axis];
      count[find(c)] += 1;
    }
  }
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    map.charts[c].value = sum[find(c)] / count[find(c)];
    for (int n : map.charts[c].nodes) map.image[n][map.charts[c].axis] = map.charts[c].value;
  }
}

PolycuboidInput read_polycuboid(const std::string& tets_path, const std::string& labels_path, const std::string& map_path) {
  MeditTets solid = read_medit(tets_path), image = read_medit(map_path);
  if (solid.points.size() != image.points.size() || solid.tets != image.tets) {
    throw InvalidInput(map_path + " does not have the vertices and tetrahedra of " + tets_path);
  }
  std::ifstream labels(labels_path);
  if (!labels) throw InvalidInput("cannot read " + labels_path);
  PolycuboidInput input;
  input.tets.points = std::move(solid.points);
  input.map.image = std::move(image.points);
  std::vector<int> triangle_labels;
  for (Tet tet : solid.tets) {
    const auto& p = input.tets.points;
    const bool negative = (p[tet[1]] - p[tet[0]]).cross(p[tet[2]] - p[tet[0]]).dot(p[tet[3]] - p[tet[0]]) < 0;
    for (int f = 0; f < 4; ++f) {
      int label = 0;
      if (!(labels >> label) || label < -1 || label > 5) throw InvalidInput(labels_path + " does not hold four labels from -1 to 5 per tetrahedron");
      if (label < 0) continue;
      Triangle t{tet[kFacets[f][0]], tet[kFacets[f][1]], tet[kFacets[f][2]]};
      if (negative) std::swap(t[1], t[2]);
      input.tets.triangles.push_back(t);
      triangle_labels.push_back(label);
    }
    if (negative) std::swap(tet[2], tet[3]);
    input.tets.tets.push_back(tet);
  }
  input.tets.point_cad.assign(input.tets.points.size(), CadRef{});
  try {
    place_charts(input, triangle_labels);
  } catch (const std::invalid_argument& error) {
    throw InvalidInput(labels_path + ": " + error.what());
  }
  input.tets.triangle_face.assign(input.tets.triangles.size(), 0);
  for (std::size_t c = 0; c < input.map.charts.size(); ++c) {
    for (int t : input.map.charts[c].triangles) input.tets.triangle_face[t] = static_cast<int>(c) + 1;
  }
  return input;
}

double mean_edge(const PolycuboidInput& input) {
  std::vector<Segment> edges;
  edges.reserve(6 * input.tets.tets.size());
  for (const Tet& tet : input.tets.tets) {
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) edges.push_back({std::min(tet[i], tet[j]), std::max(tet[i], tet[j])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  double sum = 0;
  for (const Segment& e : edges) sum += (input.map.image[e[0]] - input.map.image[e[1]]).norm();
  return sum / static_cast<double>(edges.size());
}

namespace {

Quantization coarsest(const BlockComplex& blocks, const PolycuboidMap& map, QuantizeOptions options, const Monitor& monitor) {
  options.scale = 0;
  return quantize(blocks, map, options, monitor);
}

}  // namespace

HexMapResult hex_map(const PolycuboidInput& input, const HexMapOptions& options, const Monitor& monitor) {
  const auto start = Monitor::Clock::now();
  const BlockComplex blocks = extract_blocks(input.tets, input.map, monitor);
  const double seconds = seconds_since(start);
  HexMapResult result;
  if (options.subdivide) {
    HexMapOptions finer = options;
    finer.subdivide = false;
    finer.quantize.structure = coarsest(blocks, input.map, options.quantize, monitor).value;
    result = hex_map(input, blocks, finer, monitor);
  } else {
    result = hex_map(input, blocks, options, monitor);
  }
  result.blocks_seconds = seconds;
  return result;
}

HexMapResult hex_map(const PolycuboidInput& input, const BlockComplex& blocks, const HexMapOptions& options, const Monitor& monitor) {
  HexMapResult result;
  result.blocks = blocks;
  QuantizeOptions quantize_options = options.quantize;
  if (options.scale_by_tets && quantize_options.scale > 0) quantize_options.scale = 1 / (options.quantize.scale * mean_edge(input));
  result.scale = quantize_options.scale;
  result.options = quantize_options;
  auto start = Monitor::Clock::now();
  result.quantization = quantize(result.blocks, input.map, quantize_options, monitor);
  result.quantize_seconds = seconds_since(start);
  start = Monitor::Clock::now();
  result.hexes = build_hexes(input.tets, input.map, result.blocks, result.quantization, monitor);
  result.hex_seconds = seconds_since(start);
  // A mesh without extent to spare is its own block structure.
  const std::vector<int>& structure = !quantize_options.structure.empty() ? quantize_options.structure
                                      : quantize_options.scale == 0       ? result.quantization.value
                                                                          : std::vector<int>();
  if (structure.empty()) {
    result.hex_cell = result.hexes.hex_block;
    result.cells = static_cast<int>(result.blocks.blocks.size());
  } else {
    result.hex_cell = coarse_cells(result.blocks, structure, result.quantization.value);
    result.cells = 1 + *std::max_element(result.hex_cell.begin(), result.hex_cell.end());
  }
  return result;
}

void write_vtu(const std::string& path, const HexComplex& hexes, const std::vector<int>& blocks) {
  FemMesh mesh;
  mesh.corner_count = static_cast<int>(hexes.mesh.points.size());
  mesh.points = hexes.mesh.points;
  for (const Hex& hex : hexes.mesh.hexes) {
    auto& nodes = mesh.hexes.emplace_back();
    nodes.fill(-1);
    std::copy(hex.begin(), hex.end(), nodes.begin());
  }
  mesh.hex_block = blocks;
  write(mesh, path, "C3D8", Monitor());
}

void write_medit(const std::string& path, const HexComplex& hexes) {
  std::ofstream out(path);
  out.precision(17);
  out << "MeshVersionFormatted 2\n\nDimension\n3\n\nVertices\n" << hexes.mesh.points.size() << '\n';
  for (const Vec3& p : hexes.mesh.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << " 1\n";
  out << "\nQuadrilaterals\n" << hexes.quads.size() << '\n';
  for (std::size_t q = 0; q < hexes.quads.size(); ++q) {
    for (int v : hexes.quads[q]) out << v + 1 << ' ';
    out << hexes.quad_chart[q] + 1 << '\n';
  }
  out << "\nHexahedra\n" << hexes.mesh.hexes.size() << '\n';
  for (const Hex& hex : hexes.mesh.hexes) {
    for (int v : hex) out << v + 1 << ' ';
    out << "1\n";
  }
  out << "\nEnd\n";
  if (!out.flush()) throw InvalidInput("cannot write " + path);
}

std::string report_json(const PolycuboidInput& input, const HexMapResult& result) {
  const QualitySummary quality = summarise(result.hexes.mesh);
  const Quantization& q = result.quantization;
  nlohmann::ordered_json json;
  json["tets"] = input.tets.tets.size();
  json["charts"] = input.map.charts.size();
  json["collapsed_charts"] = result.blocks.collapsed;
  json["scale"] = result.scale;
  json["blocks"] = result.blocks.blocks.size();
  std::vector<int> left = result.hexes.hex_block;
  left.erase(std::unique(left.begin(), left.end()), left.end());
  json["blocks_left"] = left.size();
  json["structure_cells"] = result.cells;
  json["hexes"] = result.hexes.mesh.hexes.size();
  json["nodes"] = result.hexes.mesh.points.size();
  json["quads"] = result.hexes.quads.size();
  json["objective"] = q.objective;
  json["bound"] = q.bound;
  json["gap"] = q.gap();
  json["optimal"] = q.optimal;
  json["c2_rounds"] = q.c2_rounds;
  json["cuts"] = q.cuts;
  json["search_nodes"] = q.nodes;
  json["flows"] = {{"solved", q.flows_solved}, {"repaired", q.flows_repaired}};
  json["chart_integers"] = q.value;
  json["seconds"] = {{"blocks", result.blocks_seconds}, {"quantize", result.quantize_seconds}, {"hex", result.hex_seconds}};
  json["min_scaled_jacobian"] = quality.min_scaled_jacobian;
  json["mean_scaled_jacobian"] = quality.mean_scaled_jacobian;
  json["inverted"] = quality.inverted;
  return json.dump(1) + "\n";
}

std::string problem_json(const PolycuboidInput& input, const HexMapResult& result) {
  const QuantizeProblem problem = build_problem(result.blocks, input.map, result.options);
  const MonotonePaths paths(result.blocks, input.map, problem, result.options.separate_features);
  nlohmann::ordered_json json;
  for (int d = 0; d < 3; ++d) {
    nlohmann::ordered_json axis;
    axis["charts"] = problem.axes[d].charts;
    axis["terms"] = nlohmann::json::array();
    for (const Term& t : problem.axes[d].terms) axis["terms"].push_back({t.low, t.high, t.weight, t.target});
    axis["differences"] = nlohmann::json::array();
    for (const Difference& e : problem.axes[d].differences) axis["differences"].push_back({e.low, e.high, e.at_least});
    json["axes"].push_back(axis);
  }
  json["edges"] = nlohmann::json::array();
  for (const auto& e : paths.edges()) json["edges"].push_back({e.axis, e.low, e.high, e.from, e.to});
  json["vertex_unknowns"] = paths.unknowns();
  std::vector<int> on_chart(paths.on_chart().begin(), paths.on_chart().end());
  json["vertex_on_chart"] = on_chart;
  return json.dump() + "\n";
}

}  // namespace polycube
