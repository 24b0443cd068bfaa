// The results are the same bytes on a newer and on an older processor.
#include <gtest/gtest.h>

#include <string>

#include "framework/base/whole_file.hpp"
#include "test/support/data_root.hpp"
#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

/// Runs `experiment` as it is, and with the C library's code for processors without fused
/// multiply-adds. Both runs write the same tables.
void expect_same_on_older_processor(const std::string& experiment) {
  const test::TempFolder folder;
  folder.write("experiment.json", experiment);
  const test::Finished finished = test::run_script(
      "options=(run experiment.json --quiet)\n"
      "croon \"${options[@]}\" --out newer\n"
      "export GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4\n"
      "croon \"${options[@]}\" --out older\n",
      folder.path());
  ASSERT_EQ(finished.status, 0) << finished.output;
  for (const char* file : {"trials.csv", "summary.csv", "summary.json", "comparison.csv"}) {
    EXPECT_TRUE(read_whole_file(folder.path() / "newer" / file) ==
                read_whole_file(folder.path() / "older" / file))
        << file;
  }
}

/// The paper's experiment `name` with some keys replaced; `keys` begins with a comma.
std::string extended(const std::string& name, const std::string& keys) {
  return R"({"extends": ")" + std::string(CROON_SOURCE_DIR) + "/experiments/paper/" + name +
         R"(.json", "name": "processors")" + keys + "}";
}

/// Of these starts and grounds, 30 in 4000 differed when sines came from the C library.
TEST(Processors, DrawAndMeasureTheSameStarts) {
  expect_same_on_older_processor(R"({
    "name": "starts",
    "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 2, "mix": "paper", "noise": "real"},
    "starts": {"around": "truth", "rotation_deg": 45, "translation_m": 0.1, "trials": 500},
    "success": {"rotation_deg": 0.5, "translation_m": 0.1},
    "pipeline": [
      {"step": "preprocessing", "sensor": [{"type": "voxel_downsample", "leaf_size_m": 0.5}]},
      {"step": "ground_alignment"}
    ],
    "variants": [{"name": "start", "remove": ["ground_alignment"]}]
  })");
}

TEST(Processors, RegisterSimulatedScenesAlike) {
  expect_same_on_older_processor(extended("pipeline", R"(,
    "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 1, "mix": "paper", "noise": "real"},
    "starts": {"around": "truth", "rotation_deg": 45, "translation_m": 0.1, "trials": 1},
    "variants": [
      {"name": "gicp", "replace": {"registration.icp": {"type": "gicp"}}},
      {"name": "nicp", "replace": {"registration.icp": {"type": "nicp"}}},
      {"name": "point_to_point", "replace": {"registration.icp": {"type": "point_to_point"}}},
      {"name": "bobyqa", "replace": {"volume_refinement.search": {"type": "bobyqa"},
                                     "volume_refinement.scorer": {"type": "brick_hash", "lattices": 4}}},
      {"name": "cauchy", "replace": {"registration.icp": {"type": "icpn", "kernel": "cauchy"}}},
      {"name": "growing", "replace": {"ground_alignment.extractor": {"type": "cgal_region_growing"}}},
      {"name": "efficient", "replace": {"ground_alignment.extractor": {"type": "cgal_efficient_ransac"}}}
    ])"));
}

TEST(Processors, RegisterTheSamplesAlike) {
  CROON_SKIP_WITHOUT_DATA();
  expect_same_on_older_processor(extended("carla_samples", R"(,
    "starts": {"around": "truth", "rotation_deg": 45, "translation_m": 0.1, "trials": 3},
    "claims": [])"));
}

}  // namespace
}  // namespace croon::experiments
