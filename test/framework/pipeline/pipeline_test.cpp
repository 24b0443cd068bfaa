#include "framework/pipeline/pipeline.hpp"

#include <gtest/gtest.h>

#include <any>
#include <functional>
#include <new>
#include <optional>
#include <stdexcept>
#include <variant>

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
    RigidTransform T = estimate.T_target_source;
    T.translation.x() += draw;
    estimate.set_pose(T);
    estimate.diagnostics = {{"draw", draw}};
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
  const auto cloud = std::make_shared<const Cloud>(Points{{1, 2, 3}}, StreamKey(1));
  return run_pipeline(pipeline, cloud, cloud, {}, StreamKey(5));
}

TEST(RunPipeline, TakesTheEstimateThroughTheSteps) {
  const PipelineResult result = run({move("a"), move("b")});
  ASSERT_EQ(result.records.size(), 2u);
  EXPECT_TRUE(result.failure.empty());
  EXPECT_EQ(result.estimate.T_target_source.translation.x(),
            result.records[0].diagnostics[0].second + result.records[1].diagnostics[0].second);
}

/// Gives the pose a covariance of `variance`.
class Judge final : public Step {
 public:
  explicit Judge(double variance) : variance_(variance) {}
  Estimate advance(Estimate estimate, Rng&) const override {
    if (variance_ > 0.0) {
      estimate.covariance = PoseCovariance{variance_ * Matrix6d::Identity(), {}};
    }
    return estimate;
  }

 private:
  double variance_;
};

NamedStep judge(const std::string& name, double variance) {
  const std::shared_ptr<const Step> step = std::make_shared<const Judge>(variance);
  return {name, params::Slot<Step>(params::BuiltStage{step, "judge", "{}"})};
}

TEST(RunPipeline, ACovarianceIsOfThePoseThatItWasEstimatedFor) {
  EXPECT_FALSE(run({move("a")}).estimate.covariance);
  const auto kept = run({move("a"), judge("b", 4.0), judge("leaves it", 0.0)}).estimate.covariance;
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->matrix(3, 3), 4.0);
  EXPECT_FALSE(run({judge("a", 4.0), move("b")}).estimate.covariance);
  EXPECT_TRUE(run({judge("a", 4.0), move("b"), judge("c", 4.0)}).estimate.covariance);
  // A pose that is set to what it was keeps them.
  Estimate estimate;
  estimate.information = Matrix6d::Identity();
  estimate.covariance = PoseCovariance{Matrix6d::Identity(), {}};
  estimate.set_pose(RigidTransform{});
  EXPECT_TRUE(estimate.information && estimate.covariance);
  estimate.set_pose({Eigen::Matrix3d::Identity(), {0.0, 0.0, 1e-300}});
  EXPECT_EQ(estimate.T_target_source.translation.z(), 1e-300);
  EXPECT_FALSE(estimate.information || estimate.covariance);
}

/// Rejects the pose for `reason`, if it has one.
class Rejecting final : public Step {
 public:
  explicit Rejecting(std::string reason) : reason_(std::move(reason)) {}
  Estimate advance(Estimate estimate, Rng&) const override {
    EXPECT_FALSE(estimate.rejection) << "A step alone does not see those before.";
    if (!reason_.empty()) estimate.rejection = reason_;
    return estimate;
  }

 private:
  std::string reason_;
};

NamedStep reject(const std::string& name, const std::string& reason) {
  const std::shared_ptr<const Step> step = std::make_shared<const Rejecting>(reason);
  return {name, params::Slot<Step>(params::BuiltStage{step, "reject", "{}"})};
}

