// The results are the same bytes on a newer and on an older processor.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "framework/base/whole_file.hpp"
#include "test/support/data_root.hpp"
#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

/// Runs `experiment` as it is, and as an older processor would: the C library without the code that
/// needs fused multiply-adds, and Embree, by its configuration file, with its oldest code. Both
/// runs write the same tables.
void expect_same_on_older_processor(const std::string& experiment) {
  const test::TempFolder folder;
  folder.write("experiment.json", experiment);
  for (const char* name : {".embree3", ".embree4"}) folder.write(name, "isa=sse2\n");
  const test::Finished finished = test::run_script(
      "options=(run experiment.json --quiet --data \"$CROON_DATA\")\n"
      "croon \"${options[@]}\" --out newer\n"
      "export HOME=\"$PWD\" GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4\n"
      "croon \"${options[@]}\" --out older\n",
      folder.path());
  ASSERT_EQ(finished.status, 0) << finished.output;
  for (const char* file : {"trials.csv", "summary.csv", "summary.json", "comparison.csv"}) {
    EXPECT_TRUE(read_whole_file(folder.path() / "newer" / file) ==
                read_whole_file(folder.path() / "older" / file))
        << file;
  }
}

/// The paper's pipeline, and variants with the other extractors, registrations, searches and
/// scorers.
std::string experiment_on(const std::string& dataset, int trials) {
  return R"({"extends": ")" + std::string(CROON_SOURCE_DIR) +
         R"(/experiments/paper/pipeline.json", "name": "processors", "dataset": )" + dataset +
         R"(, "starts": {"around": "truth", "rotation_deg": 45, "translation_m": 0.1, "trials": )" +
         std::to_string(trials) + R"(},
      "variants": [
        {"name": "gicp", "replace": {"registration.icp": {"type": "gicp"}}},
        {"name": "nicp", "replace": {"registration.icp": {"type": "nicp"}}},
        {"name": "point_to_point", "replace": {"registration.icp": {"type": "point_to_point"}}},
        {"name": "cauchy", "replace": {"registration.icp": {"type": "icpn", "kernel": "cauchy"}}},
        {"name": "growing", "replace": {"ground_alignment.extractor": {"type": "cgal_region_growing"}}},
        {"name": "efficient", "replace": {"ground_alignment.extractor": {"type": "cgal_efficient_ransac"}}}
      ]})";
}

TEST(Processors, GiveTheSameBytesOnSimulatedScenes) {
  expect_same_on_older_processor(experiment_on(
      R"({"type": "simulated", "rig": "croon_three", "scenes": 6, "mix": "paper", "noise": "real"})",
      1));
}

TEST(Processors, GiveTheSameBytesOnTheSamples) {
  CROON_SKIP_WITHOUT_DATA();
  expect_same_on_older_processor(
      experiment_on(R"({"type": "opencalib", "path": "opencalib/carla"})", 2));
}

}  // namespace
}  // namespace croon::experiments
