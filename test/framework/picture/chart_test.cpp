#include "framework/picture/chart.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "framework/picture/writers.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

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

TEST(DrawBand, HasAGapForAnIntervalThatIsMissing) {
  const Plot plot = {0.0, 0.0, 100.0, 100.0, {0.0, 5.0}, {0.0, 1.0}};
  const Interval some = {0.2, 0.6};
  Drawing drawing(100.0, 100.0);
  draw_band(drawing, plot, {0.0, 1.0, 2.0, 3.0, 4.0, 5.0},
            {some, some, std::nullopt, some, some, some}, 1);
  std::vector<std::size_t> areas, edges;
  for (const Drawing::Element& element : drawing.elements()) {
    if (const auto* area = std::get_if<Drawing::Area>(&element)) {
      areas.push_back(area->corners.size());
    }
    if (const auto* edge = std::get_if<Drawing::Polyline>(&element)) {
      edges.push_back(edge->corners.size());
      EXPECT_FALSE(look_of(edge->style, {}).dashes.empty());
    }
  }
  EXPECT_EQ(areas, (std::vector<std::size_t>{4, 6}));
  EXPECT_EQ(edges, (std::vector<std::size_t>{2, 2, 3, 3}));
  // One interval alone is no band.
  Drawing empty(100.0, 100.0);
  draw_band(empty, plot, {0.0, 1.0}, {some, std::nullopt}, 0);
  EXPECT_TRUE(empty.elements().empty());
}

TEST(RoundAxis, OfOneValueStillHasAHeight) {
  for (const double value : {0.0, 1.0, -1e6}) {
    const Axis axis = round_axis(value, value, 5);
    EXPECT_LT(axis.low, value);
    EXPECT_GT(axis.high, value);
  }
}

Drawing with_every_primitive(const Sheet& sheet) {
  Drawing drawing(100.0, 50.0, sheet);
  drawing.text(1.0, 2.0, "a<b & \"c\"\n", Anchor::end, "small", -90.0);
  drawing.line(0.0, 1.0, 2.04, 3.0, "grid");
  drawing.rectangle(0.0, 0.0, 1.0, 1.0, "box c1");
  drawing.dot(5.0, 5.0, 1.5, "dot c2");
  drawing.area({{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}}, "band c3");
  drawing.polyline({{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}}, "curve c4 d1");
  return drawing;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Svg, EveryElementIsClosedAndTextIsEscaped) {
  const std::string svg = svg_bytes(with_every_primitive({}));
  EXPECT_EQ(svg.find("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\" "
                     "viewBox=\"0 0 100 50\">\n<style>\n"),
            0U);
  EXPECT_EQ(svg.substr(svg.find("</style>\n")),
            "</style>\n"
            "<text x=\"1\" y=\"2\" text-anchor=\"end\" class=\"small\" "
            "transform=\"rotate(-90 1 2)\">a&lt;b &amp; &quot;c&quot;\n</text>\n"
            "<line x1=\"0\" y1=\"1\" x2=\"2\" y2=\"3\" class=\"grid\"/>\n"
            "<rect x=\"0\" y=\"0\" width=\"1\" height=\"1\" class=\"box c1\"/>\n"
            "<circle cx=\"5\" cy=\"5\" r=\"1.5\" class=\"dot c2\"/>\n"
            "<polygon points=\"1,1 2,1 2,2 \" class=\"band c3\"/>\n"
            "<polyline points=\"1,1 2,1 2,2 \" class=\"curve c4 d1\"/>\n</svg>\n");
}

TEST(Svg, OfAPaperIsInPointsAndHasNoDarkColours) {
  const std::string svg = svg_bytes(with_every_primitive(kOneColumn));
  EXPECT_NE(svg.find("width=\"100pt\" height=\"50pt\" viewBox=\"0 0 100 50\""), std::string::npos);
  EXPECT_NE(svg.find(".small { font: 8px sans-serif;"), std::string::npos);
  EXPECT_EQ(svg.find("prefers-color-scheme"), std::string::npos);
}

/// The page of a PDF file in points: width and height.
std::array<double, 2> page_of(const std::string& pdf) {
  const std::size_t at = pdf.find("/MediaBox [ 0 0 ");
  std::istringstream numbers(pdf.substr(at + 16, 40));
  std::array<double, 2> page{};
  numbers >> page[0] >> page[1];
  return page;
}

TEST(Pdf, HasThePagesSizeAndTheSameBytesAgain) {
  const std::string pdf = pdf_bytes(with_every_primitive(kOneColumn));
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(count(pdf, "/CreationDate"), 0U);
  EXPECT_EQ(pdf, pdf_bytes(with_every_primitive(kOneColumn)));
  EXPECT_GE(count(pdf, "/FontFile"), 1U);  // Embedded, as publishers want it.
  EXPECT_NEAR(page_of(pdf)[0], 100.0, 0.1);
  EXPECT_NEAR(page_of(pdf)[1], 50.0, 0.1);
  EXPECT_NEAR(page_of(pdf_bytes(with_every_primitive({})))[0], 75.0, 0.1);
}

