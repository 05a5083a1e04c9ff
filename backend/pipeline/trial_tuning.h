// For trials with other values than those in the stages' tuning.h.
#pragma once

#include <string>
#include <vector>

namespace polycube {

struct TuningValue {
  std::string name;  ///< such as pad.hopeless, of an array label.compactness.0
  double value;
  bool whole;  ///< takes whole numbers from 0 only
};

/// Every value in force, stage by stage.
std::vector<TuningValue> tuning_values();

/// Sets some, as in "pad.hopeless=1750,deform.outer=11". Only before anything runs: stages read them without a lock. Throws InvalidInput, with nothing changed,
/// where a name or a value is none.
void set_tuning(const std::string& text);

}  // namespace polycube
