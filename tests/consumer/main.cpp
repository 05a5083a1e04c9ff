// Meshes a file and says how many hexahedra there are. Includes every header that is meant for others.
#include <cstdio>

#include "pipeline/hex_map.h"
#include "pipeline/inspect.h"
#include "pipeline/label_part.h"
#include "pipeline/part_mesh.h"
#include "pipeline/pipeline.h"

int main(int, char** argv) {
  polycube::MeshOptions options;
  options.size = 1;
  const polycube::Monitor monitor;
  const polycube::PartMesh made = polycube::mesh_part([&] { return polycube::CadModel::read(argv[1], {}, monitor); }, options, monitor);
  std::printf("%zu hexahedra\n", made.fem.hexes.size());
}
