#include "experiments/report/box_drawing.hpp"
#include "experiments/report/plots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "framework/picture/writers.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/support/occurrences.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;

std::string box_plots_svg(const Summary& summary) { return svg_bytes(box_plots(summary)); }

/// The elements of a type whose style starts with `part`.
template <class Element>
std::vector<Element> elements_of(const Drawing& drawing, const std::string& part) {
  std::vector<Element> found;
  for (const Drawing::Element& element : drawing.elements()) {
    const auto* one = std::get_if<Element>(&element);
    if (one != nullptr && one->style.rfind(part, 0) == 0) found.push_back(*one);
  }
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
  EXPECT_EQ(
      test::occurrences(box_plots_svg(summary), ">A box is one sensor in all scenes of one kind:"),
      1U);
}

TEST(BoxPlotsSvg, HasAPanelPerDofAndABoxPerVariantAndSensor) {
  const Drawing drawing = box_plots(summarise(test::few_records(), kBounds, {}));
  EXPECT_THAT(test::unreadable_parts(drawing), testing::IsEmpty());
  EXPECT_EQ(elements_of<Drawing::Rectangle>(drawing, "box c").size(), 6U * 2U * 2U);
  EXPECT_EQ(elements_of<Drawing::Line>(drawing, "median c").size(), 6U * 2U * 2U);
  EXPECT_TRUE(elements_of<Drawing::Dot>(drawing, "dot c").empty());
  const std::string svg = svg_bytes(drawing);
  for (const char* title : {"pitch, deg", "roll, deg", "yaw, deg", "x, mm", "y, mm", "z, mm"}) {
    EXPECT_EQ(test::occurrences(svg, std::string(">") + title + "<"), 1U) << title;
  }
  EXPECT_EQ(test::occurrences(svg, ">no volume<"), 6U * 2U);
  EXPECT_EQ(test::occurrences(svg, ">A box is one variant and sensor, all scenes together:"), 1U);
  EXPECT_EQ(test::occurrences(svg, "nan") + test::occurrences(svg, "inf"), 0U);
}

TEST(BoxPlotsSvg, AValueBeyondTheWhiskersIsADot) {
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 9; ++trial) {
    const double x_m = trial == 0 ? 0.02 : 0.001 * trial;
    records.push_back(test::finished({"base", "0001", "front", trial}, Status::success, {},
                                     test::offset_of(0, 0, 0, x_m, 0, 0)));
  }
  const Drawing drawing = box_plots(summarise(records, kBounds, {}));
  EXPECT_EQ(elements_of<Drawing::Dot>(drawing, "dot c").size(), 1U);
}

/// Trials of variants of one sensor, each with errors of x around its number of metres.
Summary around(const std::vector<std::pair<std::string, double>>& variants) {
  std::vector<TrialRecord> records;
  for (const auto& [variant, size_m] : variants) {
    for (int trial = 0; trial < 9; ++trial) {
      records.push_back(test::finished({variant, "0001", "front", trial}, Status::success, {},
                                       test::offset_of(0, 0, 0, size_m * (trial - 4) / 4.0, 0, 0)));
    }
  }
  return summarise(records, {20.0, 20.0}, {});
}

TEST(BoxPlots, TheBestBoxOfASensorIsSeen) {
  constexpr std::size_t kX = 3;
  std::vector<BoxGroup> groups = groups_of(around({{"a", 0.01}, {"b", 0.012}, {"c", 0.01}}), 12);
  const std::vector<BoxGroup> worse = groups_of(around({{"a", 0.08}, {"b", 0.09}}), 12);
  groups.push_back(worse.front());
  EXPECT_NEAR(robust_limit(groups, kX), 0.08, 1e-9);
  groups.back() = groups_of(around({{"a", 5.0}, {"b", 6.0}}), 12).front();
  EXPECT_NEAR(robust_limit(groups, kX), 10.0 * 0.012, 1e-9);
}

TEST(BoxPlots, OneBadVariantDoesNotFlattenTheOthers) {
  const Summary summary = around({{"a", 0.01}, {"b", 0.012}, {"bad", 10.0}});
  const auto groups = groups_of(summary, 12);
  constexpr std::size_t kX = 3;
  EXPECT_NEAR(robust_limit(groups, kX), 3.0 * 0.012, 1e-9);
  const std::string svg = svg_bytes(box_plots(summary));
  EXPECT_EQ(test::occurrences(svg, ">x, mm<"), 1U);
  EXPECT_EQ(test::occurrences(svg, ">40<") + test::occurrences(svg, ">50<") +
                test::occurrences(svg, ">100<"),
            1U);  // The axis' end.
  // Of the nine values of "bad", eight lie beyond the axis, four at each end.
  EXPECT_EQ(test::occurrences(svg, ">4</text>"), 2U);
  EXPECT_EQ(test::occurrences(svg, "arrowheads"),
            2U);  // Said in the description and below the title.
  EXPECT_EQ(
      test::occurrences(svg_bytes(box_plots(around({{"a", 0.01}, {"b", 0.012}}))), "arrowheads"),
      0U);
  // Every box is drawn inside its plot.
  const Drawing drawing = box_plots(summary);
  EXPECT_EQ(elements_of<Drawing::Area>(drawing, "marker").size(), 2U);
  for (const Drawing::Element& element : drawing.elements()) {
    const auto* box = std::get_if<Drawing::Rectangle>(&element);
    if (box == nullptr || box->style == "page") continue;
    EXPECT_LE(box->height, 190.0 + 1e-9);
  }
}

