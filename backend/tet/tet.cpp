#include "tet/tet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "tet/classify.h"
#include "tet/process.h"
#include "tet/sizes.h"
#include "tet/split.h"
#include "tet/worker/protocol.h"

namespace polycube {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Gmsh's algorithm numbers: surface 1 MeshAdapt, 5 Delaunay, 6 Frontal-Delaunay; volume 1 Delaunay, 10 HXT.
struct Rung {
  int surface, volume;
  bool curvature, heal;
  double scale;  // of the size
};

// Finer where the chosen size fails: faces that are thin against the elements cross each other when meshed coarsely.
constexpr std::array<Rung, 9> kLadder{{
    {6, 1, true, false, 1.0},
    {5, 1, true, false, 1.0},
    {6, 1, true, false, 0.7},
    {1, 1, true, false, 0.7},
    {6, 10, true, false, 0.5},
    {6, 1, false, false, 0.5},
    {1, 1, true, false, 0.35},
    {6, 1, true, true, 0.7},
    {5, 1, false, false, 1.4},
}};

std::string describe(const Rung& rung) {
  char text[120];
  std::snprintf(text, sizeof text, "surface algorithm %d, volume algorithm %d, curvature %s, size x %.2g%s", rung.surface, rung.volume,
                rung.curvature ? "on" : "off", rung.scale, rung.heal ? ", healed" : "");
  return text;
}

WorkerSetting setting_of(const Rung& rung, const CadModel& model, const TetOptions& options) {
  WorkerSetting setting;
  setting.surface_algorithm = rung.surface;
  setting.volume_algorithm = rung.volume;
  setting.heal = rung.heal;
  setting.size = options.size * rung.scale;
  const EntitySizes sizes = entity_sizes(model, setting.size, rung.curvature ? options.curvature : 0);
  setting.min_size = sizes.least;
  setting.edge_size = sizes.edges;
  setting.face_size = sizes.faces;
  return setting;
}

RawMesh attempt(const std::vector<std::string>& command, const std::string& errors, double seconds, const Monitor& monitor) {
  const std::string problem = run_worker(command, errors, seconds, monitor);
  if (!problem.empty()) throw Unusable(problem);
  try {
    return read_raw(command.back());
  } catch (const std::runtime_error& error) {
    throw Unusable(error.what());
  }
}

void refuse_contacts(const CadModel& model) {
  constexpr std::size_t kNamed = 4;
  const std::vector<CadRef> contacts = model.self_contacts();
  if (contacts.empty()) return;
  std::string text = "the solid touches or crosses itself at";
  for (std::size_t i = 0; i < std::min(contacts.size(), kNamed); ++i) text += (i == 0 ? " " : ", ") + name(contacts[i]);
  if (contacts.size() > kNamed) text += " and others";
  throw InvalidInput(text);
}

}  // namespace

namespace {

using Classify = std::function<TetMesh(const RawMesh&)>;

TetMesh climb(const CadModel& model, const TetOptions& options, const Classify& classified, const std::function<void()>& look, const Monitor& monitor) {
  if (!(options.size > 0)) throw std::invalid_argument("tet: the size must be positive");
  monitor.progress("tet", 0);
  const TemporaryFolder folder;
  const std::string part = folder.file("part.brep"), setting = folder.file("setting"), result = folder.file("mesh"), errors = folder.file("errors");
  std::ofstream part_file(part);
  part_file << model.to_brep();
  if (!part_file.flush()) throw StageFailed("tet", "the part cannot be written for Gmsh: the folder for temporary files (TMPDIR) is full or must not grow");
  const std::string worker = find_worker();
  std::string reason;
  std::vector<CadRef> entities;
  for (const Rung& rung : kLadder) {
    const auto start = std::chrono::steady_clock::now();
    try {
      write_setting(setting_of(rung, model, options), setting);
      std::error_code ignored;
      std::filesystem::remove(result, ignored);
      TetMesh mesh = classified(attempt({worker, part, setting, result}, errors, options.attempt_limit, monitor));
      split_for_map(mesh, model, monitor);
      if (const std::vector<std::string> problems = check(mesh); !problems.empty()) throw Unusable(problems.front());
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      monitor.log("tet: " + std::to_string(mesh.tets.size()) + " tetrahedra in " + std::to_string(seconds) + " s (" + describe(rung) + ")");
      monitor.progress("tet", 1);
      return mesh;
    } catch (const Unusable& failure) {
      reason = failure.what();
      if (!failure.entities.empty()) entities = failure.entities;
      monitor.log("tet: " + describe(rung) + ": " + reason);
      // No setting helps a solid that touches itself, and looking for that is too slow to be done for every part.
      if (&rung == &kLadder.front()) look();
    }
  }
  throw StageFailed("tet", "Gmsh makes no usable tetrahedra with any of " + std::to_string(kLadder.size()) + " settings; last: " + reason, entities);
}

}  // namespace

