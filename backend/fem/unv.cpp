// I-DEAS universal file: data sets 2411 (nodes), 2412 (elements), 2467 (groups).
#include "core/hexahedron.h"
#include "fem/formats.h"

namespace polycube {
namespace {

enum Element { kRod = 11, kParabolicBeam = 24, kShell = 94, kParabolicShell = 95, kBrick = 115, kParabolicBrick = 116 };

void append_row(std::string& text, const std::vector<int>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    append(text, "%10d", numbers[i]);
    if (i % 8 == 7 || i + 1 == numbers.size()) text += '\n';
  }
}

void append_element(std::string& text, int label, Element kind, const std::vector<int>& nodes) {
  append_row(text, {label, kind, 2, 1, 7, static_cast<int>(nodes.size())});
  if (kind == kRod || kind == kParabolicBeam) append_row(text, {0, 1, 1});
  append_row(text, nodes);
}

/// Corners and mid-edge nodes alternate round each ring; between the rings the nodes of the vertical edges.
std::vector<int> brick_nodes(const std::array<int, 20>& hex, bool quadratic) {
  std::vector<int> nodes;
  for (int ring = 0; ring < 2; ++ring) {
    for (int i = 0; i < 4; ++i) {
      nodes.push_back(hex[4 * ring + i] + 1);
      if (quadratic) nodes.push_back(hex[8 + 4 * ring + i] + 1);
    }
    if (quadratic && ring == 0)
      for (int i = 16; i < 20; ++i) nodes.push_back(hex[i] + 1);
  }
  return nodes;
}

std::vector<int> shell_nodes(const std::array<int, 8>& quad, bool quadratic) {
  std::vector<int> nodes;
  for (int i = 0; i < 4; ++i) {
    nodes.push_back(quad[i] + 1);
    if (quadratic) nodes.push_back(quad[4 + i] + 1);
  }
  return nodes;
}

void append_group(std::string& text, int number, const std::string& name, int kind, const std::vector<int>& labels) {
  append_row(text, {number, 0, 0, 0, 0, 0, 0, static_cast<int>(labels.size())});
  text += name + "\n";
  std::vector<int> entries;
  entries.reserve(labels.size() * 4);
  for (int label : labels) entries.insert(entries.end(), {kind, label, 0, 0});
  append_row(text, entries);
}

}  // namespace

std::string unv_text(const FemMesh& mesh) {
  constexpr int kNodes = 7, kElements = 8;  // entity types of data set 2467
  const bool quadratic = mesh.order == 2;
  // Labels: hexes, then quads, then segments.
  const int quad_base = static_cast<int>(mesh.hexes.size()) + 1, segment_base = quad_base + static_cast<int>(mesh.quads.size());
  std::string text = "    -1\n  2411\n";
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    append_row(text, {static_cast<int>(p) + 1, 1, 1, 11});
    append(text, "%25.16E%25.16E%25.16E\n", mesh.points[p][0], mesh.points[p][1], mesh.points[p][2]);
  }
  text += "    -1\n    -1\n  2412\n";
  for (int s = 0; s < std::ssize(mesh.segments); ++s) {
    const auto& [a, b, middle] = mesh.segments[s];
    if (quadratic) {
      append_element(text, segment_base + s, kParabolicBeam, {a + 1, middle + 1, b + 1});
    } else {
      append_element(text, segment_base + s, kRod, {a + 1, b + 1});
    }
  }
  for (int q = 0; q < std::ssize(mesh.quads); ++q)
    append_element(text, quad_base + q, quadratic ? kParabolicShell : kShell, shell_nodes(mesh.quads[q], quadratic));
  for (int h = 0; h < std::ssize(mesh.hexes); ++h) append_element(text, h + 1, quadratic ? kParabolicBrick : kBrick, brick_nodes(mesh.hexes[h], quadratic));
  text += "    -1\n    -1\n  2467\n";
  int number = 0;
  for (const FemGroup& group : mesh.groups) {
    std::vector<int> nodes = group.nodes, elements = group.elements;
    const int base = group.entity.dim == 3 ? 1 : group.entity.dim == 2 ? quad_base : segment_base;
    for (int& node : nodes) ++node;
    for (int& element : elements) element += base;
    append_group(text, ++number, node_group_name(group), kNodes, nodes);
    if (!elements.empty()) append_group(text, ++number, group_name(group), kElements, elements);
  }
  text += "    -1\n";
  return text;
}

}  // namespace polycube
