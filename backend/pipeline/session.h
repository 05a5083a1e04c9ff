// A part that is meshed several times: what does not depend on counts and sizes is made once.
#pragma once

#include <memory>

#include "pipeline/label_part.h"
#include "pipeline/pipeline.h"

namespace polycube {

/// Keeps tetrahedra, labels, maps and blocks from one mesh to the next. They are those of the options given first (a size or a number of hexahedra there bounds
/// the size of the tetrahedra), and made anew when an option changes that they depend on: labels, frame, feature_angle, keep_faces, fidelity, compactness, a
/// size along an axis; of these only the frame takes other tetrahedra. A mesh depends on what was given first and on its own options, not on the meshes in
/// between. Not for several threads at once.
class Session {
 public:
  /// Throws InvalidInput: options against this part.
  Session(CadModel model, const MeshOptions& options);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session();

  /// Makes what the first plan needs; otherwise the first mesh does. Throws InvalidInput, Cancelled; what fails in a stage is told by mesh().
  void prepare(const Monitor& monitor);
  /// As mesh(model, options, monitor).
  MeshResult mesh(const MeshOptions& options, const Monitor& monitor);
  /// As label_part(), on the tetrahedra that there are; the map, where it is asked for, is the one that mesh() takes for these labels.
  LabelledPart labels(const MeshOptions& options, const Monitor& monitor, Until until = Until::kLabels);
  /// How many hexahedra mesh() would make, without the fit, which takes most of the time: those of the first plan that comes to a grid, with the padding that
  /// promises most after a first look. Where no fit makes a good mesh of it, mesh() goes on to others. Throws as mesh().
  int count(const MeshOptions& options, const Monitor& monitor);
  const CadModel& model() const { return model_; }

 private:
  struct Posed;
  struct Prepared;
  /// Follows the monitor; seconds of stages count from here.
  Prepared& prepared(const MeshOptions& options, const Monitor& monitor);

  CadModel model_;
  MeshOptions first_;
  std::unique_ptr<Posed> posed_;
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace polycube
