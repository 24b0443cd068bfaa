#include "framework/picture/chart.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/picture/svg.hpp"
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

TEST(RoundAxis, OfOneValueStillHasAHeight) {
  for (const double value : {0.0, 1.0, -1e6}) {
    const Axis axis = round_axis(value, value, 5);
    EXPECT_LT(axis.low, value);
    EXPECT_GT(axis.high, value);
  }
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
}  // namespace croon::test
