#include "framework/io/vdb_writer.hpp"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <limits>
#include <set>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

openvdb::BoolGrid::Ptr read_grid(const std::filesystem::path& path) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open();
  return openvdb::gridPtrCast<openvdb::BoolGrid>(file.readGrid("occupancy"));
}

TEST(VdbWriter, HasTheLeavesWhereTheyAre) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  const auto path = folder.path() / "a.vdb";
  for (const double leaf_size_m : {0.05, 0.3, 2.0}) {
    const Points points = test::random_cloud(rng, 500, 5.0);
    write_occupancy_vdb(path, points, leaf_size_m);
    const openvdb::BoolGrid::Ptr grid = read_grid(path);
    const LeafGrid leaves(leaf_size_m);
    std::set<LeafKey> expected;
    for (const Eigen::Vector3f& p : points) {
      const Eigen::Vector3d point = p.cast<double>();
      const Eigen::Vector3i leaf = leaves.leaf_of(point);
      expected.insert(leaf_key(leaf));
      EXPECT_TRUE(grid->tree().isValueOn({leaf.x(), leaf.y(), leaf.z()}));
      // A viewer draws a voxel half a voxel around its centre: the point must be in it.
      const openvdb::Vec3d index = grid->worldToIndex({point.x(), point.y(), point.z()});
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_LE(std::abs(index[axis] - leaf(axis)), 0.5 + 1e-9);
    }
    EXPECT_EQ(grid->activeVoxelCount(), expected.size());
  }
}

TEST(VdbWriter, WritesTheSameBytesForTheSamePoints) {
  Rng rng = test::test_rng();
  const test::TempFolder folder;
  const Points points = test::random_cloud(rng, 200, 5.0);
  write_occupancy_vdb(folder.path() / "a.vdb", points, 0.1);
  write_occupancy_vdb(folder.path() / "b.vdb", points, 0.1);
  EXPECT_EQ(read_whole_file(folder.path() / "a.vdb"), read_whole_file(folder.path() / "b.vdb"));
}

TEST(VdbWriter, RefusesPointsBeyondItsLeaves) {
  const test::TempFolder folder;
  const auto write = [&](float x) {
    write_occupancy_vdb(folder.path() / "a.vdb", {{x, 0, 0}}, 0.1);
  };
  EXPECT_NO_THROW(write(1e7f));
  EXPECT_THROW(write(1e9f), StageError);
  EXPECT_THROW(write(std::numeric_limits<float>::quiet_NaN()), StageError);
}

}  // namespace
}  // namespace croon
