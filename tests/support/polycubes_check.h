// What every block complex, quantization and hexahedral mesh of a polycuboid must satisfy.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "hex/hex.h"
#include "support/polycubes.h"

namespace polycube::testing {

/// Quantizes and builds the hexahedra: C1 and C2 hold, the optimum is proved, the mesh is valid and complete. Returns the mesh.
inline HexComplex expect_valid(const Example& e, const QuantizeOptions& options, const std::string& what, const BlockComplex& blocks) {
  const Quantization q = quantize(blocks, e.map, options, Monitor());
  const QuantizeReport report = check(blocks, e.map, options, q.value);
  EXPECT_TRUE(report.good()) << what << " scale " << options.scale << ": c1 " << report.c1 << " opposite " << report.opposite << " c2 " << report.c2
                             << " constraints " << report.constraints;
  EXPECT_TRUE(q.optimal) << what;
  EXPECT_NEAR(report.objective, q.objective, 1e-9 * (1 + q.objective)) << what;
  EXPECT_NEAR(q.bound, q.objective, 1e-9 * (1 + q.objective)) << what;
  HexComplex hexes = build_hexes(e.tets, e.map, blocks, q, Monitor());
  EXPECT_TRUE(check(hexes, e.map, blocks).good(euler_characteristic(e.tets.triangles))) << what << " scale " << options.scale;
  return hexes;
}

inline HexComplex expect_valid(const Example& e, double scale, const std::string& what, const BlockComplex& blocks) {
  QuantizeOptions options;
  options.scale = scale;
  return expect_valid(e, options, what, blocks);
}

}  // namespace polycube::testing
