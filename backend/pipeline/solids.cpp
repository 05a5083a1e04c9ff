#include "pipeline/solids.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/union_find.h"

namespace polycube {
namespace {

bool has(const std::vector<int>& numbers, int id) { return std::binary_search(numbers.begin(), numbers.end(), id); }

}  // namespace

MeshOptions options_of_solid(const MeshOptions& options, const Assembly& assembly, int solid) {
  const CadModel& model = assembly.solids.at(static_cast<std::size_t>(solid) - 1);
  MeshOptions own = options;
  const auto other_face = [&](int face) { return face > 0 && !has(model.faces(), face); };
  std::erase_if(own.labels, [&](const auto& label) { return other_face(label.first); });
  std::erase_if(own.keep_faces, other_face);
  std::erase_if(own.divisions, [&](const Division& d) {
    if (d.solid > 0) return d.solid != solid;
    return d.edge > 0 ? !has(model.edges(), d.edge) : other_face(d.faces[0]);
  });
  std::erase_if(own.refine, [&](const LocalRefinement& r) {
    if (r.entity.dim == 3) return r.entity.id != solid;
    const std::vector<int>& numbers = r.entity.dim == 2 ? model.faces() : r.entity.dim == 1 ? model.edges() : model.vertices();
    return !has(numbers, r.entity.id);
  });
  std::erase_if(own.bias, [&](const EdgeBias& b) { return !has(model.edges(), b.edge); });
  std::erase_if(own.sizes, [&](const LocalSize& s) { return s.solid > 0 ? s.solid != solid : other_face(s.face); });
  const auto by_solid = std::find_if(own.sizes.begin(), own.sizes.end(), [](const LocalSize& s) { return s.solid > 0; });
  if (by_solid == own.sizes.end() && !own.coarsest) {
    if (own.hexes > 0) {
      own.hexes = std::max(1, static_cast<int>(std::lround(own.hexes * model.volume() / assembly.volume())));
    } else {
      own.size = own.size > 0 ? std::min(own.size, model.diagonal()) : 0;
    }
  }
  return own;
}

MeshOptions without_solids(const MeshOptions& options) {
  MeshOptions plain = options;
  std::erase_if(plain.sizes, [&](const LocalSize& s) {
    if (s.solid == 0) return false;
    plain.size = s.size;
    plain.hexes = 0;
    return true;
  });
  std::erase_if(plain.divisions, [&](const Division& d) {
    if (d.solid == 0) return false;
    plain.min_layers = std::max(plain.min_layers, d.at_least);
    return true;
  });
  for (LocalRefinement& r : plain.refine) {
    if (r.entity.dim == 3) r.entity.id = 1;
  }
  return plain;
}

void check_by_solid(const MeshOptions& options, const Assembly& assembly) {
  for (const Division& d : options.divisions) {
    if (d.edge > 0 || d.solid > 0) continue;
    const bool together = std::any_of(assembly.solids.begin(), assembly.solids.end(),
                                      [&](const CadModel& solid) { return has(solid.faces(), d.faces[0]) && has(solid.faces(), d.faces[1]); });
    if (!together) throw InvalidInput("--divisions: " + text_of(d) + ": the faces belong to different solids");
  }
}

std::vector<std::vector<int>> units_of(const Assembly& assembly, const MeshOptions& options) {
  const int count = static_cast<int>(assembly.solids.size());
  UnionFind same(assembly.solids.size());
  if (options.interfaces == "conform")
    for (const Interface& i : assembly.interfaces) same.unite(i.solids[0] - 1, i.solids[1] - 1);
  std::vector<std::vector<int>> units(assembly.solids.size());
  for (int s = 0; s < count; ++s) units[static_cast<std::size_t>(same.find(s))].push_back(s + 1);
  std::erase_if(units, [](const auto& unit) { return unit.empty(); });
  return units;
}

}  // namespace polycube
