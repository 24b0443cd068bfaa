#include "experiments/report/plots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/report/axis.hpp"
#include "experiments/report/box_groups.hpp"
#include "experiments/report/svg.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::test_rng;
using test::kBounds;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::vector<BoxGroup> groups_of(const Summary& summary, std::size_t max_scenes) {
  return box_groups(summary, box_of(summary, max_scenes, 20));
}

TEST(RoundAxis, HoldsTheRangeWithRoundTicks) {
  Rng rng = test_rng();
  for (int i = 0; i < 2000; ++i) {
    const double scale = std::pow(10.0, rng.uniform(-4.0, 4.0));
    const double low = scale * rng.uniform(-1.0, 0.0);
    const double high = scale * rng.uniform(0.0, 1.0);
    const Axis axis = round_axis(low, high, 5);
    EXPECT_LE(axis.low, low);
    EXPECT_GE(axis.high, high);
    EXPECT_GE(axis.ticks.size(), 3U);
    EXPECT_LE(axis.ticks.size(), 8U);
    // As many decimals as are shown tell every tick exactly.
    const double unit = std::pow(10.0, -axis.decimals);
    for (const double tick : axis.ticks) {
      EXPECT_NEAR(tick / unit, std::round(tick / unit), 1e-6);
    }
  }
}

TEST(RoundAxis, OfOneValueStillHasAHeight) {
  for (const double value : {0.0, 1.0, -1e6}) {
    const Axis axis = round_axis(value, value, 5);
    EXPECT_LT(axis.low, value);
    EXPECT_GT(axis.high, value);
  }
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

TEST(Svg, EveryElementIsClosedAndTextIsEscaped) {
  Svg svg(100.0, 50.0, "text { fill: red; }\n");
  svg.text(1.0, 2.0, "a<b & \"c\"\n", Anchor::end, "small", -90.0);
  svg.line(0.0, 1.0, 2.04, 3.0, "grid");
  svg.rectangle(0.0, 0.0, 1.0, 1.0, "box");
  svg.dot(5.0, 5.0, 1.5, "dot");
  EXPECT_EQ(
      svg.bytes(),
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\" "
      "viewBox=\"0 0 100 50\">\n<style>\ntext { fill: red; }\n</style>\n"
      "<text x=\"1\" y=\"2\" text-anchor=\"end\" class=\"small\" transform=\"rotate(-90 1 2)\">"
      "a&lt;b &amp; &quot;c&quot; </text>\n"
      "<line x1=\"0\" y1=\"1\" x2=\"2\" y2=\"3\" class=\"grid\"/>\n"
      "<rect x=\"0\" y=\"0\" width=\"1\" height=\"1\" class=\"box\"/>\n"
      "<circle cx=\"5\" cy=\"5\" r=\"1.5\" class=\"dot\"/>\n</svg>\n");
}

}  // namespace
}  // namespace croon::experiments
