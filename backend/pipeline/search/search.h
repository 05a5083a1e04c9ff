// The search for a mesh: which plan is next, which mesh is best, when it is enough. It knows no stage.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/error.h"
#include "core/monitor.h"
#include "pipeline/search/plan.h"

namespace polycube {

/// What a valid mesh is worth.
struct Score {
  int lost_edges = 0, lost_vertices = 0;  ///< of the CAD
  double least = 0;                       ///< scaled Jacobian
  double free_least = 0;                  ///< but for cells that a narrow angle of the CAD holds where they are: no plan makes those better
  bool at_bound = false;                  ///< `least` is what an angle of the CAD allows: no plan comes to more
  bool complete() const { return lost_edges == 0 && lost_vertices == 0; }
};

/// Whether the cells are good, but for those that the CAD holds where they are, or as good as the CAD lets them be.
bool good_cells(const Score& score);

/// More captured edges first (a worst cell below .05 counts as half an edge), then the better worst cell.
bool better(const Score& a, const Score& b);

/// Why a plan came to no valid mesh. Exactly one of the two is set.
struct Failure {
  std::optional<StageFailed> stage;
  std::optional<InvalidInput> input;  ///< the options demand what this plan cannot give
};

/// What a plan has made, finished or not, for those that go on from it. The evaluator alone knows what is inside.
struct Made {
  virtual ~Made() = default;
};

/// What became of a plan.
struct Outcome {
  enum class Kind {
    kMesh,  ///< a valid mesh
    kFailed,
    kDuplicate,  ///< the same as an earlier one: not done again
    kPostponed,  ///< Plan::may_wait, and its labels are doubtful
  };
  Kind kind = Kind::kFailed;
  std::optional<Score> score;  ///< of a mesh
  std::optional<Failure> failure;
  std::shared_ptr<const Made> made;  ///< the mesh, or the draft that a plan that surrenders edges may start from; null where it came to neither
  int faults = 0;                    ///< of a draft that is no mesh: inverted cells and lost edges
  int fits = 0;                      ///< that it took
};

struct Attempt {
  Plan plan;
  Outcome outcome;
};

/// Bounds the work, not the clock, so that results repeat. Counted in fits, which take most of the time.
struct Budget {
  int fits = 10;     ///< over all plans that keep every edge and the surrender of edges: what has not come out by then will not
  int reserved = 5;  ///< of these, kept back for giving up edges while there is no mesh; half of it where there is one
  int patience = 6;  ///< after that many a complete mesh with poor cells is good enough
  int last = 4;      ///< for each of the last ways: around inverted cells, without features, without CAD edges
};

/// The budget of an effort: quick, normal or thorough.
Budget budget_of(const std::string& effort);

/// Tries one plan with at most so many fits; `from`: the draft that a surrender starts from. No side effect that another plan could see. What it throws fails
/// its plan alone, Cancelled aside.
using Evaluate = std::function<Outcome(const Plan&, const Made* from, int fits)>;

/// The plans in order, as far as they are needed: those that keep all CAD edges; then, while there is no mesh, surrender in the draft with fewest faults
/// first, then around its inverted cells, then the last plans. In a hurry, while there is no mesh, of those that keep edges only what has no bounds is tried,
/// and none is given up one by one. Pure: what is next depends on what was done, and the hurry, alone.
class Schedule {
 public:
  Schedule(std::vector<Plan> keeping, std::vector<Plan> last, const Budget& budget);
  /// The next plan and the fits it may take; none where the search is at its end.
  struct Step {
    Plan plan;
    int fits = 0;
  };
  std::optional<Step> next(const std::vector<Attempt>& done, bool hurry = false) const;

 private:
  std::vector<Plan> keeping_, last_;
  Budget budget_;
};

/// True where no other plan is worth trying.
bool good_enough(const Score& score, int fits_done, const Budget& budget);

/// Until when a plan that begins now may go on while there is no mesh: not to the end, or nothing would be left for those that cost less.
Monitor::Clock::time_point deadline_of_plan(Monitor::Clock::time_point now, Monitor::Clock::time_point end);

struct SearchResult {
  Outcome best;
  Plan plan;
  bool out_of_time = false;  ///< the deadline ended the search
  int tried = 0;
};

/// The best mesh. Throws what the plan that came furthest failed by; Cancelled where the user says so, or time is out before there is a mesh; InvalidInput of
/// the first plan at once: it is about what the user demands. `hurry`: whether time runs short; may be empty.
SearchResult search(const Schedule& schedule, const Budget& budget, const Evaluate& evaluate, const Monitor& monitor, const std::function<bool()>& hurry = {});

}  // namespace polycube