TetMesh tetrahedralise(const CadModel& model, const TetOptions& options, const Monitor& monitor) {
  const auto classified = [&](const RawMesh& raw) {
    TetMesh mesh = classify(raw, model);
    check_complete(mesh, model);
    return mesh;
  };
  return climb(
      model, options, classified, [&] { refuse_contacts(model); }, monitor);
}

TetMesh tetrahedralise(const CadModel& whole, const std::vector<CadModel>& solids, const TetOptions& options, const Monitor& monitor) {
  const auto classified = [&](const RawMesh& raw) {
    TetMesh mesh = classify(raw, whole, solids);
    for (int s = 0; s < static_cast<int>(solids.size()); ++s) check_complete(tets_of_solid(mesh, s), solids[at(s)]);
    return mesh;
  };
  const auto look = [&] {
    for (const CadModel& solid : solids) refuse_contacts(solid);
  };
  return climb(whole, options, classified, look, monitor);
}

std::vector<std::string> check(const TetMesh& mesh) {
  std::vector<std::string> problems;
  const auto say = [&](const std::string& problem) { problems.push_back(problem); };
  if (mesh.tets.empty()) say("no tetrahedra");
  if (mesh.point_cad.size() != mesh.points.size() || mesh.triangle_face.size() != mesh.triangles.size() || mesh.segment_edge.size() != mesh.segments.size()) {
    say("classification arrays have wrong lengths");
    return problems;
  }
  const auto in_range = [&](const auto& elements) {
    return std::all_of(elements.begin(), elements.end(), [&](const auto& element) {
      return std::all_of(element.begin(), element.end(), [&](int v) { return v >= 0 && at(v) < mesh.points.size(); });
    });
  };
  if (!in_range(mesh.tets) || !in_range(mesh.triangles) || !in_range(mesh.segments)) {
    say("an index is out of range");
    return problems;
  }
  int inverted = 0;
  for (const Tet& t : mesh.tets)
    if (!(signed_volume(mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])], mesh.points[at(t[3])]) > 0)) ++inverted;
  if (inverted > 0) say(std::to_string(inverted) + " tetrahedra without positive volume");

  const auto canonical = [](Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::vector<Triangle> facets, triangles = mesh.triangles;
  try {
    facets = boundary_facets(mesh.tets);
  } catch (const Unusable& failure) {
    say(failure.what());
  }
  for (auto* list : {&facets, &triangles}) {
    std::transform(list->begin(), list->end(), list->begin(), canonical);
    std::sort(list->begin(), list->end());
  }
  if (facets != triangles) say("the triangles are not the boundary facets of the tetrahedra");

  std::map<Segment, int> uses;
  std::vector<bool> boundary(mesh.points.size(), false);
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
      boundary[at(a)] = true;
    }
  if (std::any_of(uses.begin(), uses.end(), [](const auto& use) { return use.second != 2; })) say("the boundary is not a closed manifold");

  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (boundary[i] == (mesh.point_cad[i].dim == 3)) {
      say("point " + std::to_string(i) + (boundary[i] ? " of the boundary is classified inside" : " inside is classified on the boundary"));
      break;
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.triangle_face[i] < 1) {
      say("a boundary triangle has no CAD face");
      break;
    }
  for (const Triangle& t : mesh.inner_triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      uses.insert({{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}, 0});
      boundary[at(t[k])] = true;
    }
  for (const Segment& s : mesh.segments) {
    if (!uses.count({std::min(s[0], s[1]), std::max(s[0], s[1])})) say("a segment is no edge of the boundary");
    if (mesh.point_cad[at(s[0])].dim > 1 || mesh.point_cad[at(s[1])].dim > 1) say("a segment's node is not on a CAD edge");
    if (!problems.empty()) break;
  }
  const auto all_on_boundary = [&](const Tet& t) { return std::all_of(t.begin(), t.end(), [&](int v) { return boundary[at(v)]; }); };
  const auto stuck = std::count_if(mesh.tets.begin(), mesh.tets.end(), all_on_boundary);
  if (stuck > 0) say(std::to_string(stuck) + " tetrahedra have all points on the boundary");
  bool bridge = false;
  for (const Tet& t : mesh.tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        bridge = bridge || (boundary[at(t[i])] && boundary[at(t[j])] && !uses.count({std::min(t[i], t[j]), std::max(t[i], t[j])}));
  if (bridge) say("an inner edge joins two boundary points");
  return problems;
}

}  // namespace polycube
