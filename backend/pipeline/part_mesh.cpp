#include "pipeline/part_mesh.h"

#include <cmath>

#include "core/error.h"
#include "fem/join.h"
#include "pipeline/conform_mesh.h"
#include "pipeline/pipeline.h"
#include "pipeline/solids.h"

namespace polycube {
namespace {

double seconds_since(Monitor::Clock::time_point start) { return std::chrono::duration<double>(Monitor::Clock::now() - start).count(); }

}  // namespace

Monitor::Clock::time_point finishing_deadline(const MeshReport& report, const Monitor& monitor) {
  return report.out_of_time ? Monitor::Clock::time_point::max() : monitor.deadline();
}

PartMesh mesh_part(Session& session, const MeshOptions& options, const Monitor& monitor) {
  MeshResult result = session.mesh(options, monitor);
  const auto fem_start = Monitor::Clock::now();
  const Monitor finishing(monitor, finishing_deadline(result.report, monitor));
  PartMesh made{build_fem_mesh(session.model(), result.mesh, result.association, {options.order, options.threads}, finishing), std::move(result.report)};
  made.fem.hex_block = std::move(result.hex_block);
  made.report.stages.push_back({"fem", seconds_since(fem_start)});
  complete(made.report, made.fem);
  return made;
}

namespace {

/// An equal share of the time left for each solid that is left.
Monitor::Clock::time_point share_of(const Monitor& monitor, int solids_left) {
  if (monitor.deadline() == Monitor::Clock::time_point::max()) return monitor.deadline();
  const auto now = Monitor::Clock::now();
  return now + (monitor.deadline() - now) / solids_left;
}

std::string names(const Assembly& assembly, const std::vector<int>& unit) {
  std::string text;
  for (const int s : unit) text += (text.empty() ? "" : ", ") + assembly.name(s);
  return text;
}

ConformalMesh mesh_unit(const Assembly& assembly, const std::vector<int>& unit, const MeshOptions& options, const Monitor& monitor) {
  try {
    if (unit.size() > 1) return mesh_conformally(conform(assembly, unit, monitor), assembly, options, monitor);
    const int s = unit.front();
    const MeshOptions own = without_solids(options_of_solid(options, assembly, s));
    Session session(assembly.solids[static_cast<std::size_t>(s) - 1], own);
    PartMesh made = mesh_part(session, own, monitor);
    return {std::move(made.fem), {{assembly.labels[static_cast<std::size_t>(s) - 1], std::move(made.report)}}};
  } catch (const InvalidInput& e) {
    throw InvalidInput(names(assembly, unit) + ": " + e.what());
  } catch (const StageFailed& e) {
    throw StageFailed(e.stage(), names(assembly, unit) + ": " + e.what() + (unit.size() > 1 ? "; --interfaces separate meshes each solid by itself" : ""),
                      e.entities());
  }
}

/// Words for a number of cells that is not the one asked for.
void tell_count(MeshReport& report, const MeshOptions& options) {
  constexpr double kCountMiss = .15;  // what --hexes promises
  if (options.hexes > 0 && std::abs(report.hexes - options.hexes) > kCountMiss * options.hexes)
    report.warnings.push_back(std::to_string(report.hexes) + " hexahedra where " + std::to_string(options.hexes) + " were asked for");
}

PartMesh mesh_solids(const Assembly& assembly, const MeshOptions& options, const Monitor& monitor) {
  const std::vector<std::vector<int>> units = units_of(assembly, options);
  std::vector<FemMesh> meshes;
  std::vector<int> numbers;
  std::vector<SolidReport> reports(assembly.solids.size());
  int hexes = 0;
  for (std::size_t i = 0; i < units.size(); ++i) {
    monitor.log(names(assembly, units[i]));
    const Monitor own(monitor, share_of(monitor, static_cast<int>(units.size() - i)));
    ConformalMesh made = mesh_unit(assembly, units[i], options, own);
    for (std::size_t k = 0; k < units[i].size(); ++k) {
      SolidReport& report = reports[static_cast<std::size_t>(units[i][k]) - 1];
      report = std::move(made.reports[k]);
      report.first_hex = hexes;
      hexes += report.report.hexes;
    }
    meshes.push_back(std::move(made.fem));
    numbers.push_back(units[i].size() == 1 ? units[i].front() : 0);
  }
  const bool separate = options.interfaces == "separate";
  PartMesh whole{join(meshes, numbers, separate ? assembly.interfaces : std::vector<Interface>()), join(std::move(reports))};
  MeshReport& r = whole.report;
  r.options = options;
  r.nodes = static_cast<int>(whole.fem.points.size());
  for (const Interface& i : assembly.interfaces) r.interfaces.push_back({i.solids, i.faces, i.area});
  r.warnings.insert(r.warnings.begin(), assembly.warnings.begin(), assembly.warnings.end());
  return whole;
}

}  // namespace

PartMesh mesh_part(const std::function<Assembly()>& read, const MeshOptions& options, const Monitor& monitor) {
  const auto read_start = Monitor::Clock::now();
  const Assembly assembly = read();
  check(options, assembly.diagonal(), {assembly.faces(), assembly.edges(), assembly.vertices(), static_cast<int>(assembly.solids.size())});
  PartMesh made;
  double read_seconds = 0;
  if (assembly.solids.size() == 1) {
    Session session(assembly.solids.front(), options);
    read_seconds = seconds_since(read_start);
    made = mesh_part(session, options, monitor);
  } else {
    check_by_solid(options, assembly);
    read_seconds = seconds_since(read_start);
    made = mesh_solids(assembly, options, monitor);
  }
  made.report.stages.insert(made.report.stages.begin(), {"read", read_seconds});
  tell_count(made.report, options);
  return made;
}

AssemblySession::AssemblySession(Assembly assembly, const MeshOptions& options) : assembly_(std::move(assembly)) {
  check(options, assembly_.diagonal(), {assembly_.faces(), assembly_.edges(), assembly_.vertices(), static_cast<int>(assembly_.solids.size())});
  if (assembly_.solids.size() == 1) {
    one_ = std::make_unique<Session>(assembly_.solids.front(), options);
  } else {
    check_by_solid(options, assembly_);
  }
}

void AssemblySession::prepare(const Monitor& monitor) {
  if (one_) one_->prepare(monitor);
}

PartMesh AssemblySession::mesh(const MeshOptions& options, const Monitor& monitor) {
  const auto mesh = [&] {
    if (one_) return mesh_part(*one_, options, monitor);
    check(options, assembly_.diagonal(), {assembly_.faces(), assembly_.edges(), assembly_.vertices(), static_cast<int>(assembly_.solids.size())});
    check_by_solid(options, assembly_);
    return mesh_solids(assembly_, options, monitor);
  };
  PartMesh made = mesh();
  tell_count(made.report, options);
  return made;
}

LabelledPart AssemblySession::labels(const MeshOptions& options, const Monitor& monitor, Until until) {
  return one_ ? one_->labels(options, monitor, until) : label_part(assembly_, options, monitor, until);
}

int AssemblySession::count(const MeshOptions& options, const Monitor& monitor) {
  if (!one_) throw InvalidInput("the cells of several solids are not counted before they are meshed");
  return one_->count(options, monitor);
}

PartMesh mesh_part(const std::function<CadModel()>& read, const MeshOptions& options, const Monitor& monitor) {
  return mesh_part([&] { return Assembly{{read()}, {""}, {}}; }, options, monitor);
}

}  // namespace polycube
