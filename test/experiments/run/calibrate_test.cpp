// The library's calls and a run of an experiment give the same bits.
#include "framework/pipeline/calibrate.hpp"

#include <gtest/gtest.h>

#include "experiments/run/run_request.hpp"
#include "experiments/run/runner.hpp"
#include "experiments/run/starts.hpp"
#include "framework/base/error.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

const char* const kPipeline = R"([{"step": "drift", "size_m": 0.5}, {"step": "give"},
                                  {"step": "drift", "name": "again"}])";

TEST(Calibrate, GivesTheBitsOfARun) {
  const test::TempFolder folder;
  const Catalogue catalogue = test::fake_catalogue();
  RunRequest request;
  request.experiment = folder.write(
      "x.json", R"({"name": "x", "seed": 7, "dataset": {"type": "fake"}, "starts": {"trials": 2},
                    "pipeline": )" +
                    std::string(kPipeline) + "}");
  const CheckedRun run = check_run(request, catalogue);
  // An experiment is a pipeline too.
  const Pipeline pipeline = load_pipeline(request.experiment, catalogue);
  int compared = 0;
  RunListener listener;
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>&) {
    for (const SceneGroup& group : run.groups) {
      if (group.name != record.id.scene) continue;
      const Scene& scene = group.scenes.front();
      for (const SensorScan& scan : scene.sensors) {
        if (scan.sensor != record.id.sensor) continue;
        const PipelineResult result = calibrate(
            pipeline, scene.reference.load(), scan.load(),
            start_of(run.experiment, scene.name, to_reference(scene, scan), record.id.trial),
            {7, scene.name, scene.reference.sensor, scan.sensor, record.id.trial});
        EXPECT_EQ(result.estimate.T_target_source.translation,
                  record.T_reference_sensor->translation);
        EXPECT_EQ(result.estimate.T_target_source.rotation, record.T_reference_sensor->rotation);
        ++compared;
      }
    }
  };
  run_trials(run.experiment, run.groups, plan_trials(run.experiment, run.groups, run.selection), 1,
             listener);
  EXPECT_EQ(compared, 2 * 2 * 2);
}

TEST(Calibrate, SaysWhatDefeatedIt) {
  const Pipeline pipeline =
      parse_pipeline(R"([{"step": "behave", "how": "defeat"}])", "p.json", test::fake_catalogue());
  EXPECT_EQ(calibrate(pipeline, Points{{1, 2, 3}}, Points{{1, 2, 3}}).failure, "behave: no ground");
}

TEST(Pipelines, ThatAreWrongAreRefusedWithEveryFault) {
  const auto fault = [](const std::string& text) {
    return test::input_error([&] { parse_pipeline(text, "p.json", test::fake_catalogue()); });
  };
  EXPECT_NE(fault("[]").find("p.json"), std::string::npos);
  EXPECT_NE(fault("3").find("list"), std::string::npos);
  EXPECT_NE(fault(R"({"pipeline": [{"step": "drfit"}]})").find("did you mean \"drift\"?"),
            std::string::npos);
  EXPECT_NE(fault(R"([{"step": "take"}])").find("which no earlier step provides"),
            std::string::npos);
  const std::string two = fault(R"([{"step": "drift", "size": 1}, {"step": "give", "value": 99}])");
  EXPECT_NE(two.find("/0/size"), std::string::npos) << two;
  EXPECT_NE(two.find("/1/value"), std::string::npos) << two;
}

}  // namespace
}  // namespace croon::experiments
