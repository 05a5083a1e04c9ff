// From a part to the finite element mesh with its whole report: what the command line, the Python module and jobs make.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "cad/assembly.h"
#include "core/monitor.h"
#include "core/options.h"
#include "core/report.h"
#include "fem/fem.h"
#include "pipeline/session.h"

namespace polycube {

struct PartMesh {
  FemMesh fem;
  MeshReport report;  ///< its stages begin with "read" and end with "fem"
};

/// Reads the part, checks the options against it, meshes it and makes elements of the order asked for. The caller's monitor carries
/// progress, cancel and deadline. Several solids go into one mesh, each with nodes of its own (MeshOptions::interfaces "separate"). Throws what `read` and
/// mesh() throw, with the solid's name where there are several.
PartMesh mesh_part(const std::function<Assembly()>& read, const MeshOptions& options, const Monitor& monitor);
/// The same of one solid.
PartMesh mesh_part(const std::function<CadModel()>& read, const MeshOptions& options, const Monitor& monitor);

/// The same on a part that is there already: its stages begin with what the session has not made before.
PartMesh mesh_part(Session& session, const MeshOptions& options, const Monitor& monitor);

/// A Session for as many solids as there are: one of each that is meshed by itself, and one of those together that have common nodes.
class AssemblySession {
 public:
  /// Throws InvalidInput: options against this part.
  AssemblySession(Assembly assembly, const MeshOptions& options);
  AssemblySession(const AssemblySession&) = delete;
  AssemblySession& operator=(const AssemblySession&) = delete;
  ~AssemblySession();
  void prepare(const Monitor& monitor);
  PartMesh mesh(const MeshOptions& options, const Monitor& monitor);
  LabelledPart labels(const MeshOptions& options, const Monitor& monitor, Until until = Until::kLabels);
  int count(const MeshOptions& options, const Monitor& monitor);
  int face_count() const { return assembly_.faces().back(); }  ///< the largest number

 private:
  friend PartMesh mesh_part(const std::function<Assembly()>& read, const MeshOptions& options, const Monitor& monitor);
  struct Unit;
  void check_options(const MeshOptions& options) const;
  /// Numbers of solids that are meshed together, made when they are first asked for.
  Unit& unit(const std::vector<int>& solids, const Monitor& monitor);
  /// Without `keep` what each solid needed is given up once it is meshed.
  PartMesh mesh_and_keep(const MeshOptions& options, const Monitor& monitor, bool keep);
  PartMesh mesh_all(const MeshOptions& options, const Monitor& monitor, bool keep);

  Assembly assembly_;
  MeshOptions first_;
  std::unique_ptr<Session> one_;
  std::map<std::vector<int>, std::unique_ptr<Unit>> units_;
};

/// For what is left to do with a mesh: one that the time limit ended the search for is handed out all the same, so there is no deadline
/// then.
Monitor::Clock::time_point finishing_deadline(const MeshReport& report, const Monitor& monitor);

}  // namespace polycube
