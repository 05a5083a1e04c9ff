#include "pipeline/part_mesh.h"

namespace polycube {
namespace {

double seconds_since(Monitor::Clock::time_point start) {
  return std::chrono::duration<double>(Monitor::Clock::now() - start).count();
}

}  // namespace

Monitor::Clock::time_point finishing_deadline(const MeshReport& report, const Monitor& monitor) {
  return report.out_of_time ? Monitor::Clock::time_point::max() : monitor.deadline();
}

PartMesh mesh_part(Session& session, const MeshOptions& options, const Monitor& monitor) {
  MeshResult result = session.mesh(options, monitor);
  const auto fem_start = Monitor::Clock::now();
  const Monitor finishing(monitor, finishing_deadline(result.report, monitor));
  PartMesh made{build_fem_mesh(session.model(), result.mesh, result.association, {options.order, options.threads}, finishing),
                std::move(result.report)};
  made.fem.hex_block = std::move(result.hex_block);
  made.report.stages.push_back({"fem", seconds_since(fem_start)});
  complete(made.report, made.fem);
  return made;
}

PartMesh mesh_part(const std::function<CadModel()>& read, const MeshOptions& options, const Monitor& monitor) {
  const auto read_start = Monitor::Clock::now();
  Session session(read(), options);
  const double read_seconds = seconds_since(read_start);
  PartMesh made = mesh_part(session, options, monitor);
  made.report.stages.insert(made.report.stages.begin(), {"read", read_seconds});
  return made;
}

}  // namespace polycube
