#include "fem/join.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace polycube {
namespace {

/// What the numbers of one part become in the whole.
struct Shift {
  int corners = 0;                ///< corner nodes in the part
  int corner_base = 0;            ///< of its corner nodes
  int mid_base = 0;               ///< of its mid-edge nodes
  std::array<int, 4> elements{};  ///< by dimension, as in FemGroup

  int node(int p) const { return p < 0 ? p : p < corners ? p + corner_base : p - corners + mid_base; }
};

std::vector<Shift> find_shifts(const std::vector<FemMesh>& parts) {
  std::vector<Shift> shifts;
  Shift next;
  for (const FemMesh& part : parts) {
    next.corners = part.corner_count;
    shifts.push_back(next);
    next.corner_base += part.corner_count;
    next.mid_base += static_cast<int>(part.points.size()) - part.corner_count;
    next.elements[1] += static_cast<int>(part.segments.size());
    next.elements[2] += static_cast<int>(part.quads.size());
    next.elements[3] += static_cast<int>(part.hexes.size());
  }
  for (Shift& shift : shifts) shift.mid_base += next.corner_base;
  return shifts;
}

template <class Row>
void append_rows(std::vector<Row>& rows, const std::vector<Row>& more, const Shift& shift) {
  for (Row row : more) {
    for (int& node : row) node = shift.node(node);
    rows.push_back(row);
  }
}

void sort_once(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Elements ascending, each with its side where there are sides.
void sort_once(std::vector<int>& elements, std::vector<std::array<int, 2>>& sides) {
  if (sides.empty()) return sort_once(elements);
  std::map<int, std::array<int, 2>> all;
  for (std::size_t i = 0; i < elements.size(); ++i) all.emplace(elements[i], sides[i]);
  elements.clear();
  sides.clear();
  for (const auto& [element, side] : all) {
    elements.push_back(element);
    sides.push_back(side);
  }
}

void add(FemGroup& group, const FemGroup& more) {
  group.nodes.insert(group.nodes.end(), more.nodes.begin(), more.nodes.end());
  group.elements.insert(group.elements.end(), more.elements.begin(), more.elements.end());
  group.sides.insert(group.sides.end(), more.sides.begin(), more.sides.end());
}

/// The part's groups by the numbers of the whole; the only solid of a part gets its own.
std::vector<FemGroup> shifted_groups(const FemMesh& part, const Shift& shift, int solid) {
  std::vector<FemGroup> groups = part.groups;
  for (FemGroup& group : groups) {
    if (group.entity.dim == 3 && part.hex_solid.empty()) group.entity.id = solid;
    for (int& node : group.nodes) node = shift.node(node);
    for (int& element : group.elements) element += shift.elements[static_cast<std::size_t>(group.entity.dim)];
    for (auto& [hex, side] : group.sides) hex += shift.elements[3];
    std::sort(group.nodes.begin(), group.nodes.end());
  }
  return groups;
}

void add_groups(FemMesh& whole, const std::vector<std::vector<FemGroup>>& groups_of, const std::vector<int>& numbers,
                const std::vector<Interface>& interfaces) {
  std::map<CadRef, int> solids_at;
  for (const auto& groups : groups_of)
    for (const FemGroup& group : groups) solids_at[group.entity] += group.solid == 0;
  // Of the whole first, then of the solids, then of the interfaces.
  std::map<std::tuple<int, int, CadRef>, FemGroup> all;
  for (std::size_t i = 0; i < groups_of.size(); ++i) {
    for (const FemGroup& group : groups_of[i]) {
      add(all[{group.solid, group.other, group.entity}], group);
      if (group.solid == 0 && numbers[i] > 0 && solids_at[group.entity] > 1) add(all[{numbers[i], 0, group.entity}], group);
    }
  }
  for (const Interface& interface : interfaces) {
    for (std::size_t side = 0; side < 2; ++side) {
      const int solid = interface.solids[side], other = interface.solids[1 - side];
      const auto part = std::find(numbers.begin(), numbers.end(), solid) - numbers.begin();
      for (const FemGroup& group : groups_of.at(static_cast<std::size_t>(part))) {
        const std::vector<int>& faces = interface.faces[side];
        if (group.entity.dim == 2 && std::binary_search(faces.begin(), faces.end(), group.entity.id)) add(all[{solid, other, {2, 0}}], group);
      }
    }
  }
  for (auto& [key, group] : all) {
    std::tie(group.solid, group.other, group.entity) = key;
    sort_once(group.nodes);
    sort_once(group.elements, group.sides);
    whole.groups.push_back(std::move(group));
  }
}

}  // namespace

FemMesh join(const std::vector<FemMesh>& parts, const std::vector<int>& numbers, const std::vector<Interface>& interfaces) {
  const std::vector<Shift> shifts = find_shifts(parts);
  FemMesh whole;
  whole.order = parts.front().order;
  std::vector<std::vector<FemGroup>> groups;
  for (const FemMesh& part : parts) whole.points.insert(whole.points.end(), part.points.begin(), part.points.begin() + part.corner_count);
  whole.corner_count = static_cast<int>(whole.points.size());
  int blocks = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const FemMesh& part = parts[i];
    const Shift& shift = shifts[i];
    const int solid = numbers[i];
    whole.points.insert(whole.points.end(), part.points.begin() + part.corner_count, part.points.end());
    append_rows(whole.hexes, part.hexes, shift);
    append_rows(whole.quads, part.quads, shift);
    append_rows(whole.segments, part.segments, shift);
    if (part.hex_solid.empty()) whole.hex_solid.insert(whole.hex_solid.end(), part.hexes.size(), solid);
    whole.hex_solid.insert(whole.hex_solid.end(), part.hex_solid.begin(), part.hex_solid.end());
    whole.quad_face.insert(whole.quad_face.end(), part.quad_face.begin(), part.quad_face.end());
    whole.segment_edge.insert(whole.segment_edge.end(), part.segment_edge.begin(), part.segment_edge.end());
    for (const auto& [hex, side] : part.quad_hex) whole.quad_hex.push_back({hex + shift.elements[3], side});
    for (const int block : part.hex_block) whole.hex_block.push_back(block + blocks);
    if (!part.hex_block.empty()) blocks += *std::max_element(part.hex_block.begin(), part.hex_block.end()) + 1;
    for (const int node : part.straight_nodes) whole.straight_nodes.push_back(shift.node(node));
    groups.push_back(shifted_groups(part, shift, solid));
  }
  std::sort(whole.straight_nodes.begin(), whole.straight_nodes.end());
  add_groups(whole, groups, numbers, interfaces);
  return whole;
}

}  // namespace polycube
