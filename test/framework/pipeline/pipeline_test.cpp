#include "framework/pipeline/pipeline.hpp"

#include <gtest/gtest.h>

#include "framework/base/error.hpp"

namespace croon {
namespace {

/// Moves x by a random draw, or fails.
class Move final : public Step {
 public:
  explicit Move(bool fails) : fails_(fails) {}
  Estimate advance(Estimate estimate, Rng& rng) const override {
    if (fails_) throw StageError("nothing to move");
    const double draw = rng.uniform();
    estimate.T_target_source.translation.x() += draw;
    estimate.figures = {{"draw", draw}};
    return estimate;
  }

 private:
  bool fails_;
};

NamedStep move(const std::string& name, bool fails = false) {
  const std::shared_ptr<const Step> step = std::make_shared<const Move>(fails);
  return {name, params::Slot<Step>(params::BuiltStage{step, "move", "{}"})};
}

PipelineResult run(const Pipeline& pipeline) {
  const auto cloud = std::make_shared<const Cloud>(PointCloud{{1, 2, 3}}, StreamKey(1));
  return run_pipeline(pipeline, cloud, cloud, {}, StreamKey(5));
}

TEST(RunPipeline, TakesTheEstimateThroughTheSteps) {
  const PipelineResult result = run({move("a"), move("b")});
  ASSERT_EQ(result.records.size(), 2u);
  EXPECT_TRUE(result.failure.empty());
  EXPECT_EQ(result.estimate.T_target_source.translation.x(),
            result.records[0].figures[0].second + result.records[1].figures[0].second);
}

TEST(RunPipeline, StepsDrawFromStreamsOfTheirOwn) {
  const double a = run({move("a"), move("b")}).records[0].figures[0].second;
  const double b = run({move("a"), move("b")}).records[1].figures[0].second;
  EXPECT_NE(a, b);
  EXPECT_EQ(run({move("a")}).records[0].figures[0].second, a);
  EXPECT_EQ(run({move("other"), move("b")}).records[1].figures[0].second, b);
}

TEST(RunPipeline, StopsWithAReasonAtTheStepThatIsDefeated) {
  const PipelineResult result = run({move("a"), move("b", true), move("c")});
  EXPECT_EQ(result.failure, "b: nothing to move");
  ASSERT_EQ(result.records.size(), 2u);
  EXPECT_TRUE(result.records[1].figures.empty());
  EXPECT_EQ(result.estimate.T_target_source.translation.x(), result.records[0].figures[0].second);
}

}  // namespace
}  // namespace croon