TEST(DrawOn, DrawsEveryPrimitiveWhereItIs) {
  Image image(200, 100);
  Drawing drawing(100.0, 50.0);
  drawing.rectangle(10.0, 10.0, 20.0, 20.0, "marker c0");
  drawing.dot(70.0, 20.0, 5.0, "marker c1");
  drawing.area({{80.0, 30.0}, {99.0, 30.0}, {80.0, 49.0}}, "marker c2");
  drawing.line(0.0, 40.0, 60.0, 40.0, "median c3");
  drawing.polyline({{40.0, 5.0}, {40.0, 30.0}, {60.0, 30.0}}, "median c4");
  drawing.text(1.0, 49.0, "text", Anchor::start, "title");
  draw_on(image, drawing, 2.0);
  const auto hex = [&](int x, int y) {
    const Colour& colour = image.at(x, y);
    return (colour.red << 16) + (colour.green << 8) + colour.blue;
  };
  EXPECT_EQ(hex(40, 40), 0x0072b2);
  EXPECT_EQ(hex(18, 40), 0xffffff);
  EXPECT_EQ(hex(140, 40), 0xd55e00);
  EXPECT_EQ(hex(166, 66), 0x009e73);
  EXPECT_EQ(hex(60, 80), 0xcc79a7);
  EXPECT_EQ(hex(80, 30), 0xe69f00);
  EXPECT_EQ(hex(100, 60), 0xe69f00);
  int ink = 0;
  for (int y = 84; y < 100; ++y) {
    for (int x = 0; x < 60; ++x) ink += hex(x, y) == 0xffffff ? 0 : 1;
  }
  EXPECT_GT(ink, 50);
}

TEST(Drawing, TextMayHoldAnyBytes) {
  Drawing drawing(100.0, 50.0, kOneColumn);
  drawing.text(1.0, 2.0,
               "a\xff\xc3"
               "b\xed\xa0\x80",
               Anchor::start, "name");
  EXPECT_NE(svg_bytes(drawing).find(">a\xEF\xBF\xBD\xEF\xBF\xBD"
                                    "b\xEF\xBF\xBD"),
            std::string::npos);
  EXPECT_EQ(pdf_bytes(drawing).substr(0, 5), "%PDF-");
}

TEST(Looks, AreNamed) {
  EXPECT_THROW(look_of("curve c1 blue", {}), std::logic_error);
  const Look band = look_of("c1 band", {});
  EXPECT_FALSE(band.has_stroke);
  EXPECT_TRUE(band.has_fill);
  for (const char* style : {"name", "sensor", "title", "small"}) {
    EXPECT_EQ(look_of(style, kOneColumn).text_size, 8.0);
    EXPECT_EQ(look_of(style, kTwoColumns).text_size, 8.0);
  }
  EXPECT_NEAR(kOneColumn.width * 25.4 / 72.0, 88.0, 1e-9);
  EXPECT_NEAR(kTwoColumns.width * 25.4 / 72.0, 180.0, 1e-9);
}

TEST(Series, DifferByDashFromTheirNeighboursAndByDashOrColourFromAll) {
  std::set<std::string> styles;
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_TRUE(styles.insert(series_style(i)).second) << i;
    EXPECT_NE(look_of("curve " + series_style(i), {}).dashes,
              look_of("curve " + series_style(i + 1), {}).dashes);
  }
  std::set<std::string> boxes;
  for (std::size_t i = 0; i < 40; ++i) EXPECT_TRUE(boxes.insert(box_style(i)).second) << i;
  EXPECT_TRUE(look_of("box " + box_style(7), {}).dashes.empty());
  EXPECT_FALSE(look_of("box " + box_style(8), {}).dashes.empty());
}

using Names = std::vector<std::string>;

TEST(DistinctLabels, ShowWhatDiffers) {
  EXPECT_EQ(
      distinct_labels({"base/ransac/icpn/exhaustive/leaf=0.05",
                       "base/cgal/icpn/exhaustive/leaf=0.05", "base/ransac/icpn/golden/leaf=0.05"},
                      30),
      (Names{"ransac/exhaustive", "cgal/exhaustive", "ransac/golden"}));
  EXPECT_EQ(distinct_labels({"base/icpn", "no volume/icpn/a"}, 30),
            (Names{"base/icpn", "no volume/icpn/a"}));
  EXPECT_EQ(distinct_labels({"base/x", "base/x/y"}, 30), (Names{"x", "x/y"}));
  EXPECT_EQ(distinct_labels({"base/icpn"}, 30), (Names{"base/icpn"}));
  EXPECT_EQ(distinct_labels({"base", "rough"}, 30), (Names{"base", "rough"}));
  // The values of a grid are what tells its names apart.
  EXPECT_EQ(
      distinct_labels(
          {"base/kernel_width_m=0.1/max_iterations=5", "base/kernel_width_m=0.2/max_iterations=5",
           "base/kernel_width_m=0.1/max_iterations=6", "base/kernel_width_m=0.2/max_iterations=6"},
          20),
      (Names{"ke…h_m=0.1/ma…ons=5", "ke…h_m=0.2/ma…ons=5", "ke…h_m=0.1/ma…ons=6",
             "ke…h_m=0.2/ma…ons=6"}));
  const Names cut = distinct_labels({"aaaaaaaaaa1bbbbbbbbbb", "aaaaaaaaaa2bbbbbbbbbb"}, 9);
  EXPECT_NE(cut[0], cut[1]);
  EXPECT_EQ(cut[0], "1: aa…bbb");
}

}  // namespace
}  // namespace croon::test
