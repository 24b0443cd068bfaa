#include "framework/stage/yaw_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "framework/base/angles.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// Searches of +-90 degrees and how near to the least of a well-behaved function each must come.
struct Case {
  const char* json;
  double accuracy_deg;
};
const Case kCases[] = {
    {R"({"type": "exhaustive", "range_deg": 90, "step_deg": 0.5})", 0.25},
    {R"({"type": "binary", "range_deg": 90, "step_deg": 5, "levels": 6})", 5.0 / 64.0},
    {R"({"type": "golden_section", "range_deg": 90, "bracket_step_deg": 5, "tolerance_deg": 0.01})",
     0.01},
};

/// `base + a (yaw - least)^2 + b |yaw - least|`, one least, symmetric about it.
struct Bowl {
  double least_rad, a, b, base;
  double operator()(double yaw_rad) const {
    const double d = yaw_rad - least_rad;
    return base + a * d * d + b * std::abs(d);
  }
};

Bowl random_bowl(Rng& rng) {
  const double least_rad = rad_from_deg(rng.uniform(-85.0, 85.0));
  const double a = rng.uniform(0.1, 5.0);
  const double b = rng.uniform(0.0, 2.0);
  return {least_rad, a, b, rng.uniform(0.0, 3.0)};
}

TEST(YawSearch, FindsTheLeastOfABowl) {
  Rng rng = test::test_rng();
  for (const Case& search : kCases) {
    const auto stage = test::stage<YawSearch>(search.json);
    for (int i = 0; i < 300; ++i) {
      const Bowl bowl = random_bowl(rng);
      const YawMinimum minimum = stage->minimise(bowl);
      EXPECT_LE(std::abs(deg_from_rad(minimum.yaw_rad - bowl.least_rad)),
                search.accuracy_deg + 1e-9)
          << search.json;
      EXPECT_EQ(minimum.cost, bowl(minimum.yaw_rad));
    }
  }
}

TEST(YawSearch, FindsTheLeastOfAPeriodicFunctionThroughNoise) {
  Rng rng = test::test_rng(2);
  for (const Case& search : kCases) {
    const auto stage = test::stage<YawSearch>(search.json);
    for (int i = 0; i < 300; ++i) {
      const double least_rad = rad_from_deg(rng.uniform(-85.0, 85.0));
      const double phase = rng.uniform(0.0, 2.0 * kPi);
      // The ripple moves the least by at most sqrt(4 * 1e-4) = 0.02 rad, since 1 - cos(d) >= d^2
      // / 2.1 here.
      const YawCost cost = [&](double yaw_rad) {
        return 1.0 - std::cos(yaw_rad - least_rad) + 1e-4 * std::sin(400.0 * yaw_rad + phase);
      };
      const double error_rad = stage->minimise(cost).yaw_rad - least_rad;
      EXPECT_LE(std::abs(deg_from_rad(error_rad)), search.accuracy_deg + deg_from_rad(0.021))
          << search.json;
    }
  }
}

TEST(YawSearch, PrefersTheDeeperOfTwoBowls) {
  Rng rng = test::test_rng(3);
  for (const Case& search : kCases) {
    const auto stage = test::stage<YawSearch>(search.json);
    for (int i = 0; i < 100; ++i) {
      const double left_rad = rad_from_deg(rng.uniform(-80.0, -20.0));
      const double right_rad = rad_from_deg(rng.uniform(20.0, 80.0));
      const bool right_is_deeper = rng.below(2) == 1;
      const YawCost cost = [&](double yaw_rad) {
        const double left = std::abs(yaw_rad - left_rad) + (right_is_deeper ? 0.3 : 0.0);
        const double right = std::abs(yaw_rad - right_rad) + (right_is_deeper ? 0.0 : 0.3);
        return std::min(left, right);
      };
      const double deeper_rad = right_is_deeper ? right_rad : left_rad;
      EXPECT_LE(std::abs(deg_from_rad(stage->minimise(cost).yaw_rad - deeper_rad)),
                search.accuracy_deg + 1e-9)
          << search.json;
    }
  }
}

