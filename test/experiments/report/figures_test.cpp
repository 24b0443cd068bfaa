#include "experiments/report/figures.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "experiments/report/panels.hpp"
#include "framework/picture/writers.hpp"
#include "test/support/occurrences.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::occurrences;

/// Two variants in `scenes` scenes of two kinds; the second fails in one kind.
Summary by_kind(int scenes) {
  std::vector<TrialRecord> records;
  ReportOrder order;
  order.variants = {"base", "lost"};
  for (int i = 0; i < scenes; ++i) {
    const std::string scene = std::to_string(i);
    order.scene_kinds[scene] = i % 2 == 0 ? "highway" : "urban";
    for (const char* variant : {"base", "lost"}) {
      const TrialId id = {variant, scene, "left", 0};
      const bool fails = i % 2 == 0 && id.variant == "lost";
      records.push_back(fails ? test::unfinished(id, Status::failed, "no ground")
                              : test::finished(id, Status::success, {}, Vector6d::Zero()));
    }
  }
  return summarise(records, test::kBounds, order);
}

template <class Element>
std::vector<Element> with_style(const Drawing& drawing, const std::string& style) {
  std::vector<Element> found;
  for (const Drawing::Element& element : drawing.elements()) {
    const auto* it = std::get_if<Element>(&element);
    if (it != nullptr && it->style.rfind(style, 0) == 0) found.push_back(*it);
  }
  return found;
}

TEST(KindsChart, HasABarPerVariantAndKindWithIntervalsOfManyScenes) {
  const Drawing drawing = kinds_chart(by_kind(12), {kOneColumn});
  const auto bars = with_style<Drawing::Rectangle>(drawing, "box");
  ASSERT_EQ(bars.size(), 4U + 2U);  // And the legend.
  EXPECT_GT(bars[0].height, 50.0);
  EXPECT_EQ(bars[1].height, 0.0);
  EXPECT_EQ(with_style<Drawing::Line>(drawing, "line").size(), 4U * 3U);
  EXPECT_TRUE(with_style<Drawing::Line>(kinds_chart(by_kind(4), {kOneColumn}), "line").empty());
  const std::string svg = svg_bytes(drawing);
  for (const char* text : {">highway (6)<", ">urban (6)<", ">success, %<", ">lost<"}) {
    EXPECT_EQ(occurrences(svg, text), 1U) << text;
  }
  EXPECT_EQ(occurrences(svg, "nan") + occurrences(svg, "inf"), 0U);
}

TEST(TimesChart, StacksTheStepsOfEachVariant) {
  const std::vector<StepTime> times = {
      {"base", "yaw", 0.5}, {"base", "icp", 1.0}, {"rough", "yaw", 0.5}};
  const Drawing drawing = times_chart(times, {kOneColumn});
  const auto bars = with_style<Drawing::Rectangle>(drawing, "box");
  ASSERT_EQ(bars.size(), 3U + 2U);
  EXPECT_NEAR(bars[1].x, bars[0].x + bars[0].width, 1e-9);
  EXPECT_NEAR(bars[1].width, 2.0 * bars[0].width, 1e-9);
  EXPECT_EQ(bars[2].style, bars[0].style);
  EXPECT_EQ(bars[2].x, bars[0].x);
  EXPECT_GT(bars[2].y, bars[0].y + bars[0].height);
  EXPECT_EQ(occurrences(svg_bytes(drawing), ">base: 1.50 s<"), 1U);
}

/// The legend entry of a series as SVG, without colours.
std::string grey_entry(std::size_t series, SeriesMark mark) {
  Drawing drawing(10.0, 10.0, kOneColumn);
  draw_legend_entry(drawing, 0.0, 5.0, series, "", mark);
  const std::string svg = svg_bytes(drawing);
  return std::regex_replace(svg.substr(svg.find("</style>")), std::regex(" c[0-9]"), "");
}

TEST(Figures, WithoutColoursHaveDistinctSeries) {
  for (const SeriesMark mark : {SeriesMark::line, SeriesMark::bar}) {
    std::set<std::string> entries;
    for (std::size_t series = 0; series < 35; ++series) entries.insert(grey_entry(series, mark));
    EXPECT_EQ(entries.size(), 35U);
  }
}

TEST(Figures, OnPaperHaveTextOf8Points) {
  Results results;
  results.summary = by_kind(12);
  results.times = {{"base", "yaw", 0.5}};
  int drawn = 0;
  for (const Figure& figure : figures()) {
    for (const Sheet& sheet : {kOneColumn, kTwoColumns}) {
      const std::optional<Drawing> drawing = figure.draw(results, {sheet});
      if (!drawing) continue;
      ++drawn;
      EXPECT_EQ(drawing->width(), sheet.width) << figure.name;
      for (const Drawing::Element& element : drawing->elements()) {
        const auto* text = std::get_if<Drawing::Text>(&element);
        if (text != nullptr) {
          EXPECT_EQ(look_of(text->style, sheet).text_size, 8.0) << figure.name;
        }
      }
    }
  }
  EXPECT_EQ(drawn, 2 * 4);
}

}  // namespace
}  // namespace croon::experiments
