#include "pipeline/search/search.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <tuple>

#include "pipeline/search/tuning.h"

namespace polycube {
namespace {

bool is_keeping(const Plan& plan) { return plan.surrender == Surrender::kNothing && !plan.last; }

// How far a plan came before it failed.
std::size_t progress_of(const std::string& stage) {
  constexpr std::array kOrder{"cad", "tet", "label", "deform", "blocks", "quantize", "hex", "pad", "fit", "fem"};
  return static_cast<std::size_t>(std::find(kOrder.begin(), kOrder.end(), stage) - kOrder.begin());
}

// Of those that failed, the one that came furthest and left least undone; null if all that failed only repeated others.
const Failure* telling_failure(const std::vector<Attempt>& done) {
  const Attempt* best = nullptr;
  const auto key = [](const Attempt& a) {
    const Failure& f = *a.outcome.failure;
    return std::tuple(f.stage.has_value(), is_keeping(a.plan), f.stage ? progress_of(f.stage->stage()) : 0, -a.outcome.faults);
  };
  for (const Attempt& a : done) {
    if (a.outcome.failure && (!best || key(a) > key(*best))) best = &a;
  }
  return best ? &*best->outcome.failure : nullptr;
}

bool has_surrendered(const std::vector<Attempt>& done, int of, Surrender how) {
  return std::any_of(done.begin(), done.end(), [&](const Attempt& a) { return a.plan.of == of && a.plan.surrender == how; });
}

bool has_draft(const Attempt& a) { return a.outcome.kind == Outcome::Kind::kFailed && a.outcome.made != nullptr; }

Plan surrender(const std::vector<Attempt>& done, int of, Surrender how) {
  Plan plan = done[of].plan;
  plan.name += how == Surrender::kEdges ? " but where cells stay inverted" : " but round cells that stay inverted";
  plan.surrender = how;
  plan.of = of;
  return plan;
}

// Every setting was tried on tetrahedra of that size, finer ones too.
bool without_tets(const std::vector<Attempt>& done, const Plan& plan) {
  return std::any_of(done.begin(), done.end(), [&](const Attempt& a) {
    return a.outcome.failure && a.outcome.failure->stage && a.outcome.failure->stage->stage() == "tet" && plan.structure.tet_size <= a.plan.structure.tet_size;
  });
}

// The latest draft that came from the attempt.
const Made* draft_of(const std::vector<Attempt>& done, int attempt) {
  if (attempt < 0) return nullptr;
  const Made* draft = done[attempt].outcome.made.get();
  for (const Attempt& a : done) {
    if (a.plan.of == attempt && a.outcome.made) draft = a.outcome.made.get();
  }
  return draft;
}

Outcome guarded(const Evaluate& evaluate, const Plan& plan, const Made* from, int fits) {
  Outcome outcome;
  try {
    return evaluate(plan, from, fits);
  } catch (const Cancelled&) {
    throw;
  } catch (const StageFailed& e) {
    outcome.failure = Failure{e, {}};
  } catch (const InvalidInput& e) {
    outcome.failure = Failure{{}, e};
  } catch (const std::bad_alloc&) {
    outcome.failure = Failure{StageFailed("pipeline", "out of memory"), {}};
  } catch (const std::exception& e) {
    outcome.failure = Failure{StageFailed("pipeline", std::string("internal error: ") + e.what()), {}};
  }
  return outcome;
}

std::string told(const Outcome& outcome) {
  switch (outcome.kind) {
    case Outcome::Kind::kMesh:
      return std::to_string(outcome.score->lost_edges) + " CAD edges lost, min SJ " + std::to_string(outcome.score->least);
    case Outcome::Kind::kDuplicate:
      return "the same as one before";
    case Outcome::Kind::kPostponed:
      return "its labels are doubtful, later";
    case Outcome::Kind::kFailed:
      break;
  }
  const Failure& f = *outcome.failure;
  return f.stage ? "failed in " + f.stage->stage() + ": " + f.stage->what() : std::string("failed: ") + f.input->what();
}

}  // namespace

bool better(const Score& a, const Score& b) {
  const auto worth = [](const Score& s) { return std::pair(0.5 * (s.least > kSearchTuning.poor_scaled_jacobian) - s.lost_edges, s.least); };
  return worth(a) > worth(b);
}

bool good_cells(const Score& score) {
  return score.least >= kSearchTuning.good_scaled_jacobian || score.free_least >= kSearchTuning.good_scaled_jacobian || score.at_bound;
}

bool good_enough(const Score& score, int fits_done, const Budget& budget) {
  const bool patient = fits_done >= budget.patience && score.least >= kSearchTuning.good_scaled_jacobian / 2;
  return score.complete() && (patient || good_cells(score));
}

Budget budget_of(const std::string& effort) {
  if (effort == "quick") return {.fits = 4, .reserved = 2, .patience = 2, .last = 2};
  if (effort == "thorough") return {.fits = 24, .reserved = 8, .patience = 18, .last = 8};
  return {};
}

Schedule::Schedule(std::vector<Plan> keeping, std::vector<Plan> last, const Budget& budget)
    : keeping_(std::move(keeping)), last_(std::move(last)), budget_(budget) {}

std::optional<Schedule::Step> Schedule::next(const std::vector<Attempt>& done, bool hurry) const {
  std::vector<Plan> queue = keeping_;
  std::size_t at = 0;
  int left = budget_.fits;
  bool mesh = false;
  std::vector<int> drafts;  // of plans that keep all edges, those with fewest faults first
  for (int i = 0; i < std::ssize(done); ++i) {
    const Attempt& a = done[i];
    mesh = mesh || a.outcome.score;
    if (!a.plan.last && a.plan.surrender != Surrender::kAround) left -= a.outcome.fits;
    if (!is_keeping(a.plan)) continue;
    while (at < queue.size() && queue[at].name != a.plan.name) ++at;  // those in between were without tets
    ++at;
    if (has_draft(a)) drafts.push_back(i);
    if (a.outcome.kind != Outcome::Kind::kPostponed) continue;
    queue.push_back(a.plan);
    queue.back().may_wait = false;
  }
  const bool poor = std::none_of(done.begin(), done.end(), [](const Attempt& a) {
    return a.outcome.score && a.outcome.score->complete() && a.outcome.score->least >= kSearchTuning.squeezed_scaled_jacobian;
  });
  while (at < queue.size() && (without_tets(done, queue[at]) || (queue[at].for_poor && !poor))) ++at;
  if (hurry && !mesh) {
    // What costs least of those that keep all edges, then the last ways.
    while (at < queue.size() && queue[at].bounded) ++at;
    if (at < queue.size()) return Step{queue[at], std::max(left, budget_.last)};
    left = 0;
  }
  if (at < queue.size() && left > (mesh ? budget_.reserved / 2 : budget_.reserved)) return Step{queue[at], left};
  if (mesh) return {};

  std::stable_sort(drafts.begin(), drafts.end(), [&](int a, int b) { return done[a].outcome.faults < done[b].outcome.faults; });
  for (const int d : drafts) {
    if (left > 0 && !has_surrendered(done, d, Surrender::kEdges)) return Step{surrender(done, d, Surrender::kEdges), left};
  }
  if (!drafts.empty() && !has_surrendered(done, drafts.front(), Surrender::kAround)) {
    return Step{surrender(done, drafts.front(), Surrender::kAround), budget_.last};
  }
  for (const Plan& plan : last_) {
    const auto tried = std::find_if(done.begin(), done.end(), [&](const Attempt& a) { return a.plan.name == plan.name; });
    if (tried == done.end()) {
      if (without_tets(done, plan)) continue;
      return Step{plan, budget_.last};
    }
    const int index = static_cast<int>(tried - done.begin()), rest = budget_.last - tried->outcome.fits;
    if (has_draft(*tried) && rest > 0 && !has_surrendered(done, index, Surrender::kEdges)) return Step{surrender(done, index, Surrender::kEdges), rest};
  }
  return {};
}

Monitor::Clock::time_point deadline_of_plan(Monitor::Clock::time_point now, Monitor::Clock::time_point end) {
  if (end == Monitor::Clock::time_point::max() || now >= end) return end;
  return now + std::chrono::duration_cast<Monitor::Clock::duration>(kSearchTuning.time_share * std::chrono::duration<double>(end - now));
}

SearchResult search(const Schedule& schedule, const Budget& budget, const Evaluate& evaluate, const Monitor& monitor, const std::function<bool()>& hurry) {
  std::vector<Attempt> done;
  std::optional<std::size_t> best;
  bool out_of_time = false;
  int fits = 0;
  while (const std::optional<Schedule::Step> step = schedule.next(done, hurry && hurry())) {
    monitor.log("plan " + std::to_string(done.size() + 1) + ", '" + step->plan.name + "', " + std::to_string(fits) + " fits done, " +
                (best ? "best: '" + done[*best].plan.name + "', " + told(done[*best].outcome) : std::string("no mesh yet")));
    try {
      done.push_back({step->plan, guarded(evaluate, step->plan, draft_of(done, step->plan.of), step->fits)});
    } catch (const OutOfTime&) {
      if (!best) throw;
      out_of_time = true;
      break;
    }
    const Attempt& last = done.back();
    monitor.log("plan '" + last.plan.name + "': " + told(last.outcome));
    fits += last.outcome.fits;
    if (done.size() == 1 && last.outcome.failure && last.outcome.failure->input) throw InvalidInput(*last.outcome.failure->input);
    if (!last.outcome.score) continue;
    if (!best || better(*last.outcome.score, *done[*best].outcome.score)) best = done.size() - 1;
    if (good_enough(*done[*best].outcome.score, fits, budget)) break;
  }
  if (best) return {done[*best].outcome, done[*best].plan, out_of_time, static_cast<int>(done.size())};
  const Failure* failure = telling_failure(done);
  if (!failure) throw StageFailed("pipeline", "no plan is left");
  if (failure->input) throw InvalidInput(*failure->input);
  throw StageFailed(*failure->stage);
}

}  // namespace polycube
