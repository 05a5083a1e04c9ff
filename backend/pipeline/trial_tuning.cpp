#include "pipeline/trial_tuning.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <sstream>

#include "blocks/tuning.h"
#include "cad/tuning.h"
#include "core/error.h"
#include "core/tuning.h"
#include "deform/tuning.h"
#include "fem/tuning.h"
#include "fit/tuning.h"
#include "hex/tuning.h"
#include "label/tuning.h"
#include "pad/tuning.h"
#include "pipeline/search/tuning.h"
#include "pipeline/tuning.h"
#include "quantize/tuning.h"
#include "tet/tuning.h"

namespace polycube {
namespace {

struct Entry {
  TuningValue now;
  std::function<void(double)> set;
};

template <class Value>
void add(std::vector<Entry>& entries, const std::string& name, Value& value) {
  if constexpr (std::is_arithmetic_v<Value>) {
    entries.push_back({{name, static_cast<double>(value), std::is_integral_v<Value>}, [&value](double other) { value = static_cast<Value>(other); }});
  } else {
    for (std::size_t i = 0; i < value.size(); ++i) add(entries, name + "." + std::to_string(i), value[i]);
  }
}

template <class Tuning>
void add_stage(std::vector<Entry>& entries, const std::string& stage) {
  std::istringstream names(Tuning::kNames);
  const auto next = [&](auto& value) {
    std::string name;
    std::getline(names >> std::ws, name, ',');
    add(entries, stage + "." + name, value);
  };
  std::apply([&](auto&... values) { (next(values), ...); }, tuning_in_force<Tuning>.entries());
}

std::vector<Entry> all_entries() {
  std::vector<Entry> entries;
  add_stage<CoreTuning>(entries, "core");
  add_stage<CadTuning>(entries, "cad");
  add_stage<TetTuning>(entries, "tet");
  add_stage<LabelTuning>(entries, "label");
  add_stage<DeformTuning>(entries, "deform");
  add_stage<BlocksTuning>(entries, "blocks");
  add_stage<QuantizeTuning>(entries, "quantize");
  add_stage<HexTuning>(entries, "hex");
  add_stage<PadTuning>(entries, "pad");
  add_stage<FitTuning>(entries, "fit");
  add_stage<FemTuning>(entries, "fem");
  add_stage<PipelineTuning>(entries, "pipeline");
  add_stage<SearchTuning>(entries, "search");
  return entries;
}

}  // namespace

std::vector<TuningValue> tuning_values() {
  std::vector<TuningValue> values;
  for (const Entry& entry : all_entries()) values.push_back(entry.now);
  return values;
}

void set_tuning(const std::string& text) {
  const std::vector<Entry> entries = all_entries();
  std::vector<std::pair<const Entry*, double>> wanted;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const auto equals = std::min(item.find('='), item.size());
    const auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.now.name == item.substr(0, equals); });
    if (entry == entries.end()) throw InvalidInput("tuning: there is no '" + item.substr(0, equals) + "'");
    const char *first = item.data() + std::min(equals + 1, item.size()), *last = item.data() + item.size();
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value))
      throw InvalidInput("tuning: '" + item + "' is not of the form " + entry->now.name + "=NUMBER");
    constexpr double kMost = 1e9;
    if (entry->now.whole && !(value >= 0 && value <= kMost && value == std::floor(value)))
      throw InvalidInput("tuning: " + entry->now.name + " takes whole numbers from 0");
    wanted.emplace_back(&*entry, value);
  }
  for (const auto& [entry, value] : wanted) entry->set(value);
}

}  // namespace polycube
