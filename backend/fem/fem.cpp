#include "fem/fem.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/error.h"
#include "core/hexahedron.h"
#include "fem/curve.h"
#include "fem/element.h"

namespace polycube {
namespace {

/// The CAD face of the patch nearest to the quad's centre; the first of equally near ones.
int nearest_face(const CadModel& model, const std::vector<int>& faces, const Vec3& centre) {
  if (faces.size() == 1) return faces.front();
  int best = faces.at(0);
  double least = std::numeric_limits<double>::infinity();
  for (int face : faces) {
    const double distance = model.project_to_face(face, centre).distance;
    if (distance < least) {
      least = distance;
      best = face;
    }
  }
  return best;
}

/// Which hex and which of its faces (Abaqus' numbering) each quad is.
std::vector<std::array<int, 2>> find_owners(const std::vector<Hex20>& hexes, const std::vector<Quad>& quads) {
  std::map<Quad, int> wanted;
  const auto sorted = [](Quad quad) {
    std::sort(quad.begin(), quad.end());
    return quad;
  };
  for (int q = 0; q < std::ssize(quads); ++q) wanted[sorted(quads[q])] = q;
  std::vector<std::array<int, 2>> owners(quads.size(), {-1, -1});
  for (int h = 0; h < std::ssize(hexes); ++h)
    for (int f = 0; f < 6; ++f) {
      const auto& c = kHexFaces[f];
      const auto it = wanted.find(sorted({hexes[h][c[0]], hexes[h][c[1]], hexes[h][c[2]], hexes[h][c[3]]}));
      if (it != wanted.end()) owners[it->second] = {h, kAbaqusFace[f]};
    }
  for (const auto& owner : owners)
    if (owner[0] < 0) throw StageFailed("fem", "a boundary quad belongs to no cell");
  return owners;
}

void add_groups(FemMesh& mesh, const Association& association) {
  std::map<CadRef, FemGroup> groups;
  const int quad_nodes = mesh.order == 2 ? 8 : 4, segment_nodes = mesh.order == 2 ? 3 : 2;
  for (int p = 0; p < std::ssize(association.point_cad); ++p)
    if (association.point_cad[p].dim == 0) groups[association.point_cad[p]].nodes.push_back(p);
  for (int s = 0; s < std::ssize(mesh.segments); ++s) {
    FemGroup& group = groups[{1, mesh.segment_edge[s]}];
    group.elements.push_back(s);
    group.nodes.insert(group.nodes.end(), mesh.segments[s].begin(), mesh.segments[s].begin() + segment_nodes);
  }
  for (int q = 0; q < std::ssize(mesh.quads); ++q) {
    FemGroup& group = groups[{2, mesh.quad_face[q]}];
    group.elements.push_back(q);
    group.sides.push_back(mesh.quad_hex[q]);
    group.nodes.insert(group.nodes.end(), mesh.quads[q].begin(), mesh.quads[q].begin() + quad_nodes);
  }
  FemGroup& solid = groups[{3, 1}];
  for (int h = 0; h < std::ssize(mesh.hexes); ++h) solid.elements.push_back(h);
  for (int p = 0; p < std::ssize(mesh.points); ++p) solid.nodes.push_back(p);
  for (auto& [entity, group] : groups) {
    group.entity = entity;
    std::sort(group.nodes.begin(), group.nodes.end());
    group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
    mesh.groups.push_back(std::move(group));
  }
}

void require_positive(const FemMesh& mesh) {
  std::vector<int> bad_cells;
  std::vector<CadRef> faces;
  for (int h = 0; h < std::ssize(mesh.hexes); ++h)
    if (!(least_jacobian(mesh, h) > 0)) bad_cells.push_back(h);
  if (bad_cells.empty()) return;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    if (std::binary_search(bad_cells.begin(), bad_cells.end(), mesh.quad_hex[q][0])) faces.push_back({2, mesh.quad_face[q]});
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  throw StageFailed("fem", std::to_string(bad_cells.size()) + " cells have a Jacobian that is not positive at an integration point", faces);
}

}  // namespace

std::string group_name(const FemGroup& group) {
  if (group.solid == 0) return name(group.entity);
  return name(CadRef{3, group.solid}) + "_" + name(group.other > 0 ? CadRef{3, group.other} : group.entity);
}

double least_jacobian(const FemMesh& mesh, int hex) {
  const Hex20& nodes = mesh.hexes[hex];
  return determinants(mesh.order == 2 ? curved_places(mesh.points, nodes) : straight_places(mesh.points, nodes)).head<kSolverPoints>().minCoeff();
}

std::vector<int> solid_numbers(const FemMesh& mesh) { return mesh.hex_solid.empty() ? std::vector<int>(mesh.hexes.size(), 1) : mesh.hex_solid; }

std::vector<double> cell_values(const FemMesh& mesh, double (*measure)(const std::vector<Vec3>&, const Hex&)) {
  std::vector<double> values;
  values.reserve(mesh.hexes.size());
  for (const Hex20& nodes : mesh.hexes) {
    Hex corners;
    std::copy_n(nodes.begin(), corners.size(), corners.begin());
    values.push_back(measure(mesh.points, corners));
  }
  return values;
}

void complete(MeshReport& report, const FemMesh& mesh) {
  report.nodes = static_cast<int>(mesh.points.size());
  report.straightened_edges = static_cast<int>(mesh.straight_nodes.size());
  if (mesh.straight_nodes.empty()) return;
  std::set<int> faces;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (int p : mesh.quads[q])
      if (std::binary_search(mesh.straight_nodes.begin(), mesh.straight_nodes.end(), p)) faces.insert(mesh.quad_face[q]);
  report.straightened_faces.assign(faces.begin(), faces.end());
  std::string line = std::to_string(mesh.straight_nodes.size()) + " mid-edge nodes are off the CAD, where they would spoil a cell:";
  for (int face : faces) line += " " + name({2, face});
  report.warnings.push_back(line);
}

FemMesh build_fem_mesh(const CadModel& model, const HexMesh& mesh, const Association& association, const FemOptions& options, const Monitor& monitor) {
  monitor.progress("fem", 0);
  FemMesh fem;
  fem.order = options.order;
  fem.points = mesh.points;
  fem.corner_count = static_cast<int>(mesh.points.size());
  for (const Hex& hex : mesh.hexes) {
    Hex20& nodes = fem.hexes.emplace_back();
    nodes.fill(-1);
    std::copy(hex.begin(), hex.end(), nodes.begin());
  }
  fem.quad_hex = find_owners(fem.hexes, association.quads);
  for (std::size_t q = 0; q < association.quads.size(); ++q) {
    auto& nodes = fem.quads.emplace_back();
    nodes.fill(-1);
    std::copy(association.quads[q].begin(), association.quads[q].end(), nodes.begin());
    Vec3 centre = Vec3::Zero();
    for (int p : association.quads[q]) centre += mesh.points[p] / 4;
    if (q % 256 == 0) monitor.check();
    fem.quad_face.push_back(nearest_face(model, association.patches.at(association.quad_patch[q]), centre));
  }
  for (const Segment& segment : association.segments) fem.segments.push_back({segment[0], segment[1], -1});
  fem.segment_edge = association.segment_edge;
  monitor.progress("fem", 0.3);
  if (fem.order == 2) add_mid_nodes(model, fem, options, monitor);
  require_positive(fem);
  add_groups(fem, association);
  monitor.progress("fem", 1);
  return fem;
}

}  // namespace polycube
