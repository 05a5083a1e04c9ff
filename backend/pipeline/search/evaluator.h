// A plan through the real stages.
#pragma once

#include <functional>

#include "pipeline/pipeline.h"
#include "pipeline/pose.h"
#include "pipeline/search/search.h"
#include "pipeline/structures.h"

namespace polycube {

/// The real stages behind Evaluate (search.h), on what the structures hold.
class Evaluator {
 public:
  /// Works in the pose; `options` are those of the pose too. Keeps references to all of them. While `hurry` holds any valid mesh is good enough.
  Evaluator(
      const Pose& pose, const MeshOptions& options, Structures& structures, StageClock& clock, const Monitor& monitor,
      std::function<bool()> hurry = [] { return false; });
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;
  ~Evaluator();

  /// Best first. Throws InvalidInput and what making tetrahedra throws, StageFailed aside.
  std::vector<LabelVariant> label_order();
  /// As Evaluate (search.h) says; throws what the stages throw.
  Outcome evaluate(const Plan& plan, const Made* from, int fits);
  /// Hexahedra of a plan's grid with its padding; throws what the stages throw.
  int count(const Plan& plan);
  /// The mesh of an outcome with a score; its report lacks what depends on the part's place, and the warnings of the search.
  MeshResult result(const Outcome& outcome) const;
  /// Seconds that the gate took with the last mesh.
  double gate_seconds() const { return gate_seconds_; }
  /// Whether a plan had more cells than the time left would have been enough for.
  bool pressed() const { return pressed_; }

 private:
  class Work;
  struct Draft;
  using BoundedGrid = std::pair<const Structure*, std::vector<int>>;  // and the integers of its charts
  static const Draft& draft_in(const Outcome& outcome);

  const Pose& pose_;
  const CadModel& model_;
  const MeshOptions& options_;
  const Monitor& monitor_;
  double size_;
  std::vector<char> ignored_;  // per CAD edge: the user does without it
  int threads_;
  StageClock& clock_;
  Structures& structures_;
  std::function<bool()> hurry_;
  double gate_seconds_ = 0;
  bool pressed_ = false;
  std::vector<BoundedGrid> bounded_grids_;  // of plans done
};

}  // namespace polycube
