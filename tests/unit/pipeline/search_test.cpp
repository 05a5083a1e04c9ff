// The search with stages that are not real: outcomes are looked up by the names of plans.
#include "pipeline/search/search.h"

#include <gtest/gtest.h>

#include <map>

namespace polycube {
namespace {

using Kind = Outcome::Kind;

struct Numbered : Made {
  explicit Numbered(int n) : number(n) {}
  int number;
};

Outcome mesh(Score score, int fits = 1) {
  Outcome o;
  o.kind = Kind::kMesh;
  o.score = score;
  o.fits = fits;
  o.made = std::make_shared<const Numbered>(0);
  return o;
}

Outcome skipped(Kind kind) {
  Outcome o;
  o.kind = kind;
  return o;
}

Outcome failed(const std::string& stage, const std::string& reason = "of old age", std::vector<CadRef> entities = {}) {
  Outcome o;
  o.failure = Failure{StageFailed(stage, reason, std::move(entities)), {}};
  return o;
}

/// A mesh with inverted cells; `number` tells drafts apart.
Outcome inverted(int faults, int number, int fits = 1) {
  Outcome o = failed("fit", std::to_string(faults) + " cells stay inverted", {{2, number}});
  o.faults = faults;
  o.fits = fits;
  o.made = std::make_shared<const Numbered>(number);
  return o;
}

Plan keeping(const std::string& name, double tet_size = 1) {
  Plan plan{.name = name, .may_wait = true};
  plan.structure.tet_size = tet_size;
  return plan;
}

/// A script of outcomes by plan; what is not in it fails in deform. Notes what was asked.
struct Stages {
  std::map<std::string, Outcome> outcomes;
  std::map<std::string, std::function<void()>> deeds{};
  std::vector<std::string> asked{};
  std::map<std::string, int> fits{}, from{};

  Outcome operator()(const Plan& plan, const Made* draft, int allowed) {
    const std::string key = plan.name + (plan.may_wait || plan.surrender != Surrender::kNothing || plan.last ? "" : " again");
    asked.push_back(key);
    fits[key] = allowed;
    if (draft) from[key] = static_cast<const Numbered*>(draft)->number;
    if (const auto deed = deeds.find(key); deed != deeds.end()) deed->second();
    const auto found = outcomes.find(key);
    return found != outcomes.end() ? found->second : failed("deform");
  }
};

using Names = std::vector<std::string>;

struct Search {
  std::vector<Plan> plans{keeping("a"), keeping("b"), keeping("c", 0.8)};
  std::vector<Plan> last{{.name = "y", .last = true}, {.name = "z", .structure = {.tet_size = 0.8}, .last = true}};
  Budget budget{};
  Monitor monitor{};
  Stages stages{};

  std::function<bool()> hurry{};

