#include "framework/base/memory.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

TEST(Memory, OfAControlGroupIsTheLeastAboveIt) {
  const test::TempFolder root;
  EXPECT_EQ(control_group_bytes(root.path()), kNoLimit);
  root.write("proc/self/cgroup", "0::/jobs/17\n");
  EXPECT_EQ(control_group_bytes(root.path()), kNoLimit);
  root.write("sys/fs/cgroup/jobs/17/memory.max", "max\n");
  EXPECT_EQ(control_group_bytes(root.path()), kNoLimit);
  root.write("sys/fs/cgroup/jobs/memory.max", "4000000\n");
  EXPECT_EQ(control_group_bytes(root.path()), 4e6);
  root.write("sys/fs/cgroup/jobs/17/memory.max", "3000000\n");
  EXPECT_EQ(control_group_bytes(root.path()), 3e6);
}

TEST(Memory, OfAContainerIsThatOfItsRoot) {
  const test::TempFolder root;
  root.write("proc/self/cgroup", "0::/\n");
  root.write("sys/fs/cgroup/memory.max", "2000000\n");
  EXPECT_EQ(control_group_bytes(root.path()), 2e6);
}

TEST(Memory, OfTheFirstVersionOfControlGroupsHasAFolderOfItsOwn) {
  const test::TempFolder root;
  root.write("proc/self/cgroup", "5:cpu:/a\n4:memory:/a/b\nnonsense\n0::/\n");
  root.write("sys/fs/cgroup/memory/a/b/memory.limit_in_bytes", "1000000\n");
  EXPECT_EQ(control_group_bytes(root.path()), 1e6);
}

TEST(Memory, OfThisProcessIsSome) {
  EXPECT_GT(memory_limit_bytes(), 1e6);
  EXPECT_LT(memory_limit_bytes(), 1e15);
}

}  // namespace
}  // namespace croon
