// Values that somebody chose: thresholds, weights, numbers of rounds. Those of a stage are one struct in its tuning.h. A line above each says what it is and
// why it is as it is: "Theory: ..." (follows from what is said), "Measured: ..." (the best on the parts that are named) or "Guess." (nobody tried others).
#pragma once

#include <tuple>

namespace polycube {

/// The values in force: the defaults, unless set_tuning() of pipeline/trial_tuning.h changed some before anything ran. Stages read them by a constant
/// reference, such as kTetTuning.
template <class Tuning>
inline constinit Tuning tuning_in_force{};

}  // namespace polycube

/// The last line of such a struct lists its entries.
#define POLYCUBE_ENTRIES(...)                         \
  static constexpr const char* kNames = #__VA_ARGS__; \
  auto entries() { return std::tie(__VA_ARGS__); }