TEST(Box, OfFewValuesIsDots) {
  for (std::size_t n = 1; n < 9; ++n) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(static_cast<double>(i));
    Drawing drawing(100.0, 100.0);
    draw_box(drawing, {0.0, 0.0, 100.0, 100.0, {0.0, 1.0}, {-1.0, 9.0}}, 50.0, 20.0, 0, values);
    const bool is_box = n >= kMinBoxValues;
    const auto dots = elements_of<Drawing::Dot>(drawing, "dot");
    ASSERT_EQ(dots.size(), is_box ? 0U : n);
    // Of the values 0 to n - 1 on an axis from -1 to 9; positions run downwards.
    for (std::size_t i = 0; i < dots.size(); ++i) {
      EXPECT_NEAR(dots[dots.size() - 1 - i].y, 90.0 - 10.0 * values[i], 0.26);
    }
    EXPECT_EQ(elements_of<Drawing::Rectangle>(drawing, "box").size(), is_box ? 1U : 0U);
    const auto medians = elements_of<Drawing::Line>(drawing, "median");
    ASSERT_EQ(medians.size(), is_box ? 1U : 0U);
    if (is_box) {
      EXPECT_NEAR(medians.front().y1, 90.0 - 5.0 * values.back(), 1e-9);
    }
  }
}

TEST(Box, IsOpenAtTheEndOfTheAxis) {
  Rng rng = croon::test::test_rng();
  const Plot plot = {0.0, 10.0, 100.0, 50.0, {0.0, 1.0}, {-1.0, 1.0}};
  const auto at_border = [&](double y) { return y == plot.top || y == plot.top + plot.height; };
  int cut = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<double> values;
    const double centre = 2.0 * rng.uniform() - 1.0;
    for (int k = 0; k < 20; ++k) values.push_back(centre + 3.0 * (rng.uniform() - 0.5));
    Drawing drawing(100.0, 100.0);
    draw_box(drawing, plot, 50.0, 20.0, 0, values);
    cut += is_cut(values, plot.y_range);
    for (const auto& line : elements_of<Drawing::Line>(drawing, "line")) {
      EXPECT_FALSE(line.y1 == line.y2 && at_border(line.y1));
    }
    for (const auto& box : elements_of<Drawing::Rectangle>(drawing, "box")) {
      EXPECT_FALSE(at_border(box.y) || at_border(box.y + box.height));
    }
    for (const auto& outline : elements_of<Drawing::Polyline>(drawing, "line")) {
      ASSERT_EQ(outline.corners.size(), 4U);
      EXPECT_TRUE(at_border(outline.corners.front()[1]));
      EXPECT_FALSE(at_border(outline.corners[1][1]));
    }
    for (const auto& inside : elements_of<Drawing::Rectangle>(drawing, "inside")) {
      EXPECT_FALSE(look_of(inside.style, {}).has_stroke);
      EXPECT_TRUE(at_border(inside.y) || at_border(inside.y + inside.height));
    }
    const Beyond beyond = count_beyond(values, plot.y_range);
    EXPECT_EQ(elements_of<Drawing::Area>(drawing, "marker").size(),
              static_cast<std::size_t>((beyond.above > 0) + (beyond.below > 0)));
    if (!is_cut(values, plot.y_range)) {
      EXPECT_EQ(elements_of<Drawing::Rectangle>(drawing, "box").size(), 1U);
    }
  }
  EXPECT_GT(cut, 100);
}

TEST(BoxPlots, TellHowManyOfItsTrialsABoxHolds) {
  const Summary summary = summarise(test::few_records(), kBounds, {});
  for (const BoxGroup& group : groups_of(summary, 12)) {
    for (const BoxSeries& box : group.boxes) {
      const Rows rows = rows_of(summary, box.label, group.sensor);
      ASSERT_EQ(rows.size(), 1U);
      EXPECT_EQ(box.trials, rows.front()->outcomes.trials);
      EXPECT_EQ(static_cast<int>(box.deviations.size()), rows.front()->counted);
    }
  }
  const std::string screen = box_plots_svg(summary);
  EXPECT_EQ(test::occurrences(screen, ">6/8</text>"), 6U * 2U);
  EXPECT_EQ(test::occurrences(screen, ">6/7</text>"), 6U);
  EXPECT_EQ(test::occurrences(screen, ">6/6</text>"), 6U);
  // On paper the panels of a column share the names below them, and with them the numbers.
  EXPECT_GE(test::occurrences(svg_bytes(box_plots(summary, {kOneColumn})), ">6/8</text>"), 2U);
  EXPECT_NE(box_plots(summary).description().find("n/N: n of N trials in the box"),
            std::string::npos);
  EXPECT_EQ(box_plots(summary).description().find("open"), std::string::npos);
}

