#include "quantize/quantize.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "quantize/search.h"

namespace polycube {
namespace {

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

std::string layers_name(int layers) { return "at least " + std::to_string(layers) + " elements through every wall"; }

/// The constraints on a cycle of differences that cannot hold together.
[[noreturn]] void report_contradiction(const AxisProblem& axis, const QuantizeOptions& options) {
  std::vector<std::string> names;
  for (const Difference& d : contradiction(axis, {})) {
    if (d.source == Difference::kNone) continue;
    const std::string name = d.source == Difference::kLayers      ? layers_name(options.min_layers)
                             : d.source == Difference::kStructure ? "the structure of the coarser mesh"
                                                                  : options.constraints[d.source].name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty()) throw StageFailed("quantize", "the order of the charts contradicts itself");
  if (names.size() == 1) throw InvalidInput("constraint " + quoted(names) + " contradicts the shape of the part");
  throw InvalidInput("constraints that cannot hold together: " + quoted(names));
}

/// No integers satisfy C2 and the constraints: of those the ones that it takes for that, each of them needed.
[[noreturn]] void report_clash(const BlockComplex& blocks, const PolycuboidMap& map, QuantizeOptions options, const MonotonePaths& paths,
                               const Monitor& monitor) {
  const auto solvable = [&] {
    const QuantizeProblem problem = build_problem(blocks, map, options);
    Quantization unused;
    return Search(problem, paths, options.node_limit, monitor).run(unused).found;
  };
  std::vector<std::string> names;
  for (std::size_t i = 0; i < options.constraints.size();) {
    const DistanceConstraint constraint = options.constraints[i];
    options.constraints.erase(options.constraints.begin() + static_cast<std::ptrdiff_t>(i));
    if (!solvable()) continue;
    options.constraints.insert(options.constraints.begin() + static_cast<std::ptrdiff_t>(i++), constraint);
    names.push_back(constraint.name);
  }
  if (options.min_layers > 1) {
    const int layers = std::exchange(options.min_layers, 1);
    if (solvable()) names.push_back(layers_name(layers));
  }
  if (names.empty()) throw StageFailed("quantize", "the constraints leave no valid mesh: some charts would have to coincide");
  throw InvalidInput("no valid mesh satisfies " + quoted(names));
}

bool yields(const DistanceConstraint& constraint) { return constraint.may_yield; }

/// Of the constraints that contradict each other the one to leave out: the most that is asked for among those that may yield; -1 if none may.
int yielding(const AxisProblem& axis, const QuantizeOptions& options) {
  int most = -1;
  for (const Difference& d : contradiction(axis, {})) {
    if (d.source < 0 || !options.constraints[d.source].may_yield) continue;
    if (most < 0 || options.constraints[d.source].at_least > options.constraints[most].at_least) most = d.source;
  }
  return most;
}

/// Without the constraints that may yield and contradict the others of their axis.
QuantizeOptions consistent(const BlockComplex& blocks, const PolycuboidMap& map, QuantizeOptions options, std::vector<int>& yielded) {
  std::vector<int> number(options.constraints.size());
  std::iota(number.begin(), number.end(), 0);
  bool again = std::any_of(options.constraints.begin(), options.constraints.end(), yields);
  while (again) {
    again = false;
    const QuantizeProblem problem = build_problem(blocks, map, options);
    for (const AxisProblem& axis : problem.axes) {
      const int out = yielding(axis, options);
      if (out < 0) continue;
      yielded.push_back(number[out]);
      options.constraints.erase(options.constraints.begin() + out);
      number.erase(number.begin() + out);
      again = true;
      break;
    }
  }
  std::sort(yielded.begin(), yielded.end());
  return options;
}

}  // namespace

Quantization quantize(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& given, const Monitor& monitor) {
  monitor.progress("quantize", 0);
  Quantization result;
  const QuantizeOptions options = consistent(blocks, map, given, result.yielded);
  const QuantizeProblem problem = build_problem(blocks, map, options);
  const MonotonePaths paths(blocks, map, problem, options.separate_features);
  const Search::Outcome outcome = Search(problem, paths, options.node_limit, monitor).run(result);
  if (outcome.infeasible_axis >= 0) report_contradiction(problem.axes[outcome.infeasible_axis], options);
  if (!outcome.found) {
    // Bounds from below alone always leave a mesh: what clashes with C2 are others, which come first.
    if (std::none_of(options.constraints.begin(), options.constraints.end(), yields)) report_clash(blocks, map, options, paths, monitor);
    QuantizeOptions firm = given;
    std::erase_if(firm.constraints, yields);
    result = quantize(blocks, map, firm, monitor);
    for (int i = 0; i < static_cast<int>(given.constraints.size()); ++i) {
      if (yields(given.constraints[i])) result.yielded.push_back(i);
    }
    return result;
  }
  // The smallest of each axis is 0.
  AxisValues values = outcome.values;
  for (auto& v : values) {
    if (v.empty()) continue;
    const int smallest = *std::min_element(v.begin(), v.end());
    for (int& x : v) x -= smallest;
  }
  result.value.resize(map.charts.size());
  for (std::size_t c = 0; c < map.charts.size(); ++c) {
    const Chart& chart = map.charts[c];
    int number = problem.number[c];
    if (number < 0) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < static_cast<int>(problem.axes[chart.axis].charts.size()); ++k) {
        const double distance = std::abs(map.charts[problem.axes[chart.axis].charts[k]].value - chart.value);
        if (distance >= nearest) continue;
        nearest = distance;
        number = k;
      }
    }
    result.value[c] = values[chart.axis][number];
  }
  monitor.progress("quantize", 1);
  return result;
}

QuantizeReport check(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, const std::vector<int>& value) {
  QuantizeReport report;
  const QuantizeProblem problem = build_problem(blocks, map, options);
  std::array<std::vector<int>, 3> values;
  for (int d = 0; d < 3; ++d) {
    for (int c : problem.axes[d].charts) values[d].push_back(value[c]);
    report.objective += objective(problem.axes[d], values[d]);
  }
  for (const Block& block : blocks.blocks) {
    for (const auto& [low, high] : block.charts) report.c1 += value[high] < value[low];
  }
  for (const auto& [d, low, high] : opposite_charts(blocks)) report.opposite += value[high] - value[low] < options.min_layers;
  for (const DistanceConstraint& c : options.constraints) {
    const int distance = value[c.high] - value[c.low];
    report.constraints += distance < c.at_least || distance > c.at_most;
  }
  if (report.c1 == 0) {
    const MonotonePaths paths(blocks, map, problem, options.separate_features);
    report.c2 = static_cast<int>(paths.violations({&values[0], &values[1], &values[2]}).size());
  }
  return report;
}

}  // namespace polycube
