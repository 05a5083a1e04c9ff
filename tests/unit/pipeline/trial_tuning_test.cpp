#include "pipeline/trial_tuning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/error.h"
#include "deform/tuning.h"
#include "tet/tuning.h"

namespace polycube {
namespace {

TEST(TrialTuning, EveryValueHasANameOfItsOwn) {
  const std::vector<TuningValue> values = tuning_values();
  EXPECT_GT(values.size(), 80u);
  std::set<std::string> names;
  for (const TuningValue& value : values) {
    EXPECT_THAT(value.name, testing::MatchesRegex("[a-z]+\\.[a-z0-9_]+(\\.[0-9]+)?"));
    EXPECT_TRUE(names.insert(value.name).second) << value.name;
  }
}

TEST(TrialTuning, WhatIsSetIsInForce) {
  EXPECT_EQ(kDeformTuning.fall, 0.6);
  set_tuning("deform.fall=0.25,tet.probes=7");
  EXPECT_EQ(kDeformTuning.fall, 0.25);
  EXPECT_EQ(kTetTuning.probes, 7u);
  const std::vector<TuningValue> values = tuning_values();
  const auto probes = std::find_if(values.begin(), values.end(), [](const TuningValue& v) { return v.name == "tet.probes"; });
  ASSERT_NE(probes, values.end());
  EXPECT_EQ(probes->value, 7);
  EXPECT_TRUE(probes->whole);
  set_tuning("deform.fall=0.6,tet.probes=6");
  EXPECT_EQ(kDeformTuning.fall, DeformTuning().fall);
  EXPECT_EQ(kTetTuning.probes, TetTuning().probes);
}

TEST(TrialTuning, WhatIsNoValueIsRefusedAndChangesNothing) {
  for (const char* text : {"deform.fallen=1", "fall=1", "deform.fall", "deform.fall=", "deform.fall=x", "deform.fall=1x", "deform.fall=nan", "deform.fall=inf",
                           "deform.fall=1e999", "tet.probes=1.5", "tet.probes=-1", "tet.probes=1e30", "=", ",", "deform.fall=0.5,tet.probe=1"})
    EXPECT_THROW(set_tuning(text), InvalidInput) << text;
  EXPECT_EQ(kDeformTuning.fall, DeformTuning().fall);
}

}  // namespace
}  // namespace polycube
