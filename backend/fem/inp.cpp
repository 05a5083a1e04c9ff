// CalculiX and Abaqus input: nodes, one element block, node and element sets and a surface for CAD entities.
#include <array>
#include <charconv>

#include "core/error.h"
#include "fem/formats.h"

namespace polycube {
namespace {

/// Numbers 16 to a line, the longest that CalculiX reads.
template <typename Range>
void append_set(std::string& text, const Range& numbers) {
  constexpr int kPerLine = 16;
  int column = 0;
  for (int number : numbers) {
    append(text, column == 0 ? "%d" : ", %d", number);
    if (++column < kPerLine) continue;
    text += ",\n";
    column = 0;
  }
  if (column > 0) text += '\n';
}

/// CalculiX reads 20 characters of a number and cuts off the rest, exponent and all: the shortest exact text, or one with 13 digits.
void append_number(std::string& text, double number) {
  constexpr std::ptrdiff_t kWidth = 20;
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  if (end - buffer <= kWidth) {
    text.append(buffer, end);
  } else {
    append(text, "%.13g", number);
  }
}

std::vector<int> plus_one(std::vector<int> numbers) {
  for (int& number : numbers) ++number;
  return numbers;
}

}  // namespace

std::string inp_text(const FemMesh& mesh, const std::string& element_type) {
  const bool quadratic = element_type.rfind("C3D20", 0) == 0;
  if (quadratic != (mesh.order == 2)) throw InvalidInput("element type " + element_type + " does not fit a mesh of order " + std::to_string(mesh.order));
  std::string text =
      "** Hexahedral mesh by Polycube. Lengths in mm.\n"
      "** CAD face 3: node set Face3, surface Face3_Surface, elements Face3_Elements; those whose side S1 is on it, Face3_S1.\n"
      "** The solid: elements Solid1, nodes Solid1_Nodes.\n";
  if (!mesh.hex_solid.empty())
    text +=
        "** Of a face that Solid1 and Solid2 share: Solid1_Face3 what Solid1 has of it. Solid1_Solid2_Surface: all faces of Solid1 that touch Solid2;\n"
        "** *TIE and *CONTACT PAIR take Solid1_Solid2_Surface and Solid2_Solid1_Surface.\n";
  text += "*NODE, NSET=Nall\n";
  text.reserve(mesh.points.size() * 80 + mesh.hexes.size() * 160);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    append(text, "%zu", p + 1);
    for (double x : mesh.points[p]) {
      text += ", ";
      append_number(text, x);
    }
    text += '\n';
  }
  text += "*ELEMENT, TYPE=" + element_type + ", ELSET=Eall\n";
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    append(text, "%zu", h + 1);
    for (int i = 0; i < hex_nodes(mesh); ++i) append(text, i == 15 ? ",\n%d" : ", %d", mesh.hexes[h][i] + 1);
    text += '\n';
  }
  for (const FemGroup& group : mesh.groups) {
    // CalculiX takes a surface for the element set of its name and then loads nothing: no two of these names are equal.
    const std::string name = group_name(group);
    text += "*NSET, NSET=" + (group.entity.dim == 3 ? node_group_name(group) : name) + "\n";
    append_set(text, plus_one(group.nodes));
    if (group.entity.dim == 3) {
      text += "*ELSET, ELSET=" + name + "\n";
      append_set(text, plus_one(group.elements));
    }
    if (group.entity.dim != 2) continue;
    std::vector<int> cells;
    std::array<std::vector<int>, 6> by_side;
    for (const auto& [hex, side] : group.sides) {
      cells.push_back(hex + 1);
      by_side[side].push_back(cells.back());
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    text += "*ELSET, ELSET=" + name + "_Elements\n";
    append_set(text, cells);
    // *FILM takes no surface: it wants the elements by their side.
    for (int side = 0; side < 6; ++side) {
      if (by_side[side].empty()) continue;
      text += "*ELSET, ELSET=" + name + "_S" + std::to_string(side + 1) + "\n";
      append_set(text, by_side[side]);
    }
    text += "*SURFACE, NAME=" + name + "_Surface, TYPE=ELEMENT\n";
    for (const auto& [hex, side] : group.sides) append(text, "%d, S%d\n", hex + 1, side + 1);
  }
  return text;
}

}  // namespace polycube