TEST(YawSearch, CountsItsEvaluationsRepeatsNoneAndIsDeterministic) {
  Rng rng = test::test_rng(4);
  for (const Case& search : kCases) {
    const auto stage = test::stage<YawSearch>(search.json);
    for (int i = 0; i < 50; ++i) {
      const Bowl bowl = random_bowl(rng);
      int calls = 0;
      std::set<double> yaws;
      const YawMinimum minimum = stage->minimise([&](double yaw_rad) {
        ++calls;
        EXPECT_TRUE(yaws.insert(yaw_rad).second) << search.json << " looks twice at " << yaw_rad;
        return bowl(yaw_rad);
      });
      EXPECT_EQ(minimum.evaluations, calls);
      const YawMinimum again = stage->minimise(bowl);
      EXPECT_EQ(again.yaw_rad, minimum.yaw_rad);
      EXPECT_EQ(again.cost, minimum.cost);
      EXPECT_EQ(again.evaluations, calls);
    }
  }
}

TEST(YawSearch, AGlanceDecidesWhereItLooksFirstAndNotWhatItFinds) {
  Rng rng = test::test_rng(5);
  for (const Case& search : kCases) {
    const auto stage = test::stage<YawSearch>(search.json);
    for (int i = 0; i < 50; ++i) {
      const Bowl bowl = random_bowl(rng);
      // Steps, so that many yaws cost the same.
      const auto cost = [&](double yaw_rad) { return std::floor(3.0 * bowl(yaw_rad)); };
      const YawMinimum plain = stage->minimise(cost);
      for (const double sign : {1.0, -1.0}) {
        std::vector<double> looked_rad;
        const YawMinimum glanced =
            stage->minimise({[&](double yaw_rad) {
                               looked_rad.push_back(yaw_rad);
                               return cost(yaw_rad);
                             },
                             {},
                             [&](double yaw_rad) { return sign * bowl(yaw_rad); }});
        EXPECT_EQ(glanced.yaw_rad, plain.yaw_rad) << search.json;
        EXPECT_EQ(glanced.cost, plain.cost) << search.json;
        EXPECT_EQ(glanced.evaluations, plain.evaluations) << search.json;
        const double first_away_rad = std::abs(looked_rad.front() - bowl.least_rad);
        if (sign > 0.0) {
          EXPECT_LE(first_away_rad, rad_from_deg(2.6)) << search.json;
        } else {
          EXPECT_GE(first_away_rad, rad_from_deg(80.0)) << search.json;
        }
      }
    }
  }
}

TEST(YawSearch, KeepsTheStartWhereNothingIsLower) {
  for (const Case& search : kCases) {
    const YawMinimum minimum =
        test::stage<YawSearch>(search.json)->minimise([](double) { return 7.0; });
    EXPECT_EQ(minimum.yaw_rad, 0.0) << search.json;
    EXPECT_EQ(minimum.cost, 7.0) << search.json;
  }
}

TEST(YawSearch, BinaryLooksWhereTheAuthorsLook) {
  // Range 50, step 5, 5 levels: 21 yaws, then 10 new ones between the known ones of each later
  // level.
  const auto stage =
      test::stage<YawSearch>(R"({"type": "binary", "range_deg": 50, "step_deg": 5, "levels": 5})");
  std::set<double> yaws_deg;
  const YawMinimum minimum = stage->minimise([&](double yaw_rad) {
    yaws_deg.insert(std::round(deg_from_rad(yaw_rad) * 1e4) * 1e-4);
    return std::abs(yaw_rad - rad_from_deg(12.3));
  });
  EXPECT_EQ(minimum.evaluations, 21 + 4 * 10);
  EXPECT_EQ(*yaws_deg.begin(), -50.0);
  EXPECT_EQ(*yaws_deg.rbegin(), 50.0);
  EXPECT_NEAR(deg_from_rad(minimum.yaw_rad), 12.1875, 1e-9);  // The nearest multiple of 5 / 16.
}

TEST(YawSearch, LooksOnceAtEachYawOfTheFullCircle) {
  const std::vector<int> grid = yaw_grid(180.0, 1.0);
  const std::set<int> yaws(grid.begin(), grid.end());
  EXPECT_EQ(grid.size(), 360U);
  EXPECT_EQ(yaws.size(), 360U);
  EXPECT_EQ(*yaws.begin(), -179);
  EXPECT_EQ(*yaws.rbegin(), 180);
  EXPECT_EQ(yaw_grid(0.3, 0.1).size(), 7U);  // 0.3 / 0.1 is below 3 in floating point.
}

TEST(YawSearch, RefusesAStepThatIsWiderThanTheRange) {
  EXPECT_THROW(test::stage<YawSearch>(R"({"type": "binary", "range_deg": 5, "step_deg": 10})"),
               InputError);
  EXPECT_THROW(test::stage<YawSearch>(
                   R"({"type": "golden_section", "range_deg": 5, "bracket_step_deg": 10})"),
               InputError);
}

}  // namespace
}  // namespace croon
