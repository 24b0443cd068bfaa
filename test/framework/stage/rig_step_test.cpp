#include "framework/stage/rig_step.hpp"

#include <gtest/gtest.h>

#include "framework/base/error.hpp"

namespace croon {
namespace {

using Names = std::vector<std::vector<std::string>>;

/// The names of the estimates of each group, "scene target source".
Names names_of(const std::vector<RigGroup>& groups) {
  Names names;
  for (const RigGroup& group : groups) {
    names.emplace_back();
    for (const RigEstimate* const one : group) {
      names.back().push_back(one->scene + " " + one->target + " " + one->source);
    }
  }
  return names;
}

std::vector<RigEstimate> two_scenes() {
  std::vector<RigEstimate> rig;
  for (const char* scene : {"b", "a"}) {
    rig.push_back({scene, "top", "right", {}});
    rig.push_back({scene, "top", "left", {}});
    rig.push_back({scene, "left", "right", {}});
  }
  return rig;
}

TEST(RigGroups, AreByKeyInTheOrderOfTheRig) {
  std::vector<RigEstimate> rig = two_scenes();
  EXPECT_EQ(names_of(rig_groups(rig,
                                [](const RigEstimate& one) {
                                  return RigKey{one.target, one.source};
                                })),
            (Names{{"b left right", "a left right"},
                   {"b top left", "a top left"},
                   {"b top right", "a top right"}}));
  EXPECT_EQ(names_of(rig_groups(rig, [](const RigEstimate& one) { return RigKey{one.target}; })),
            (Names{{"b left right", "a left right"},
                   {"b top right", "b top left", "a top right", "a top left"}}));
}

TEST(RigGroups, LeaveOutEstimatesWithoutAKeyOrThatFail) {
  std::vector<RigEstimate> rig = two_scenes();
  const auto key_of = [](const RigEstimate& one) -> std::optional<RigKey> {
    if (one.target == "left") return std::nullopt;
    if (one.scene == "a") throw StageError("too dark");
    return RigKey{one.source};
  };
  EXPECT_EQ(names_of(rig_groups(rig, key_of)), (Names{{"b top left"}, {"b top right"}}));
  for (const RigEstimate& one : rig) {
    EXPECT_EQ(one.failure, one.scene == "a" && one.target == "top" ? "too dark" : "");
  }
}

TEST(RigGroups, FailAlone) {
  std::vector<RigEstimate> rig = two_scenes();
  rig[0].failure = "no points";
  const auto scene = [](const RigEstimate& one) { return RigKey{one.scene}; };
  for_each_group(rig_groups(rig, scene), [](const RigGroup& group) {
    if (group.front()->scene == "b") throw StageError("too dark");
    for (RigEstimate* const one : group) one->scenes = 7;
  });
  EXPECT_EQ(rig[0].failure, "no points");
  EXPECT_EQ(rig[1].failure, "too dark");
  EXPECT_EQ(rig[3].failure, "");
  EXPECT_EQ(rig[3].scenes, 7U);
}

}  // namespace
}  // namespace croon
