#include <gtest/gtest.h>
#include <stdlib.h>

#include "core/error.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

// The candidates share the tets; there once was a second candidate that went on with those that the first had failed to make.
TEST(Pipeline, EndsWhereThereAreNoTets) {
  setenv("POLYCUBE_TET_WORKER", "/bin/false", 1);
  try {
    mesh(CadModel::from_brep(shapes::box(10, 10, 10)), MeshOptions(), Monitor());
    ADD_FAILURE() << "meshed";
  } catch (const StageFailed& failure) {
    EXPECT_EQ(failure.stage(), "tet");
  }
  unsetenv("POLYCUBE_TET_WORKER");
}

}  // namespace
}  // namespace polycube
