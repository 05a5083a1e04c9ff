// The points of a triangle, quad or edge, whichever way round they are given.
#pragma once

#include <algorithm>

namespace polycube {

/// The same numbers in ascending order: a key for facets that two elements see from both sides.
template <class Row>
Row sorted(Row row) {
  std::sort(row.begin(), row.end());
  return row;
}

}  // namespace polycube
