#include "experiments/report/plots.hpp"

#include <gtest/gtest.h>

#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::vector<BoxGroup> groups_of(const Summary& summary, std::size_t max_scenes) {
  return box_groups(summary, box_of(summary, max_scenes, 20));
}

TEST(BoxGroups, AreBySceneForOneVariantAndByVariantForSeveral) {
  auto records = test::few_records();
  const auto several = groups_of(summarise(records, kBounds, {}), 12);
  ASSERT_EQ(several.size(), 2U);
  EXPECT_EQ(several[0].sensor, "left");
  ASSERT_EQ(several[0].boxes.size(), 2U);
  EXPECT_EQ(several[0].boxes[1].label, "no volume");
  EXPECT_EQ(several[0].boxes[1].deviations.size(), 6U);
  for (TrialRecord& record : records) record.id.variant = "base";
  const auto one = groups_of(summarise(records, kBounds, {}), 12);
  EXPECT_EQ(one[1].boxes[1].label, "0002");
  EXPECT_EQ(one[1].boxes[1].colour, one[0].boxes[1].colour);
  const auto pooled = groups_of(summarise(records, kBounds, {}), 1);
  ASSERT_EQ(pooled[0].boxes.size(), 1U);
  EXPECT_EQ(pooled[0].boxes[0].label, "");
}

TEST(BoxGroups, OfManyScenesAreByKind) {
  std::vector<TrialRecord> records;
  ReportOrder order;
  const char* kinds[] = {"urban", "narrow", "highway"};
  for (int i = 0; i < 60; ++i) {
    const std::string scene = std::to_string(i);
    order.scene_kinds[scene] = kinds[i % 3];
    records.push_back(test::finished({"base", scene, "left", 0}, Status::success, {},
                                     test::offset_of(0, 0, 0, 0.01 * (i % 3), 0, 0)));
  }
  const Summary summary = summarise(records, kBounds, order);
  const auto groups = groups_of(summary, 12);
  ASSERT_EQ(groups.size(), 1U);
  ASSERT_EQ(groups[0].boxes.size(), 3U);
  const char* labels[] = {"highway", "narrow", "urban"};
  for (std::size_t k = 0; k < 3; ++k) {
    const BoxSeries& box = groups[0].boxes[k];
    EXPECT_EQ(box.label, labels[k]);
    ASSERT_EQ(box.deviations.size(), 20U);
    for (const Measures& deviation : box.deviations) {
      EXPECT_NEAR(deviation[3], 0.01 * static_cast<double>(2 - k), 1e-12);
    }
  }
  EXPECT_EQ(box_of(summary, 60, 20), BoxOf::scene);
  EXPECT_EQ(box_of(summary, 12, 2), BoxOf::all_scenes);
  EXPECT_EQ(box_of(summarise(records, kBounds, {}), 12, 20), BoxOf::all_scenes);
  EXPECT_EQ(count(box_plots_svg(summary), ">A box is one sensor in all scenes of one kind:"), 1U);
}

TEST(BoxPlotsSvg, HasAPanelPerDofAndABoxPerVariantAndSensor) {
  const std::string svg = box_plots_svg(summarise(test::few_records(), kBounds, {}));
  for (const char* title : {"pitch, deg", "roll, deg", "yaw, deg", "x, m", "y, m", "z, m"}) {
    EXPECT_EQ(count(svg, std::string(">") + title + "<"), 1U) << title;
  }
  EXPECT_EQ(count(svg, "class=\"box c"), 6U * 2U * 2U);
  EXPECT_EQ(count(svg, "class=\"median c"), 6U * 2U * 2U);
  EXPECT_EQ(count(svg, ">no volume<"), 6U * 2U);
  EXPECT_EQ(count(svg, ">A box is one variant and sensor, all scenes together:"), 1U);
  EXPECT_EQ(count(svg, "class=\"dot c"), 0U);
  EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0U);
}

TEST(BoxPlotsSvg, AValueBeyondTheWhiskersIsADot) {
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 9; ++trial) {
    const double x_m = trial == 0 ? 0.09 : 0.001 * trial;
    records.push_back(test::finished({"base", "0001", "front", trial}, Status::success, {},
                                     test::offset_of(0, 0, 0, x_m, 0, 0)));
  }
  EXPECT_EQ(count(box_plots_svg(summarise(records, kBounds, {})), "class=\"dot c"), 1U);
}

TEST(BoxPlotsSvg, AVariantWithoutSuccessKeepsItsPlace) {
  std::vector<TrialRecord> records = test::few_records();
  for (const char* sensor : {"left", "right"}) {
    records.push_back(test::unfinished({"lost", "0001", sensor, 0}, Status::failed, "no"));
  }
  const std::string svg = box_plots_svg(summarise(records, kBounds, {}));
  EXPECT_EQ(count(svg, ">lost<"), kDofs * 2);
  EXPECT_EQ(count(svg, ">none<"), kDofs * 2);
}

TEST(BoxPlotsSvg, NothingToShowIsAPictureToo) {
  const std::string empty = box_plots_svg(Summary{});
  EXPECT_EQ(count(empty, "</svg>"), 1U);
  const Summary failed =
      summarise({test::unfinished({"base", "a", "b", 0}, Status::failed, "no")}, kBounds, {});
  EXPECT_EQ(count(box_plots_svg(failed), "class=\"box c"), 0U);
  EXPECT_EQ(count(empty, "nan") + count(empty, "inf"), 0U);
}

}  // namespace
}  // namespace croon::experiments
