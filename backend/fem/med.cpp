// MED (Salome, Code_Aster, FreeCAD) through libmed. MED winds cells as SMESH does; groups are carried by families.
#include <med.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

#include "fem/formats.h"

namespace polycube {
namespace {

void require(med_err status, const char* what) {
  if (status < 0) throw std::runtime_error(std::string("libmed cannot write ") + what);
}

/// The file and the one mesh in it.
class File {
 public:
  File(const std::string& path, const std::string& mesh_name) : id_(MEDfileOpen(path.c_str(), MED_ACC_CREAT)), mesh_(mesh_name, 0, MED_NAME_SIZE) {
    if (id_ < 0) throw std::runtime_error("libmed cannot open the file");
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (id_ >= 0) MEDfileClose(id_);
  }
  void close() {
    const med_idt id = id_;
    id_ = -1;
    require(MEDfileClose(id), "the end of the file");
  }
  med_idt id() const { return id_; }
  const char* mesh() const { return mesh_.c_str(); }

 private:
  med_idt id_;
  std::string mesh_;
};

/// libmed takes names of fixed width one after the other.
std::string padded(const std::vector<std::string>& names, std::size_t width) {
  std::string text;
  for (std::string name : names) {
    name.resize(width, '\0');
    text += name;
  }
  return text;
}

void create_family(const File& file, med_int number, const std::vector<std::string>& groups) {
  const std::string name = number == 0 ? "FAMILLE_ZERO" : "FAM_" + std::to_string(number);
  const std::string text = padded(groups, MED_LNAME_SIZE);
  require(MEDfamilyCr(file.id(), file.mesh(), name.c_str(), number, static_cast<med_int>(groups.size()), text.c_str()), "a family");
}

/// Every node belongs to one family: the set of groups it is in.
std::vector<med_int> create_node_families(const File& file, const FemMesh& mesh) {
  std::vector<std::vector<int>> memberships(mesh.points.size());
  for (int g = 0; g < std::ssize(mesh.groups); ++g)
    for (int node : mesh.groups[g].nodes) memberships[node].push_back(g);
  std::map<std::vector<int>, med_int> families{{{}, 0}};
  std::vector<med_int> family_of;
  for (const auto& membership : memberships) {
    const auto [it, fresh] = families.try_emplace(membership, static_cast<med_int>(families.size()));
    if (fresh) {
      std::vector<std::string> names;
      names.reserve(membership.size());
      for (int g : membership) names.push_back(node_group_name(mesh.groups[g]));
      create_family(file, it->second, names);
    }
    family_of.push_back(it->second);
  }
  return family_of;
}

/// Family of each element of the given dimension: the set of groups it is in; numbers of element families are negative, `next` is the last one used.
std::vector<med_int> create_element_families(const File& file, const FemMesh& mesh, int dim, std::size_t count, med_int& next) {
  std::vector<std::vector<int>> memberships(count);
  for (int g = 0; g < std::ssize(mesh.groups); ++g) {
    if (mesh.groups[g].entity.dim != dim) continue;
    for (int element : mesh.groups[g].elements) memberships[element].push_back(g);
  }
  std::map<std::vector<int>, med_int> families{{{}, 0}};
  // In the order of the groups.
  std::vector<std::vector<int>> sets = memberships;
  std::sort(sets.begin(), sets.end());
  for (const auto& set : sets) {
    const auto [it, fresh] = families.try_emplace(set, 0);
    if (!fresh) continue;
    it->second = --next;
    std::vector<std::string> names;
    names.reserve(set.size());
    for (int g : set) names.push_back(group_name(mesh.groups[g]));
    create_family(file, it->second, names);
  }
  std::vector<med_int> family_of;
  family_of.reserve(memberships.size());
  for (const auto& membership : memberships) family_of.push_back(families.at(membership));
  return family_of;
}

void write_cells(const File& file, med_geometry_type type, const std::vector<med_int>& nodes, const std::vector<med_int>& families) {
  const auto count = static_cast<med_int>(families.size());
  if (count == 0) return;
  require(MEDmeshElementConnectivityWr(file.id(), file.mesh(), MED_NO_DT, MED_NO_IT, 0, MED_CELL, type, MED_NODAL, MED_FULL_INTERLACE, count, nodes.data()),
          "elements");
  require(MEDmeshEntityFamilyNumberWr(file.id(), file.mesh(), MED_NO_DT, MED_NO_IT, MED_CELL, type, count, families.data()), "families of elements");
}

}  // namespace

void write_med(const FemMesh& mesh, const std::string& path, const std::string& mesh_name) {
  File file(path, mesh_name);
  const std::string axes = padded({"x", "y", "z"}, MED_SNAME_SIZE), units = padded({"mm", "mm", "mm"}, MED_SNAME_SIZE);
  require(MEDmeshCr(file.id(), file.mesh(), 3, 3, MED_UNSTRUCTURED_MESH, "Hexahedral mesh by Polycube", "", MED_SORT_DTIT, MED_CARTESIAN, axes.c_str(),
                    units.c_str()),
          "the mesh");
  create_family(file, 0, {});

  std::vector<double> coordinates;
  for (const Vec3& p : mesh.points) coordinates.insert(coordinates.end(), {p[0], p[1], p[2]});
  const auto node_count = static_cast<med_int>(mesh.points.size());
  require(MEDmeshNodeCoordinateWr(file.id(), file.mesh(), MED_NO_DT, MED_NO_IT, 0, MED_FULL_INTERLACE, node_count, coordinates.data()), "nodes");
  const auto node_families = create_node_families(file, mesh);
  require(MEDmeshEntityFamilyNumberWr(file.id(), file.mesh(), MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE, node_count, node_families.data()), "families of nodes");

  std::vector<med_int> nodes;
  med_int family = 0;
  for (const auto& segment : mesh.segments)
    for (int i = 0; i < segment_nodes(mesh); ++i) nodes.push_back(segment[i] + 1);
  write_cells(file, mesh.order == 2 ? MED_SEG3 : MED_SEG2, nodes, create_element_families(file, mesh, 1, mesh.segments.size(), family));
  nodes.clear();
  for (const auto& quad : mesh.quads)
    for (int i = 0; i < quad_nodes(mesh); ++i) nodes.push_back(quad[i] + 1);
  write_cells(file, mesh.order == 2 ? MED_QUAD8 : MED_QUAD4, nodes, create_element_families(file, mesh, 2, mesh.quads.size(), family));
  nodes.clear();
  for (const auto& hex : mesh.hexes)
    for (int i = 0; i < hex_nodes(mesh); ++i) nodes.push_back(hex[kSmeshHex20[i]] + 1);
  write_cells(file, mesh.order == 2 ? MED_HEXA20 : MED_HEXA8, nodes, create_element_families(file, mesh, 3, mesh.hexes.size(), family));
  file.close();
}

}  // namespace polycube