TEST(BoxPlots, ExplainWhatIsCutAndWhatIsFew) {
  const std::string cut =
      box_plots(around({{"a", 0.01}, {"b", 0.012}, {"bad", 10.0}})).description();
  EXPECT_NE(cut.find("a box or whisker that extends beyond the axis is open there"),
            std::string::npos);
  EXPECT_EQ(cut.find("fewer than 5 values"), std::string::npos);
  std::vector<TrialRecord> records = test::few_records();
  records.push_back(test::finished({"few", "0001", "left", 0}, Status::success, {},
                                   test::offset_of(0, 0, 0, 0.01, 0, 0)));
  const std::string few = box_plots(summarise(records, kBounds, {})).description();
  EXPECT_NE(few.find("fewer than 5 values are drawn as dots"), std::string::npos);
}

TEST(BoxPlots, NeverZoomInOnLessThanTablesShow) {
  EXPECT_NEAR(robust_limit(groups_of(around({{"a", 1e-9}}), 12), 3), 1e-3, 1e-12);
  EXPECT_NEAR(robust_limit({}, 0), 1e-2, 1e-12);
}

TEST(BoxPlots, LengthsAreInTheUnitThatIsAskedFor) {
  const Summary summary = around({{"a", 0.01}});
  EXPECT_EQ(test::occurrences(svg_bytes(box_plots(summary, {{}, "m"})), ">x, m<"), 1U);
  EXPECT_EQ(test::occurrences(svg_bytes(box_plots(around({{"a", 0.5}}), {})), ">x, m<"), 1U);
  EXPECT_EQ(test::occurrences(svg_bytes(box_plots(around({{"a", 0.5}}), {{}, "mm"})), ">x, mm<"),
            1U);
}

TEST(BoxPlots, OnPaperHaveTheWidthOfTheColumnAndTextOfEightPoints) {
  const Summary summary = summarise(test::few_records(), kBounds, {});
  for (const Sheet& sheet : {kOneColumn, kTwoColumns}) {
    const Drawing drawing = box_plots(summary, {sheet});
    EXPECT_EQ(drawing.width(), sheet.width);
    EXPECT_LE(drawing.height(), 680.0);  // Of a page.
    EXPECT_THAT(test::unreadable_parts(drawing), testing::IsEmpty());
    for (const Drawing::Element& element : drawing.elements()) {
      if (const auto* text = std::get_if<Drawing::Text>(&element)) {
        EXPECT_EQ(look_of(text->style, sheet).text_size, 8.0);
        EXPECT_EQ(text->text.find("Error of"), std::string::npos);
      }
    }
    EXPECT_NE(drawing.description().find("Error of the successful trials"), std::string::npos);
    Sheet titled = sheet;
    titled.has_title = true;
    EXPECT_EQ(
        test::occurrences(svg_bytes(box_plots(summary, {titled})), "class=\"title\">Error of"), 1U);
    EXPECT_EQ(test::occurrences(svg_bytes(drawing), "class=\"title\">Error of"), 0U);
  }
}

TEST(BoxPlots, ThatDoNotFitAreRefused) {
  std::vector<std::pair<std::string, double>> variants;
  for (int i = 0; i < 60; ++i) variants.emplace_back("variant" + std::to_string(i), 0.01);
  try {
    box_plots(around(variants), {kOneColumn});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(test::occurrences(error.what(), "60 boxes with their names need "), 1U)
        << error.what();
  }
  EXPECT_EQ(elements_of<Drawing::Rectangle>(box_plots(around(variants)), "box c").size(), 6U * 60U);
}

TEST(BoxPlotsSvg, AVariantWithoutSuccessKeepsItsPlace) {
  std::vector<TrialRecord> records = test::few_records();
  for (const char* sensor : {"left", "right"}) {
    records.push_back(test::unfinished({"lost", "0001", sensor, 0}, Status::failed, "no"));
  }
  const std::string svg = box_plots_svg(summarise(records, kBounds, {}));
  EXPECT_EQ(test::occurrences(svg, ">lost<"), kDofs * 2);
  EXPECT_EQ(test::occurrences(svg, ">none<"), kDofs * 2);
}

TEST(BoxPlotsSvg, NothingToShowIsAPictureToo) {
  const std::string empty = box_plots_svg(Summary{});
  EXPECT_EQ(test::occurrences(empty, "</svg>"), 1U);
  const Summary failed =
      summarise({test::unfinished({"base", "a", "b", 0}, Status::failed, "no")}, kBounds, {});
  EXPECT_TRUE(elements_of<Drawing::Rectangle>(box_plots(failed), "box c").empty());
  EXPECT_EQ(test::occurrences(empty, "nan") + test::occurrences(empty, "inf"), 0U);
}

}  // namespace
}  // namespace croon::experiments
