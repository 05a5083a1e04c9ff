// bench_maps FOLDER writes polycuboid maps for compare_highs.py: rows of dents that C2 makes hard, and random polycubes.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "blocks/topology.h"
#include "support/polycubes.h"

namespace polycube {
namespace {

using testing::Example;

void write_medit(const std::string& path, const std::vector<Vec3>& points, const Example& e) {
  std::ofstream out(path);
  out.precision(17);
  out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << points.size() << '\n';
  for (const Vec3& p : points) out << p[0] << ' ' << p[1] << ' ' << p[2] << " 1\n";
  out << "Tetrahedra\n" << e.tets.tets.size() << '\n';
  for (const Tet& t : e.tets.tets) out << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << ' ' << t[3] + 1 << " 1\n";
  out << "End\n";
}

void write_map(const std::string& base, const Example& e) {
  write_medit(base + ".tet.mesh", e.tets.points, e);
  write_medit(base + ".polycuboid.mesh", e.map.image, e);
  const auto sorted = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  std::map<Triangle, int> labels;
  for (const Chart& c : e.map.charts) {
    for (int t : c.triangles) labels[sorted(e.tets.triangles[t])] = 2 * c.axis + (c.sign > 0 ? 0 : 1);
  }
  std::ofstream out(base + ".labels");
  for (const Tet& t : e.tets.tets) {
    for (const auto& f : kTetFacets) {
      const auto at = labels.find(sorted({t[f[0]], t[f[1]], t[f[2]]}));
      out << (at == labels.end() ? -1 : at->second) << '\n';
    }
  }
}

}  // namespace
}  // namespace polycube

int main(int argc, char** argv) {
  using namespace polycube;
  if (argc != 2) {
    std::cerr << "usage: bench_maps FOLDER\n";
    return 1;
  }
  const std::string folder = argv[1];
  std::filesystem::create_directories(folder);
  for (unsigned seed = 0; seed < 3; ++seed) write_map(folder + "/dents" + std::to_string(seed), testing::row_of_dents(12, seed));
  for (unsigned seed = 0; seed < 9; ++seed) {
    std::mt19937 random(900 + seed);
    const testing::Cells cells = seed % 3 == 0   ? testing::drilled_box(random, 12)
                                 : seed % 3 == 1 ? testing::box_tree(random, 26)
                                                 : testing::random_chain(random, 16);
    Example e = testing::tetrahedralise(cells, 1);
    testing::shift_charts(e, random, 0.35);
    write_map(folder + "/random" + std::to_string(seed), e);
  }
}
