// The program starts without OpenVDB, and has it where a stage or a file wants it. It tells
// jemalloc how to allocate. Limits of the machine end in one line.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <string>

#include "framework/base/whole_file.hpp"
#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

/// An experiment of one scene whose starts are refined by `scorer`.
std::string refined_by(const std::string& scorer) {
  return R"({"name": "openvdb", "starts": {"rotation_deg": 1, "trials": 1},
    "dataset": {"type": "simulated", "scenes": 1, "mix": {"urban": 1}},
    "pipeline": [{"step": "volume_refinement", "scorer": {"type": ")" +
         scorer + R"("}}]})";
}

TEST(OpenvdbOnDemand, IsNotLoadedByAProgramThatStarts) {
  const test::TempFolder folder;
  const test::Finished finished = test::run_script("ldd \"$(type -P croon)\"\n", folder.path());
  ASSERT_EQ(finished.status, 0) << finished.output;
  EXPECT_NE(finished.output.find("libstdc++"), std::string::npos) << finished.output;
  EXPECT_EQ(finished.output.find("openvdb"), std::string::npos) << finished.output;
}

TEST(OpenvdbOnDemand, CountsTheLeavesThatOtherScorersCount) {
  const test::TempFolder folder;
  folder.write("openvdb.json", refined_by("openvdb_grid"));
  folder.write("other.json", refined_by("pointer_octree"));
  const test::Finished finished = test::run_script(
      "croon run openvdb.json --out openvdb --quiet\n"
      "croon run other.json --out other --quiet\n",
      folder.path());
  ASSERT_EQ(finished.status, 0) << finished.output;
  EXPECT_EQ(read_whole_file(folder.path() / "openvdb/trials.csv"),
            read_whole_file(folder.path() / "other/trials.csv"));
}

TEST(OpenvdbOnDemand, IsMissedInOneLineByAProgramThatWasMovedAlone) {
  const test::TempFolder folder;
  folder.write("openvdb.json", refined_by("openvdb_grid"));
  const test::Finished finished = test::run_script(
      "mkdir bin; cp \"$(type -P croon)\" bin/alone\n"
      "bin/alone run openvdb.json --out results --quiet || [[ $? == 2 ]]\n",
      folder.path());
  EXPECT_EQ(finished.status, 0) << finished.output;
  EXPECT_NE(finished.output.find("openvdb.so: cannot load the OpenVDB module of croon"),
            std::string::npos)
      << finished.output;
  EXPECT_EQ(finished.output.find('\n'), finished.output.size() - 1) << finished.output;
}

TEST(Limits, OfMemoryEndInOneLine) {
  const test::TempFolder folder;
  folder.write("x.json", refined_by("pointer_octree"));
  for (const std::string limit : {"ulimit -v 100000", "ulimit -v 130000", "ulimit -v 160000"}) {
    const test::Finished finished = test::run_script(
        limit + "\ncroon run x.json --out results --quiet || [[ $? == 1 ]]\n", folder.path());
    EXPECT_EQ(finished.status, 0) << limit << "\n" << finished.output;
    EXPECT_EQ(finished.output.rfind("croon: ", 0), 0U) << finished.output;
    EXPECT_EQ(finished.output.find("bug"), std::string::npos) << finished.output;
  }
}

TEST(Permissions, OfAllResultsAreThoseOfTheUmask) {
  const test::TempFolder folder;
  folder.write("x.json", refined_by("pointer_octree"));
  const test::Finished finished = test::run_script(
      "umask 002\ncroon run x.json --out results --quiet >/dev/null\n"
      "stat -c %a results/* | sort -u\n",
      folder.path());
  EXPECT_EQ(finished.output, "664\n");
}

TEST(Allocator, IsToldToTakeHugePages) {
  const test::TempFolder folder;
  const test::Finished finished = test::run_script(
      "program=$(type -P croon)\n"
      "ldd \"$program\" | grep jemalloc >all.txt || exit 77\n"
      "nm --dynamic \"$program\" | grep -w malloc_conf\n"
      "strings \"$program\" | grep ^thp:always\n",
      folder.path());
  if (WEXITSTATUS(finished.status) == 77) GTEST_SKIP() << "the program is built without jemalloc";
  EXPECT_EQ(finished.status, 0) << finished.output;
}

}  // namespace
}  // namespace croon::experiments
