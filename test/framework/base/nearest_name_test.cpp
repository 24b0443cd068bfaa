#include "framework/base/error.hpp"

#include <gtest/gtest.h>

namespace croon {
namespace {

const std::vector<std::string> kKnown = {"ransac", "cgal_efficient_ransac", "cgal_region_growing"};

TEST(NearestName, FindsTheMisspelt) {
  EXPECT_EQ(nearest_name("ransak", kKnown), "ransac");
  EXPECT_EQ(nearest_name("cgal_region_growig", kKnown), "cgal_region_growing");
  EXPECT_EQ(nearest_name("ransac", kKnown), "ransac");
}

TEST(Fault, IsALineOfBoundedLength) {
  const std::string huge(1000000, 'k');
  EXPECT_LT((Fault{huge, huge, huge}.line().size()), 5000U);
}

TEST(NearestName, KnowsWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("octree", kKnown), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  // The distance to a long name would take as many steps as the product of the lengths.
  EXPECT_EQ(nearest_name(std::string(1000000, 'x'), {std::string(1000000, 'x')}), "");
  EXPECT_EQ(name_hint("octree", {"a", "b"}), "; known: a, b");
  EXPECT_EQ(name_hint("ransak", kKnown), "; did you mean \"ransac\"?");
  EXPECT_EQ(name_hint("ransak", {}), "");
}

TEST(NearestName, CompletesAWord) {
  const std::vector<std::string> keys = {"voxel_size_m", "min_range_m", "min_points_per_voxel"};
  EXPECT_EQ(name_hint("voxel", keys), "; did you mean \"voxel_size_m\"?");
  EXPECT_EQ(name_hint("min", keys).rfind("; known: ", 0), 0U) << "two begin with it";
  EXPECT_EQ(name_hint("v", keys).rfind("; known: ", 0), 0U) << "shorter than a word";
}

}  // namespace
}  // namespace croon