TEST(RunPipeline, KeepsTheReasonsOfAllStepsThatReject) {
  EXPECT_EQ(run({reject("a", "")}).estimate.rejection, std::nullopt);
  EXPECT_EQ(run({reject("a", ""), reject("b", "steep")}).estimate.rejection, "b: steep");
  EXPECT_EQ(run({reject("a", "far"), reject("b", "")}).estimate.rejection, "a: far");
  EXPECT_EQ(run({reject("a", "far"), reject("b", "steep")}).estimate.rejection, "a: far; b: steep");
  EXPECT_EQ(run({reject("a", "far"), reject("b", ""), reject("c", "steep"), reject("d", "loose")})
                .estimate.rejection,
            "a: far; c: steep; d: loose");
  EXPECT_EQ(run({reject("a", "far"), move("b", true)}).estimate.rejection, "a: far");
}

TEST(RunPipeline, StepsDrawFromStreamsOfTheirOwn) {
  const double a = run({move("a"), move("b")}).records[0].diagnostics[0].second;
  const double b = run({move("a"), move("b")}).records[1].diagnostics[0].second;
  EXPECT_NE(a, b);
  EXPECT_EQ(run({move("a")}).records[0].diagnostics[0].second, a);
  EXPECT_EQ(run({move("other"), move("b")}).records[1].diagnostics[0].second, b);
}

TEST(RunPipeline, StopsWithAReasonAtTheStepThatIsDefeated) {
  const PipelineResult result = run({move("a"), move("b", true), move("c")});
  EXPECT_EQ(result.failure, "b: nothing to move");
  ASSERT_EQ(result.records.size(), 2u);
  EXPECT_TRUE(result.records[1].diagnostics.empty());
  EXPECT_EQ(result.estimate.T_target_source.translation.x(),
            result.records[0].diagnostics[0].second);
}

/// A step that throws what `raise` throws.
class Throwing final : public Step {
 public:
  explicit Throwing(std::function<void()> raise) : raise_(std::move(raise)) {}
  Estimate advance(Estimate estimate, Rng&) const override {
    raise_();
    return estimate;
  }

 private:
  std::function<void()> raise_;
};

PipelineResult run_throwing(std::function<void()> raise) {
  const std::shared_ptr<const Step> step = std::make_shared<const Throwing>(std::move(raise));
  return run({{"a", params::Slot<Step>(params::BuiltStage{step, "throwing", "{}"})}});
}

/// A library's exception that derives from std::exception directly.
struct ForeignError : std::exception {};

TEST(RunPipeline, OnlyAStageErrorEndsATrial) {
  EXPECT_EQ(run_throwing([] { throw StageError("no ground"); }).failure, "a: no ground");
  EXPECT_THROW(run_throwing([] { std::any_cast<int>(std::any(1.0)); }), std::bad_any_cast);
  EXPECT_THROW(run_throwing([] { std::optional<int>().value(); }), std::bad_optional_access);
  EXPECT_THROW(run_throwing([] { std::get<int>(std::variant<int, double>(1.0)); }),
               std::bad_variant_access);
  EXPECT_THROW(run_throwing([] { std::function<void()>()(); }), std::bad_function_call);
  EXPECT_THROW(run_throwing([] { std::vector<int>().at(0); }), std::logic_error);
  EXPECT_THROW(run_throwing([] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THROW(run_throwing([] { throw std::runtime_error("the disc"); }), std::runtime_error);
  EXPECT_THROW(run_throwing([] { throw ForeignError(); }), ForeignError);
  EXPECT_THROW(run_throwing([] { throw InputError("", "", "no such file"); }), InputError);
}

TEST(RunPipeline, AConvertedExceptionOfALibraryEndsATrial) {
  const auto convert = [](auto raise) {
    return [raise] { with_stage_errors<std::domain_error>("LIB", raise); };
  };
  const auto degenerate = convert([] { throw std::domain_error("all points are equal"); });
  EXPECT_EQ(run_throwing(degenerate).failure, "a: LIB: all points are equal");
  EXPECT_EQ(run_throwing(convert([] { throw StageError("no plane"); })).failure, "a: no plane");
  EXPECT_THROW(run_throwing(convert([] { throw std::length_error("a bug"); })), std::length_error);
}

}  // namespace
}  // namespace croon
