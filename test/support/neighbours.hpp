#pragma once

#include <gtest/gtest.h>

#include "framework/spatial/kd_tree.hpp"

namespace croon::test {

/// Both are none, or the same point at the same distance to the last bit.
inline void expect_same(const Neighbour& found, const Neighbour& expected) {
  EXPECT_EQ(found.index, expected.index);
  if (!expected) return;
  EXPECT_EQ(found.squared_distance_m2, expected.squared_distance_m2);
}

}  // namespace croon::test
