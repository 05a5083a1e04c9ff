// A plan through the real stages.
#pragma once

#include "pipeline/pipeline.h"
#include "pipeline/pose.h"
#include "pipeline/search/search.h"
#include "pipeline/structures.h"

namespace polycube {

class Evaluator {
 public:
  /// Works in the pose; `options` are those of the pose too. Keeps references to pose, options and monitor.
  Evaluator(const Pose& pose, const MeshOptions& options, const Monitor& monitor);
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;
  ~Evaluator();

  /// Best first. Throws InvalidInput and what making tetrahedra throws, StageFailed aside.
  std::vector<LabelVariant> label_order();
  /// As Evaluate (search.h) says; throws what the stages throw.
  Outcome evaluate(const Plan& plan, const std::shared_ptr<const void>& from, int fits);
  /// The mesh of an outcome with a score; its report lacks what depends on the part's place, and the warnings of the search.
  MeshResult result(const Outcome& outcome) const;
  /// Seconds that the last mesh took from its nodes to its elements: what handing it out will take again.
  double seconds_to_finish() const { return seconds_to_finish_; }

 private:
  class Work;
  struct Draft;

  const Pose& pose_;
  const CadModel& model_;
  const MeshOptions& options_;
  const Monitor& monitor_;
  double size_;
  std::vector<char> ignored_;  // per CAD edge: the user does without it
  int threads_;
  StageClock clock_;
  Structures structures_;
  double seconds_to_finish_ = 0;
};

}  // namespace polycube
