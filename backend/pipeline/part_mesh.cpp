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

template <class Work>
auto named(const Assembly& assembly, const std::vector<int>& unit, const Work& work) {
  try {
    return work();
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

}  // namespace

/// One solid by itself, or several with common nodes.
struct AssemblySession::Unit {
  Unit(const Assembly& whole, const std::vector<int>& solids, const MeshOptions& first, const Monitor& monitor) : assembly(whole), number(solids.front()) {
    if (solids.size() > 1) {
      together = std::make_unique<ConformalSession>(conform(assembly, solids, monitor), assembly, first);
    } else {
      alone = std::make_unique<Session>(assembly.solids[static_cast<std::size_t>(number) - 1], of_solid(first));
    }
  }

  MeshOptions of_solid(const MeshOptions& options) const { return without_solids(options_of_solid(options, assembly, number)); }

  void prepare(const MeshOptions& options, const Monitor& monitor) {
    if (together) {
      together->prepare(options, monitor);
    } else {
      alone->prepare(monitor);
    }
  }

  ConformalMesh mesh(const MeshOptions& options, const Monitor& monitor) {
    if (together) return together->mesh(options, monitor);
    PartMesh made = mesh_part(*alone, of_solid(options), monitor);
    return {std::move(made.fem), {{assembly.labels[static_cast<std::size_t>(number) - 1], std::move(made.report)}}};
  }

  int count(const MeshOptions& options, const Monitor& monitor) {
    return together ? together->count(options, monitor) : alone->count(of_solid(options), monitor);
  }

  const Assembly& assembly;
  int number;  // of the first solid
  std::unique_ptr<ConformalSession> together;
  std::unique_ptr<Session> alone;
};

AssemblySession::AssemblySession(Assembly assembly, const MeshOptions& options) : assembly_(std::move(assembly)), first_(options) {
  check_options(options);
  if (assembly_.solids.size() == 1) one_ = std::make_unique<Session>(assembly_.solids.front(), options);
}

AssemblySession::~AssemblySession() = default;

void AssemblySession::check_options(const MeshOptions& options) const {
  check(options, assembly_.diagonal(), {assembly_.faces(), assembly_.edges(), assembly_.vertices(), static_cast<int>(assembly_.solids.size())});
  if (assembly_.solids.size() > 1) check_by_solid(options, assembly_);
}

AssemblySession::Unit& AssemblySession::unit(const std::vector<int>& solids, const Monitor& monitor) {
  std::unique_ptr<Unit>& unit = units_[solids];
  if (!unit) unit = std::make_unique<Unit>(assembly_, solids, first_, monitor);
  return *unit;
}

void AssemblySession::prepare(const Monitor& monitor) {
  if (one_) return one_->prepare(monitor);
  for (const std::vector<int>& solids : units_of(assembly_, first_)) {
    try {
      named(assembly_, solids, [&] { unit(solids, monitor).prepare(first_, monitor); });
    } catch (const StageFailed& e) {
      monitor.log(e.stage() + ": " + e.what());  // told by mesh()
    }
  }
}

PartMesh AssemblySession::mesh(const MeshOptions& options, const Monitor& monitor) {
  if (!one_) check_options(options);
  return mesh_and_keep(options, monitor, true);
}

PartMesh AssemblySession::mesh_and_keep(const MeshOptions& options, const Monitor& monitor, bool keep) {
  PartMesh made = one_ ? mesh_part(*one_, options, monitor) : mesh_all(options, monitor, keep);
  tell_count(made.report, options);
  return made;
}

PartMesh AssemblySession::mesh_all(const MeshOptions& options, const Monitor& monitor, bool keep) {
  const std::vector<std::vector<int>> units = units_of(assembly_, options);
  std::vector<FemMesh> meshes;
  std::vector<int> numbers;
  std::vector<SolidReport> reports(assembly_.solids.size());
  int hexes = 0;
  for (std::size_t i = 0; i < units.size(); ++i) {
    monitor.log(names(assembly_, units[i]));
    const Monitor own(monitor, share_of(monitor, static_cast<int>(units.size() - i)));
    ConformalMesh made = named(assembly_, units[i], [&] { return unit(units[i], own).mesh(options, own); });
    if (!keep) units_.clear();
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
  PartMesh whole{join(meshes, numbers, separate ? assembly_.interfaces : std::vector<Interface>()), join(std::move(reports))};
  MeshReport& r = whole.report;
  r.options = options;
  r.nodes = static_cast<int>(whole.fem.points.size());
  for (const Interface& i : assembly_.interfaces) r.interfaces.push_back({i.solids, i.faces, i.area});
  r.warnings.insert(r.warnings.begin(), assembly_.warnings.begin(), assembly_.warnings.end());
  return whole;
}

PartMesh mesh_part(const std::function<Assembly()>& read, const MeshOptions& options, const Monitor& monitor) {
  const auto read_start = Monitor::Clock::now();
  AssemblySession session(read(), options);
  const double read_seconds = seconds_since(read_start);
  PartMesh made = session.mesh_and_keep(options, monitor, false);
  made.report.stages.insert(made.report.stages.begin(), {"read", read_seconds});
  return made;
}

LabelledPart AssemblySession::labels(const MeshOptions& options, const Monitor& monitor, Until until) {
  if (one_) return one_->labels(options, monitor, until);
  check_options(options);
  const std::vector<std::vector<int>> units = units_of(assembly_, options);
  if (units.size() > 1)
    throw InvalidInput("of " + std::to_string(assembly_.solids.size()) +
                       " solids that are meshed separately each has axes of its own: look at one of them, or at those that touch");
  return named(assembly_, units.front(), [&] { return unit(units.front(), monitor).together->labels(options, monitor); });
}

int AssemblySession::count(const MeshOptions& options, const Monitor& monitor) {
  if (one_) return one_->count(options, monitor);
  check_options(options);
  int sum = 0;
  for (const std::vector<int>& solids : units_of(assembly_, options))
    sum += named(assembly_, solids, [&] { return unit(solids, monitor).count(options, monitor); });
  return sum;
}

PartMesh mesh_part(const std::function<CadModel()>& read, const MeshOptions& options, const Monitor& monitor) {
  return mesh_part([&] { return Assembly{{read()}, {""}, {}}; }, options, monitor);
}

}  // namespace polycube
