#include "core/report.h"

#include <algorithm>
#include <limits>
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
  std::partial_sort(order.begin(), order.begin() + kept, order.end(), [&](int a, int b) { return quality[a] != quality[b] ? quality[a] < quality[b] : a < b; });
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

namespace {

Json report_json(const MeshReport& report) {
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
  json["counts"] = {{"tets", report.tets},
                    {"charts", report.charts},
                    {"blocks", report.blocks},
                    {"hexes", report.hexes},
                    {"nodes", report.nodes},
                    {"padded_hexes", report.padded_hexes},
                    {"loose_nodes", report.loose_nodes},
                    {"thin_walls", report.thin_walls},
                    {"coarse_circles", report.coarse_circles}};
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
  json["quantization"] = {{"objective", q.objective}, {"bound", q.bound},        {"gap", q.gap}, {"optimal", q.optimal}, {"nodes", q.nodes},
                          {"cuts", q.cuts},           {"c2_rounds", q.c2_rounds}};
  json["search"] = {{"plan", report.plan}, {"plans_tried", report.plans_tried}, {"out_of_time", report.out_of_time}};
  if (!report.solids.empty()) {
    json["solids"] = Json::array();
    for (std::size_t s = 0; s < report.solids.size(); ++s) {
      Json one{{"name", name(CadRef{3, static_cast<int>(s) + 1})}, {"label", report.solids[s].label}};
      one.update(report_json(report.solids[s].report));
      for (const char* of_all : {"version", "options", "element_type"}) one.erase(of_all);
      json["solids"].push_back(std::move(one));
    }
    json["interfaces"] = Json::array();
    for (const InterfaceRecord& i : report.interfaces)
      json["interfaces"].push_back(
          {{"solids", names(3, {i.solids.begin(), i.solids.end()})}, {"faces", {names(2, i.faces[0]), names(2, i.faces[1])}}, {"area", i.area}});
  }
  json["warnings"] = report.warnings;
  return json;
}

template <class Record>
void add_stages(std::vector<Record>& all, const std::vector<Record>& more) {
  for (const Record& stage : more) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Record& one) { return one.name == stage.name; });
    if (at == all.end()) {
      all.push_back(stage);
    } else {
      at->seconds += stage.seconds;
    }
  }
}

void add(std::vector<int>& all, const std::vector<int>& more) {
  all.insert(all.end(), more.begin(), more.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

/// Means are weighted by the numbers of cells.
void add(Spread& all, const Spread& more, double share) {
  all.min = std::min(all.min, more.min);
  all.max = std::max(all.max, more.max);
  all.mean += share * more.mean;
}

void add(QualitySummary& all, const QualitySummary& more, double share) {
  all.min_scaled_jacobian = std::min(all.min_scaled_jacobian, more.min_scaled_jacobian);
  all.mean_scaled_jacobian += share * more.mean_scaled_jacobian;
  all.inverted += more.inverted;
  for (std::size_t i = 0; i < all.histogram.size(); ++i) all.histogram[i] += more.histogram[i];
}

}  // namespace

std::string to_json(const MeshReport& report) { return report_json(report).dump(2) + "\n"; }

MeshReport join(std::vector<SolidReport> solids) {
  MeshReport all;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  all.quality.min_scaled_jacobian = all.shape.edge_ratio.min = all.shape.skew.min = all.shape.warpage.min = kNone;
  int total = 0;
  for (const SolidReport& solid : solids) total += solid.report.hexes;
  all.quantization.optimal = true;
  for (std::size_t s = 0; s < solids.size(); ++s) {
    const MeshReport& r = solids[s].report;
    const double share = static_cast<double>(r.hexes) / total;
    all.version = r.version;
    all.size = s == 0 ? r.size : std::min(all.size, r.size);
    add_stages(all.stages, r.stages);
    all.peak_memory_mb = std::max(all.peak_memory_mb, r.peak_memory_mb);
    for (WorstCell cell : r.worst) {
      cell.hex += solids[s].first_hex;
      all.worst.push_back(std::move(cell));
    }
    for (int MeshReport::*count :
         {&MeshReport::tets, &MeshReport::charts, &MeshReport::blocks, &MeshReport::hexes, &MeshReport::nodes, &MeshReport::plans_tried,
          &MeshReport::padded_hexes, &MeshReport::loose_nodes, &MeshReport::straightened_edges, &MeshReport::thin_walls, &MeshReport::coarse_circles})
      all.*count += r.*count;
    add(all.quality, r.quality, share);
    add(all.shape.edge_ratio, r.shape.edge_ratio, share);
    add(all.shape.skew, r.shape.skew, share);
    add(all.shape.warpage, r.shape.warpage, share);
    all.volume += r.volume;
    all.cad_volume += r.cad_volume;
    for (std::vector<int> CadCapture::*list : {&CadCapture::lost_vertices, &CadCapture::lost_edges, &CadCapture::lost_faces, &CadCapture::ignored_vertices,
                                               &CadCapture::ignored_edges, &CadCapture::ignored_faces})
      add(all.capture.*list, r.capture.*list);
    for (int CadCapture::*count : {&CadCapture::vertices, &CadCapture::edges, &CadCapture::faces, &CadCapture::vertices_captured, &CadCapture::edges_captured,
                                   &CadCapture::faces_captured})
      all.capture.*count += r.capture.*count;
    QuantizationRecord& q = all.quantization;
    q.objective += r.quantization.objective;
    q.bound += r.quantization.bound;
    q.optimal = q.optimal && r.quantization.optimal;
    q.nodes += r.quantization.nodes;
    q.cuts += r.quantization.cuts;
    q.c2_rounds += r.quantization.c2_rounds;
    all.plan += (s == 0 ? "" : "; ") + r.plan;
    all.out_of_time = all.out_of_time || r.out_of_time;
    add(all.straightened_faces, r.straightened_faces);
    for (const std::string& line : r.warnings) all.warnings.push_back(name(CadRef{3, static_cast<int>(s) + 1}) + ": " + line);
  }
  if (all.quantization.objective > 0) all.quantization.gap = (all.quantization.objective - all.quantization.bound) / all.quantization.objective;
  std::stable_sort(all.worst.begin(), all.worst.end(), [](const WorstCell& a, const WorstCell& b) { return a.scaled_jacobian < b.scaled_jacobian; });
  if (all.worst.size() > kWorstCells) all.worst.resize(kWorstCells);
  all.solids = std::move(solids);
  return all;
}

}  // namespace polycube
