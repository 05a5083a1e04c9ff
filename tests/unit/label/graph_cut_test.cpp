#include "label/graph_cut.h"

#include <gtest/gtest.h>

#include <random>

namespace polycube {
namespace {

CutProblem random_problem(int nodes, int links, std::mt19937& random) {
  std::uniform_real_distribution<double> cost(0, 1);
  std::uniform_int_distribution<int> node(0, nodes - 1);
  CutProblem p;
  p.data.resize(nodes);
  for (auto& d : p.data) {
    for (double& c : d) c = cost(random);
  }
  for (int i = 0; i < links; ++i) {
    const int a = node(random), b = node(random);
    if (a != b) p.links.push_back({a, b, 0.5 * cost(random)});
  }
  return p;
}

double brute_force(const CutProblem& p) {
  std::vector<int> labels(p.data.size(), 0);
  double best = energy(p, labels);
  for (;;) {
    std::size_t i = 0;
    while (i < labels.size() && ++labels[i] == 6) labels[i++] = 0;
    if (i == labels.size()) return best;
    best = std::min(best, energy(p, labels));
  }
}

TEST(GraphCut, IsCloseToTheOptimumAndNeverWorseThanTheDataTermAlone) {
  std::mt19937 random(7);
  int optimal = 0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    const CutProblem p = random_problem(6, 9, random);
    const double best = brute_force(p), found = energy(p, solve(p, Monitor()));
    EXPECT_GE(found, best - 1e-12);
    // Alpha expansion is within twice the optimum (Boykov, Veksler, Zabih 2001, theorem 6.1; here opposite labels cost 2).
    EXPECT_LE(found, 4 * best + 1e-12);
    optimal += found < best + 1e-9;
  }
  EXPECT_GE(optimal, kRuns * 3 / 4);
}

TEST(GraphCut, ForbiddenLabelsAreNotTaken) {
  std::mt19937 random(3);
  CutProblem p = random_problem(30, 60, random);
  for (auto& d : p.data) d[2] = d[4] = kForbidden;
  for (int l : solve(p, Monitor())) EXPECT_TRUE(l != 2 && l != 4);
}

TEST(GraphCut, StrongLinksMakeOneLabel) {
  std::mt19937 random(5);
  CutProblem p = random_problem(12, 0, random);
  for (int i = 0; i + 1 < 12; ++i) p.links.push_back({i, i + 1, 100});
  const auto labels = solve(p, Monitor());
  for (int l : labels) EXPECT_EQ(l, labels[0]);
}

}  // namespace
}  // namespace polycube