  SearchResult run() {
    return search(
        Schedule(plans, last, budget), budget, [this](const Plan& p, const Made* d, int f) { return stages(p, d, f); }, monitor, hurry);
  }
  /// The failure that it ends in.
  StageFailed failure() {
    try {
      run();
    } catch (const StageFailed& e) {
      return e;
    }
    throw std::logic_error("no failure");
  }
};

constexpr Score kFine{0, 0, 0.4, 0.4};

TEST(Search, AGoodMeshEndsIt) {
  Search s;
  s.stages.outcomes["a"] = mesh(kFine);
  EXPECT_EQ(s.run().plan.name, "a");
  EXPECT_EQ(s.stages.asked, Names{"a"});
}

TEST(Search, InAHurryAnyMeshIsLookedFor) {
  Search s;
  s.stages.outcomes = {{"a", inverted(3, 1)}, {"b", mesh(kFine)}, {"z", mesh({4, 0, 0.3, 0.3})}};
  s.hurry = [&] { return !s.stages.asked.empty(); };
  EXPECT_EQ(s.run().plan.name, "b");  // what time is left goes to better ones
  EXPECT_EQ(s.stages.asked, (Names{"a", "a but round cells that stay inverted", "y", "z", "b"}));
}

TEST(Search, InAHurryWhatKeepsAllEdgesAndCostsLeastComesFirst) {
  Search s;
  s.plans[2].bounded = false;
  s.plans[2].for_poor = true;
  s.stages.outcomes = {{"a", inverted(3, 1)}, {"c", mesh(kFine)}};
  s.hurry = [&] { return !s.stages.asked.empty(); };
  EXPECT_EQ(s.run().plan.name, "c");
  EXPECT_EQ(s.stages.asked, (Names{"a", "c"}));
}

TEST(Search, AHurryLeavesAMeshTheTimeToGetBetter) {
  Search s;
  s.stages.outcomes = {{"a", mesh({1, 0, 0.3, 0.3})}, {"b", mesh(kFine)}};
  s.hurry = [&] { return !s.stages.asked.empty(); };
  EXPECT_EQ(s.run().plan.name, "b");
}

TEST(Search, TheBestOfPoorMeshesWins) {
  Search s;
  s.stages.outcomes = {{"a", mesh({1, 0, 0.3, 0.3})}, {"b", mesh({0, 0, 0.08, 0.08})}, {"c", mesh({0, 0, 0.06, 0.06})}};
  EXPECT_EQ(s.run().plan.name, "b");
  EXPECT_EQ(s.stages.asked, (Names{"a", "b", "c"}));
}

TEST(Search, APlanForPoorMeshesIsForThoseAlone) {
  constexpr Score kSqueezed{0, 0, 0.08, 0.08}, kIncomplete{2, 0, 0.3, 0.3}, kFair{0, 0, 0.15, 0.15};
  for (const auto& [first, poor] : {std::pair(kSqueezed, true), std::pair(kIncomplete, true), std::pair(kFair, false)}) {
    Search s;
    s.plans[1].for_poor = true;
    s.stages.outcomes = {{"a", mesh(first)}, {"b", mesh({0, 0, 0.17, 0.17})}, {"c", mesh({0, 0, 0.06, 0.06})}};
    EXPECT_EQ(s.run().plan.name, poor ? "b" : "a");
    EXPECT_EQ(s.stages.asked, poor ? (Names{"a", "b", "c"}) : (Names{"a", "c"}));
  }
}

TEST(Search, AMeshWithAWorseCellMayKeepMoreEdges) {
  EXPECT_TRUE(better({0, 0, 0.1, 0.1}, {1, 0, 0.5, 0.5}));
  EXPECT_TRUE(better({0, 0, 0.3, 0.3}, {0, 0, 0.2, 0.2}));
  EXPECT_TRUE(better({0, 0, 0.01, 0.01}, {1, 0, 0.5, 0.5}));  // half an edge
  EXPECT_FALSE(better({1, 0, 0.3, 0.3}, {1, 0, 0.3, 0.3}));
}

TEST(Search, PatienceWithPoorCellsEnds) {
  const Budget budget;
  const Score poor{0, 0, 0.15, 0.15}, narrow{0, 0, 0.03, 0.3}, lost{1, 0, 0.9, 0.9};
  EXPECT_FALSE(good_enough(poor, 0, budget));
  EXPECT_TRUE(good_enough(poor, budget.patience, budget));
  EXPECT_TRUE(good_enough(narrow, 0, budget));  // the CAD holds its worst cell
  const Score at_bound{.least = 0.06, .free_least = 0.11, .at_bound = true},
      lost_at_bound{.lost_edges = 1, .least = 0.06, .free_least = 0.11, .at_bound = true};
  EXPECT_TRUE(good_enough(at_bound, 0, budget));  // no plan makes the worst cell better
  EXPECT_FALSE(good_enough(lost_at_bound, 0, budget));
  EXPECT_FALSE(good_enough(lost, 100, budget));
}

// A finer grid may have too many cells; the mesh that is there stays.
TEST(Search, InvalidInputOfALaterPlanKeepsTheMesh) {
  Search s;
  s.stages.outcomes = {{"a", mesh({1, 0, 0.3, 0.3})}};
  s.stages.deeds["b"] = [] { throw InvalidInput("too many cells"); };
  EXPECT_EQ(s.run().plan.name, "a");
  EXPECT_EQ(s.stages.asked, (Names{"a", "b", "c"}));
}

TEST(Search, InvalidInputOfTheFirstPlanIsTheUsersAtOnce) {
  Search s;
  s.stages.deeds["a"] = [] { throw InvalidInput("contradicts itself"); };
  EXPECT_THROW(s.run(), InvalidInput);
  EXPECT_EQ(s.stages.asked, Names{"a"});
}

TEST(Search, AnInternalErrorOfOnePlanIsNotTheEnd) {
  Search s;
  s.stages.deeds = {{"a", [] { throw std::out_of_range("vector"); }}, {"b", [] { throw std::bad_alloc(); }}};
  s.stages.outcomes = {{"c", mesh(kFine)}};
  EXPECT_EQ(s.run().plan.name, "c");
}

TEST(Search, CancelAloneLeavesIt) {
  Search s;
  s.stages.outcomes = {{"a", mesh({1, 0, 0.3, 0.3})}};
  s.stages.deeds["b"] = [] { throw Cancelled("cancelled"); };
  EXPECT_THROW(s.run(), Cancelled);
}

TEST(Search, WithoutAMeshNoPlanMayTakeAllTheTime) {
  const Monitor::Clock::time_point now{std::chrono::seconds(1000)}, end = now + std::chrono::seconds(100);
  EXPECT_EQ(deadline_of_plan(now, end), now + std::chrono::seconds(70));
  EXPECT_EQ(deadline_of_plan(end, end), end);
  EXPECT_EQ(deadline_of_plan(now, Monitor::Clock::time_point::max()), Monitor::Clock::time_point::max());
}

TEST(Search, OutOfTimeGivesTheBestSoFar) {
  Search s;
  s.stages.outcomes = {{"a", mesh({1, 0, 0.3, 0.3})}};
  s.stages.deeds["b"] = [] { throw OutOfTime("out of time"); };
  const SearchResult found = s.run();
  EXPECT_EQ(found.plan.name, "a");
  EXPECT_TRUE(found.out_of_time);
  s.stages.outcomes.clear();
  EXPECT_THROW(s.run(), OutOfTime);
}

// Tets of size x .8 may fail while there are drafts to give up edges in.
TEST(Search, WithoutFinerTetsTheDraftsAreStillThere) {
  Search s;
  s.stages.outcomes = {{"a", inverted(7, 1)}, {"c", failed("tet")}, {"a but where cells stay inverted", mesh({2, 0, 0.3, 0.3})}};
  EXPECT_EQ(s.run().plan.name, "a but where cells stay inverted");
}

TEST(Search, WithoutTetsNothingElseIsTried) {
  Search s;
  s.stages.outcomes = {{"a", failed("tet", "no tetrahedra")}};
  EXPECT_STREQ(s.failure().what(), "no tetrahedra");
  EXPECT_EQ(s.stages.asked, Names{"a"});
}

TEST(Search, DoubtfulLabelsWait) {
  Search s;
  s.stages.outcomes = {{"a", skipped(Kind::kPostponed)}, {"a again", mesh(kFine)}};
  EXPECT_EQ(s.run().plan.name, "a");
  EXPECT_EQ(s.stages.asked, (Names{"a", "b", "c", "a again"}));
}

TEST(Search, EdgesAreGivenUpInTheBestDraftFirst) {
  Search s;
  s.stages.outcomes = {{"a", inverted(9, 1)}, {"b", inverted(2, 2)}};
  s.failure();
  const Names wanted{"a", "b", "c", "b but where cells stay inverted", "a but where cells stay inverted", "b but round cells that stay inverted", "y", "z"};
  EXPECT_EQ(s.stages.asked, wanted);
  EXPECT_EQ(s.stages.from["b but where cells stay inverted"], 2);
  EXPECT_EQ(s.stages.from["a but where cells stay inverted"], 1);
}

TEST(Search, RoundInvertedCellsItGoesOnFromTheLatestDraft) {
  Search s;
  s.stages.outcomes = {{"a", inverted(9, 1)}, {"a but where cells stay inverted", inverted(4, 5)}};
  s.failure();
  EXPECT_EQ(s.stages.from["a but round cells that stay inverted"], 5);
  EXPECT_EQ(s.stages.fits["a but round cells that stay inverted"], s.budget.last);
}

TEST(Search, TheLastWaysGiveUpEdgesToo) {
  Search s;
  s.stages.outcomes = {{"y", inverted(3, 8, 1)}, {"y but where cells stay inverted", mesh({5, 1, 0.2, 0.2})}};
  EXPECT_EQ(s.run().plan.name, "y but where cells stay inverted");
  EXPECT_EQ(s.stages.fits["y"], s.budget.last);
  EXPECT_EQ(s.stages.fits["y but where cells stay inverted"], s.budget.last - 1);
  EXPECT_EQ(s.stages.from["y but where cells stay inverted"], 8);
}

TEST(Search, FitsAreKeptForGivingUpEdges) {
  Search s;
  s.stages.outcomes = {{"a", inverted(3, 1, s.budget.fits - s.budget.reserved)}};
  s.failure();
  EXPECT_EQ(s.stages.asked[1], "a but where cells stay inverted");
  EXPECT_EQ(s.stages.fits["a but where cells stay inverted"], s.budget.reserved);
  s.stages.asked.clear();
  s.stages.outcomes = {{"a", inverted(3, 1, s.budget.fits)}};
  s.failure();
  EXPECT_EQ(s.stages.asked, (Names{"a", "a but round cells that stay inverted", "y", "z"}));
}

// "The same as one before" says nothing; nor does what came less far.
TEST(Search, TheFailureThatCameFurthestIsTold) {
  Search s;
  s.stages.outcomes = {{"a", skipped(Kind::kDuplicate)}, {"b", inverted(7, 3)}, {"c", failed("label", "no labels")}};
  const StageFailed e = s.failure();
  EXPECT_EQ(e.stage(), "fit");
  EXPECT_STREQ(e.what(), "7 cells stay inverted");
  ASSERT_EQ(e.entities().size(), 1u);
  EXPECT_EQ(e.entities()[0], (CadRef{2, 3}));
}

TEST(Search, OfEqualFailuresTheOneWithFewestFaultsIsTold) {
  Search s;
  s.stages.outcomes = {{"a", inverted(7, 1)}, {"b", inverted(2, 2)}};
  EXPECT_STREQ(s.failure().what(), "2 cells stay inverted");
}

TEST(Search, EffortBoundsTheWork) {
  const Budget quick = budget_of("quick"), normal = budget_of("normal"), thorough = budget_of("thorough");
  EXPECT_LT(quick.fits, normal.fits);
  EXPECT_LT(normal.fits, thorough.fits);
  for (const Budget& b : {quick, normal, thorough}) {
    EXPECT_LE(b.reserved, b.fits);
    EXPECT_LE(b.patience, b.fits);
  }
}

TEST(Plans, KeepEveryEdgeInOrder) {
  std::vector<LabelVariant> labels(6);
  for (int i = 0; i < 6; ++i) labels[i].frame = i;
  const std::vector<Plan> plans = keeping_plans({}, labels);
  ASSERT_EQ(plans.size(), 10u);
  std::vector<int> frames;
  for (const Plan& p : plans) frames.push_back(p.structure.labels.frame);
  EXPECT_EQ(frames, (std::vector{0, 1, 0, 0, 0, 1, 2, 3, 0, 1}));
  EXPECT_TRUE(plans[2].bounded && !plans[2].layered && plans[2].for_poor);
  EXPECT_TRUE(!plans[3].bounded && plans[3].for_poor);
  EXPECT_GT(plans[4].refine, 1);
  EXPECT_LT(plans[8].structure.tet_size, 1);
  for (const Plan& p : plans) EXPECT_TRUE(p.may_wait && p.structure.min_bend == 0 && p.structure.features) << p.name;
  MeshOptions coarsest;
  coarsest.coarsest = true;
  for (const Plan& p : keeping_plans(coarsest, labels)) EXPECT_EQ(p.refine, 1);
  for (const Plan& p : last_plans()) EXPECT_TRUE(p.last && !p.structure.features) << p.name;
}

}  // namespace
}  // namespace polycube
