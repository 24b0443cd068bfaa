#include "framework/io/pcd_file.hpp"

#include <gtest/gtest.h>

#include "framework/io/point_cloud_file.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

TEST(PcdWriter, WhatIsWrittenIsReadBackBitForBit) {
  const TempFolder folder;
  for (const int count : {0, 1, 1000}) {
    Rng rng = test_rng(static_cast<std::uint64_t>(count));
    MeasuredCloud cloud;
    cloud.points = random_cloud(rng, count, 80.0);
    for (int i = 0; i < count; ++i) {
      cloud.intensity.push_back(static_cast<float>(rng.below(256)));
      cloud.ring.push_back(static_cast<std::uint16_t>(rng.below(64)));
      cloud.time_s.push_back(rng.uniform());
    }
    write_pcd(folder.path() / "cloud.pcd", cloud);
    const LoadedCloud read = read_point_cloud(folder.path() / "cloud.pcd");
    EXPECT_EQ(read.points, cloud.points);
    EXPECT_EQ(read.dropped_non_finite, 0U);
  }
}

TEST(PcdWriter, SaysWhereItCannotWrite) {
  EXPECT_NE(input_error([] { write_pcd("/no/such/folder/cloud.pcd", {}); }).find("cloud.pcd"),
            std::string::npos);
}

}  // namespace
}  // namespace croon::test
