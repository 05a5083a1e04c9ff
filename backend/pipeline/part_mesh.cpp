#include "pipeline/part_mesh.h"

#include "pipeline/pipeline.h"

namespace polycube {
namespace {

double seconds_since(Monitor::Clock::time_point start) {
  return std::chrono::duration<double>(Monitor::Clock::now() - start).count();
}

}  // namespace

Monitor::Clock::time_point finishing_deadline(const MeshReport& report, const Monitor& monitor) {
  return report.out_of_time ? Monitor::Clock::time_point::max() : monitor.deadline();
}

PartMesh mesh_part(const std::function<CadModel()>& read, const MeshOptions& options, const Monitor& monitor) {
  const auto read_start = Monitor::Clock::now();
  const CadModel model = read();
  check(options, model.diagonal(), model.faces(), model.edges());
  const double read_seconds = seconds_since(read_start);
  MeshResult result = mesh(model, options, monitor);
  const auto fem_start = Monitor::Clock::now();
  const Monitor finishing(monitor, finishing_deadline(result.report, monitor));
  PartMesh made{build_fem_mesh(model, result.mesh, result.association, {options.order, options.threads}, finishing),
                std::move(result.report)};
  made.fem.hex_block = std::move(result.hex_block);
  made.report.stages.insert(made.report.stages.begin(), {"read", read_seconds});
  made.report.stages.push_back({"fem", seconds_since(fem_start)});
  complete(made.report, made.fem);
  return made;
}

}  // namespace polycube
