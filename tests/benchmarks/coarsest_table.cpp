// The paper's Table 1: bench_coarsest PATH... prints a row per CAD part (.step, .brep) and per map (NAME.tet.mesh with NAME.labels and
// NAME.polycuboid.mesh beside it), for backend/quantize/README.md. Seconds are those of blocks, quantize and hex; one thread.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "pipeline/hex_map.h"
#include "pipeline/label_part.h"

namespace polycube {
namespace {

constexpr std::string_view kMap = ".tet.mesh";

PolycuboidInput read(const std::string& path) {
  if (path.ends_with(kMap)) {
    const std::string base = path.substr(0, path.size() - kMap.size());
    return read_polycuboid(path, base + ".labels", base + ".polycuboid.mesh");
  }
  LabelledPart part = label_part(CadModel::read(path), MeshOptions(), Monitor());
  if (part.failure) throw *part.failure;
  return {std::move(part.tets), std::move(part.map)};
}

void print_row(const std::string& path) {
  const std::string file = std::filesystem::path(path).filename().string(), name = file.substr(0, file.find('.'));
  try {
    const PolycuboidInput input = read(path);
    std::printf("| %s | %zu | %zu | ", name.c_str(), input.tets.tets.size(), input.map.charts.size());
    HexMapOptions options;
    options.quantize.scale = 0;
    const HexMapResult r = hex_map(input, options, Monitor());
    std::printf("%zu | %zu | %.2f | %d | %d | %s |\n", r.blocks.blocks.size(), r.hexes.mesh.hexes.size(), r.blocks_seconds + r.quantize_seconds + r.hex_seconds,
                r.quantization.c2_rounds, r.quantization.nodes, r.quantization.optimal ? "proved" : "not proved");
  } catch (const std::exception& e) {
    std::printf("%s: %s\n", name.c_str(), e.what());
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace polycube

int main(int argc, char** argv) {
  std::puts("| model | tets | charts | blocks | hexes | seconds | C2 rounds | nodes | optimum |\n|---|---|---|---|---|---|---|---|---|");
  for (int i = 1; i < argc; ++i) polycube::print_row(argv[i]);
}
