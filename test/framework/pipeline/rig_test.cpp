#include "framework/pipeline/rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/stage/reasons.hpp"
#include "framework/stage/rig_step.hpp"

namespace croon {
namespace {

/// Does to the rig what it was given.
class Adjusting final : public RigStep {
 public:
  using Work = std::function<void(std::vector<RigEstimate>&, Rng&)>;
  explicit Adjusting(Work work) : work_(std::move(work)) {}
  void adjust(std::vector<RigEstimate>& rig, Rng& rng) const override { work_(rig, rng); }

 private:
  Work work_;
};

/// Moves x by a random draw; fails on an estimate whose x is negative.
class Moving final : public Step {
 public:
  Estimate advance(Estimate estimate, Rng& rng) const override {
    if (estimate.T_target_source.translation.x() < 0.0) throw StageError("behind");
    estimate.T_target_source.translation.x() += rng.uniform();
    estimate.diagnostics = {{"moved", 1.0}};
    return estimate;
  }
};

template <class StepClass, class... Arguments>
NamedStep named(const std::string& name, Arguments&&... arguments) {
  const std::shared_ptr<const Step> step =
      std::make_shared<const StepClass>(std::forward<Arguments>(arguments)...);
  return {name, params::Slot<Step>(params::BuiltStage{step, name, "{}"})};
}

/// A member of the rig whose start is at `x`.
RigMember member(const std::string& scene, const std::string& sensor, double x = 0.0) {
  const auto cloud = std::make_shared<const Cloud>(Points{{1, 2, 3}}, StreamKey(1));
  RigidTransform start;
  start.translation.x() = x;
  return {scene, "top", sensor, StreamKey(5).with(scene).with(sensor),
          at_start(cloud, cloud, start)};
}

Rig four() {
  return {member("a", "left"), member("a", "right"), member("b", "left"), member("b", "right")};
}

/// A rig step that clears all failures.
class Repairing final : public RigStep {
 public:
  bool sees_failures() const override { return true; }
  void adjust(std::vector<RigEstimate>& rig, Rng&) const override {
    for (RigEstimate& one : rig) one.failure.clear();
  }
};

double x_of(const RigMember& member) {
  return member.result.estimate.T_target_source.translation.x();
}

void set_x(RigEstimate& one, double x) { one.estimate.T_target_source.translation.x() = x; }

TEST(Rig, TakesEachMemberThroughAStepAsAPairAlone) {
  const Pipeline pipeline = {named<Moving>("move"), named<Moving>("again")};
  Rig rig = four();
  run_pipeline(pipeline, rig, StreamKey(9));
  for (const RigMember& after : rig) {
    const RigMember before = member(after.scene, after.source);
    const PipelineResult alone = run_pipeline(pipeline, before.result.estimate.target,
                                              before.result.estimate.source, {}, before.key);
    EXPECT_EQ(x_of(after), alone.estimate.T_target_source.translation.x());
    EXPECT_EQ(after.result.records.size(), 2U);
  }
  EXPECT_NE(x_of(rig[0]), x_of(rig[1]));
}

TEST(Rig, AStepThatSeesFailuresCanRepairThem) {
  Rig rig = {member("a", "left"), member("a", "right", -1.0)};
  run_pipeline({named<Moving>("move"), named<Repairing>("repair")}, rig, StreamKey(9));
  EXPECT_EQ(rig[1].result.failure, "");
  EXPECT_EQ(x_of(rig[1]), -1.0);
  ASSERT_EQ(rig[1].result.records.size(), 2U);
  EXPECT_EQ(rig[1].result.records[0].name, "move");
  EXPECT_EQ(rig[1].result.records[1].name, "repair");
}

TEST(Rig, AStepThatSeesFailuresDoesNotSeeThoseWithoutACloud) {
  Rig rig = {member("a", "left"), member("a", "right")};
  rig[1].result.failure = "the cloud of right: it has no points";
  rig[1].result.estimate.source = nullptr;
  run_pipeline({named<Repairing>("repair")}, rig, StreamKey(9));
  EXPECT_EQ(rig[1].result.failure, "the cloud of right: it has no points");
}

TEST(Rig, ARigStepSeesAllThatHaveNotFailedInOrder) {
  Rig rig = four();
  rig[1] = member("a", "right", -1.0);
  std::vector<std::string> seen;
  run_pipeline({named<Moving>("move"),
                named<Adjusting>("all",
                                 [&](std::vector<RigEstimate>& all, Rng&) {
                                   for (RigEstimate& one : all) {
                                     seen.push_back(one.scene + one.target + one.source);
                                     EXPECT_TRUE(one.estimate.diagnostics.empty());
                                     set_x(one, 7.0);
                                   }
                                 })},
               rig, StreamKey(9));
  EXPECT_EQ(seen, (std::vector<std::string>{"atopleft", "btopleft", "btopright"}));
  EXPECT_EQ(rig[1].result.failure, "move: behind");
  EXPECT_EQ(x_of(rig[1]), -1.0);
  EXPECT_EQ(x_of(rig[3]), 7.0);
  EXPECT_EQ(rig[1].result.records.size(), 1U);
  EXPECT_EQ(rig[3].result.records.size(), 2U);
}

TEST(Rig, ARigStepDrawsFromAStreamOfItsTrialAndName) {
  double draw = 0.0;
  const auto draw_of = [&](const std::string& name, const StreamKey& key, Rig rig) {
    run_pipeline({named<Adjusting>(name, [&](auto&, Rng& rng) { draw = rng.uniform(); })}, rig,
                 key);
    return draw;
  };
  const double first = draw_of("a", StreamKey(9), four());
  EXPECT_EQ(draw_of("a", StreamKey(9), {member("c", "left")}), first);
  EXPECT_NE(draw_of("b", StreamKey(9), four()), first);
  EXPECT_NE(draw_of("a", StreamKey(8), four()), first);
}

TEST(Rig, WhatDefeatsARigStepFailsAllOrOne) {
  Rig rig = four();
  const auto all = named<Adjusting>("all", [](std::vector<RigEstimate>& estimates, Rng&) {
    set_x(estimates[0], 3.0);
    throw StageError("too few");
  });
  run_pipeline({all}, rig, StreamKey(9));
  for (const RigMember& one : rig) EXPECT_EQ(one.result.failure, "all: too few");
  EXPECT_EQ(x_of(rig[0]), 0.0);

  rig = four();
  const auto one = named<Adjusting>("one", [](std::vector<RigEstimate>& estimates, Rng&) {
    for (RigEstimate& estimate : estimates) set_x(estimate, 3.0);
    estimates[2].failure = "unseen";
  });
  run_pipeline({one}, rig, StreamKey(9));
  EXPECT_EQ(rig[2].result.failure, "one: unseen");
  EXPECT_EQ(x_of(rig[2]), 0.0);
  EXPECT_EQ(x_of(rig[3]), 3.0);
}

TEST(Rig, ARigStepThatLosesAnEstimateIsABug) {
  Rig rig = four();
  EXPECT_THROW(run_pipeline({named<Adjusting>("all", [](auto& all, Rng&) { all.pop_back(); })}, rig,
                            StreamKey(9)),
               std::logic_error);
}

TEST(Rig, ARigStepThatReordersEstimatesIsABug) {
  Rig rig = four();
  const auto reverse =
      named<Adjusting>("all", [](auto& all, Rng&) { std::reverse(all.begin(), all.end()); });
  EXPECT_THROW(run_pipeline({reverse}, rig, StreamKey(9)), std::logic_error);
}

TEST(Rig, AnEstimateKnowsInHowManyScenesItsSensorIs) {
  Rig rig = four();
  rig[0].result.failure = "no ground";
  rig.push_back(member("c", "left"));
  run_pipeline({named<Adjusting>("all",
                                 [](std::vector<RigEstimate>& all, Rng&) {
                                   for (const RigEstimate& one : all) {
                                     EXPECT_EQ(one.scenes, one.source == "left" ? 3U : 2U);
                                   }
                                 })},
               rig, StreamKey(9));
}

TEST(Rig, APoseThatIsNotFiniteDoesNotSpoilOtherScenes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Rig rig = {member("a", "left", nan), member("b", "left", 2.0), member("b", "right", nan)};
  run_pipeline({named<Moving>("move")}, rig, StreamKey(9));
  EXPECT_EQ(rig[0].result.failure, "move: the pose is not finite");
  EXPECT_EQ(rig[1].result.failure, "");
  EXPECT_EQ(rig[2].result.failure, "");  // Its only scene; the end of the trial judges it.
  EXPECT_EQ(result_of_sensor({&rig[0], &rig[1]}).failure, "");
}

TEST(Rig, ARigStepMayRejectAndTakeARejectionBack) {
  Rig rig = four();
  rig[0].result.estimate.rejection = "first: no";
  rig[1].result.estimate.rejection = "first: no";
  rig[3].result.estimate.rejection = "first: no";
  run_pipeline({named<Adjusting>("all",
                                 [](std::vector<RigEstimate>& all, Rng&) {
                                   all[0].estimate.rejection.reset();
                                   all[2].estimate.rejection = "far";
                                   all[3].estimate.rejection =
                                       with_reason(all[3].estimate.rejection, "far");
                                 })},
               rig, StreamKey(9));
  EXPECT_EQ(rig[0].result.estimate.rejection, std::nullopt);
  EXPECT_EQ(rig[1].result.estimate.rejection, "first: no");
  EXPECT_EQ(rig[2].result.estimate.rejection, "all: far");
  EXPECT_EQ(rig[3].result.estimate.rejection, "first: no; all: far");
}

TEST(Rig, InformationIsOfTheStepThatComputedIt) {
  Rig rig = {member("a", "left")};
  rig[0].result.estimate.information = Matrix6d::Identity();
  const auto nothing = named<Adjusting>("nothing", [](auto&, Rng&) {});
  const auto twice = named<Adjusting>(
      "twice", [](std::vector<RigEstimate>& all, Rng&) { *all[0].estimate.information *= 2.0; });
  run_pipeline({nothing, twice}, rig, StreamKey(9));
  EXPECT_FALSE(rig[0].result.records[0].information);
  ASSERT_TRUE(rig[0].result.records[1].information);
  EXPECT_EQ((*rig[0].result.records[1].information)(0, 0), 2.0);
}

TEST(Rig, ARigStepOnAPairSeesARigOfOne) {
  const auto step = named<Adjusting>("all", [](std::vector<RigEstimate>& all, Rng&) {
    ASSERT_EQ(all.size(), 1U);
    set_x(all[0], 4.0);
  });
  PipelineResult result = member("a", "left").result;
  advance(result, step, StreamKey(1));
  EXPECT_EQ(result.estimate.T_target_source.translation.x(), 4.0);
  const auto failing =
      named<Adjusting>("all", [](std::vector<RigEstimate>& all, Rng&) { all[0].failure = "no"; });
  advance(result, failing, StreamKey(1));
  EXPECT_EQ(result.failure, "all: no");
}

TEST(Rig, TheResultOfASensorIsTheFirstThatCanBeTrusted) {
  RigMember failed = member("a", "left", 1.0), rejected = member("b", "left", 2.0),
            first = member("c", "left", 3.0), second = member("d", "left", 4.0);
  failed.result.failure = "no ground";
  rejected.result.estimate.rejection = "no";
  for (RigMember* one : {&failed, &rejected, &first, &second}) {
    one->result.records.push_back({"step", 1.0, {}, {}});
  }
  second.result.records.push_back({"more", 0.5, {}, {}});
  const auto x = [](const std::vector<const RigMember*>& members) {
    return result_of_sensor(members).estimate.T_target_source.translation.x();
  };
  EXPECT_EQ(x({&failed, &rejected, &first, &second}), 3.0);
  EXPECT_EQ(x({&failed, &rejected}), 2.0);
  EXPECT_EQ(result_of_sensor({&failed}).failure, "no ground");
  EXPECT_EQ(result_of_sensor({&second, &failed, &first}).records[0].seconds, 3.0);
  EXPECT_EQ(result_of_sensor({&second, &failed, &first}).records[1].seconds, 0.5);
  EXPECT_EQ(result_of_sensor({&first, &second}).records.at(1).seconds, 0.5);
}

TEST(Rig, KnowsWhetherAStepSeesIt) {
  EXPECT_FALSE(has_rig_step({named<Moving>("move")}));
  EXPECT_TRUE(has_rig_step({named<Moving>("move"), named<Adjusting>("all", [](auto&, Rng&) {})}));
}

}  // namespace
}  // namespace croon
