#include "core/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "core/error.h"

namespace polycube {
namespace {

using Json = nlohmann::ordered_json;

Json options_json(const MeshOptions& options) {
  Json json = Json::object();
  for (const OptionSpec& option : option_table()) {
    std::visit(
        [&](auto member) {
          if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(options.*member)>>) {
            json[option.name] = options.*member;
          } else {
            json[option.name] = option_text(options, option);
          }
        },
        option.member);
  }
  return json;
}

Json spread_json(const Spread& spread) { return {{"min", spread.min}, {"mean", spread.mean}, {"max", spread.max}}; }

Json names(int dim, const std::vector<int>& ids) {
  Json json = Json::array();
  for (int id : ids) json.push_back(name(CadRef{dim, id}));
  return json;
}

}  // namespace

std::vector<WorstCell> worst_cells(const HexMesh& mesh, const Association& association, int count) {
  std::vector<double> quality(mesh.hexes.size());
  for (std::size_t i = 0; i < quality.size(); ++i) quality[i] = scaled_jacobian(mesh.points, mesh.hexes[i]);
  std::vector<int> order(quality.size());
  std::iota(order.begin(), order.end(), 0);
  const auto kept = std::min<std::ptrdiff_t>(count, std::ssize(order));
  std::partial_sort(order.begin(), order.begin() + kept, order.end(),
                    [&](int a, int b) { return quality[a] != quality[b] ? quality[a] < quality[b] : a < b; });
  order.resize(static_cast<std::size_t>(kept));

  // The cell touches a CAD face where one of its nodes lies on a quad of the face.
  std::vector<std::set<int>> point_faces(mesh.points.size());
  for (std::size_t q = 0; q < association.quads.size(); ++q)
    for (int p : association.quads[q]) {
      const auto& faces = association.patches[association.quad_patch[q]];
      point_faces[p].insert(faces.begin(), faces.end());
    }
  std::vector<WorstCell> cells;
  for (int i : order) {
    WorstCell cell{.hex = i, .scaled_jacobian = quality[i]};
    std::set<int> faces;
    for (int p : mesh.hexes[i]) {
      cell.centre += mesh.points[p] / 8;
      faces.insert(point_faces[p].begin(), point_faces[p].end());
    }
    cell.faces.assign(faces.begin(), faces.end());
    cells.push_back(std::move(cell));
  }
  return cells;
}

CadCapture capture(const Association& association, int vertex_count, const std::vector<int>& real_edges, int face_count) {
  CadCapture c;
  c.vertices = vertex_count;
  c.edges = static_cast<int>(real_edges.size());
  c.faces = face_count;
  c.lost_vertices = association.lost_vertices;
  c.lost_edges = association.lost_edges;
  c.ignored_vertices = association.ignored_vertices;
  c.ignored_edges = association.ignored_edges;
  c.ignored_faces = association.ignored_faces;
  for (auto* list : {&c.lost_vertices, &c.lost_edges, &c.ignored_vertices, &c.ignored_edges, &c.ignored_faces}) std::sort(list->begin(), list->end());
  for (const auto& patch : association.patches) {
    if (patch.size() < 2 || std::binary_search(c.ignored_faces.begin(), c.ignored_faces.end(), patch[0])) continue;
    c.lost_faces.insert(c.lost_faces.end(), patch.begin(), patch.end());
  }
  std::sort(c.lost_faces.begin(), c.lost_faces.end());
  c.vertices_captured = c.vertices - static_cast<int>(c.lost_vertices.size() + c.ignored_vertices.size());
  c.edges_captured = c.edges - static_cast<int>(c.lost_edges.size() + c.ignored_edges.size());
  c.faces_captured = c.faces - static_cast<int>(c.lost_faces.size() + c.ignored_faces.size());
  return c;
}

std::string to_json(const MeshReport& report) {
  Json json;
  json["version"] = report.version;
  json["options"] = options_json(report.options);
  json["size"] = report.size;
  json["element_type"] = effective_element_type(report.options);
  double seconds = 0;
  json["stages"] = Json::array();
  for (const StageRecord& stage : report.stages) {
    json["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
    seconds += stage.seconds;
  }
  json["seconds"] = seconds;
  json["peak_memory_mb"] = report.peak_memory_mb;
  json["counts"] = {{"tets", report.tets},   {"charts", report.charts}, {"blocks", report.blocks},
                    {"hexes", report.hexes}, {"nodes", report.nodes},   {"padded_hexes", report.padded_hexes}, {"loose_nodes", report.loose_nodes},
                    {"thin_walls", report.thin_walls}, {"coarse_circles", report.coarse_circles}};
  json["quality"] = {{"min_scaled_jacobian", report.quality.min_scaled_jacobian},
                     {"mean_scaled_jacobian", report.quality.mean_scaled_jacobian},
                     {"inverted", report.quality.inverted},
                     {"histogram", report.quality.histogram},
                     {"edge_ratio", spread_json(report.shape.edge_ratio)},
                     {"skew", spread_json(report.shape.skew)},
                     {"warpage", spread_json(report.shape.warpage)},
                     {"straightened_edges", report.straightened_edges},
                     {"straightened_faces", names(2, report.straightened_faces)}};
  json["volume"] = {{"mesh", report.volume}, {"cad", report.cad_volume}};
  json["worst_cells"] = Json::array();
  for (const WorstCell& cell : report.worst)
    json["worst_cells"].push_back({{"hex", cell.hex},
                                   {"centre", {cell.centre[0], cell.centre[1], cell.centre[2]}},
                                   {"scaled_jacobian", cell.scaled_jacobian},
                                   {"faces", names(2, cell.faces)}});
  const CadCapture& c = report.capture;
  const auto entities = [](int dim, int total, int captured, const std::vector<int>& lost, const std::vector<int>& ignored) {
    return Json{{"total", total}, {"captured", captured}, {"lost", names(dim, lost)}, {"ignored", names(dim, ignored)}};
  };
  json["cad"] = {{"vertices", entities(0, c.vertices, c.vertices_captured, c.lost_vertices, c.ignored_vertices)},
                 {"edges", entities(1, c.edges, c.edges_captured, c.lost_edges, c.ignored_edges)},
                 {"faces", entities(2, c.faces, c.faces_captured, c.lost_faces, c.ignored_faces)}};
  const QuantizationRecord& q = report.quantization;
  json["quantization"] = {{"objective", q.objective}, {"bound", q.bound}, {"gap", q.gap},           {"optimal", q.optimal},
                          {"nodes", q.nodes},         {"cuts", q.cuts},   {"c2_rounds", q.c2_rounds}};
  json["search"] = {{"plan", report.plan}, {"plans_tried", report.plans_tried}, {"out_of_time", report.out_of_time}};
  json["warnings"] = report.warnings;
  return json.dump(2) + "\n";
}

}  // namespace polycube
