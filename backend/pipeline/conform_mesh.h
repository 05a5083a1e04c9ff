// Solids that touch in meshes with common nodes.
#pragma once

#include <memory>

#include "cad/conformal.h"
#include "core/monitor.h"
#include "core/report.h"
#include "fem/fem.h"
#include "pipeline/conform_structures.h"
#include "pipeline/label_part.h"

namespace polycube {

struct ConformalMesh {
  FemMesh fem;                       ///< groups by the numbers of the assembly
  std::vector<SolidReport> reports;  ///< per solid of the model
};

/// Solids that are meshed several times with common nodes: tetrahedra, labels, maps and blocks are kept from one mesh to the next, as Session keeps those of
/// one solid. `options` are those of the whole assembly, `size` the edge length where a solid has none of its own. All throw StageFailed: of a stage, or of
/// "interfaces" where common nodes are not possible; InvalidInput for demands that only solids by themselves can be held to.
class ConformalSession {
 public:
  /// Keeps a reference to the assembly. `first`: the options given first, whose size bounds that of the tetrahedra.
  ConformalSession(ConformalModel model, const Assembly& assembly, const MeshOptions& first);
  ConformalSession(const ConformalSession&) = delete;
  ConformalSession& operator=(const ConformalSession&) = delete;
  ~ConformalSession();

  /// Makes what the first labelling needs.
  void prepare(const MeshOptions& options, const Monitor& monitor);
  ConformalMesh mesh(const MeshOptions& options, const Monitor& monitor);
  /// How many hexahedra mesh() would make, without the fit.
  int count(const MeshOptions& options, const Monitor& monitor);
  /// Of the first labelling that mesh() tries.
  LabelledPart labels(const MeshOptions& options, const Monitor& monitor);

 private:
  template <class Work>
  auto at_work(const MeshOptions& given, const Monitor& monitor, const Work& work);
  ConformalStructures& structures(const MeshOptions& options, StageClock& clock, const Monitor& monitor);

  ConformalModel model_;
  const Assembly& assembly_;
  double first_size_;
  TetMesh tets_;
  MeshOptions key_;  // of the structures
  std::unique_ptr<ConformalStructures> structures_;
};

}  // namespace polycube
