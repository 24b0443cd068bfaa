#include "experiments/analysis/basin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/report/plots.hpp"
#include "experiments/report/result_list.hpp"
#include "experiments/report/result_sections.hpp"
#include "framework/document/renderers.hpp"
#include "framework/picture/writers.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

const Sweep kSweep{SweepOf::rotation, 0.0, 30.0, 4};

/// 40 trials per level, each in a scene of its own: `base` fails at none, none, 2 and 3 of them,
/// `lost` at all.
std::vector<TrialRecord> records_of(const std::vector<std::string>& sensors) {
  constexpr std::array<int, 4> kFailures = {0, 0, 2, 3};
  std::vector<TrialRecord> records;
  for (const std::string& sensor : sensors) {
    for (int trial = 0; trial < 160; ++trial) {
      const bool is_good = trial / 4 >= kFailures[trial % 4];
      const std::string scene = std::to_string(trial / 4);
      records.push_back(test::finished({"base", scene, sensor, trial},
                                       is_good ? Status::success : Status::inaccurate, {},
                                       Vector6d::Zero()));
      records.push_back(
          test::unfinished({"lost", scene, sensor, trial}, Status::failed, "no ground"));
    }
  }
  return records;
}

TEST(Basin, CountsEveryTrialOfEachLevel) {
  Rng rng = croon::test::test_rng();
  const auto basin = basin_of(test::shuffled(rng, records_of({"left", "right"})), kSweep,
                              {{"base", "lost"}, {"right", "left"}, {}, {}});
  ASSERT_TRUE(basin);
  ASSERT_EQ(basin->rows.size(), 6U);
  EXPECT_EQ(basin->rows[0].sensor, "right");
  EXPECT_EQ(basin->rows[1].sensor, "left");
  const BasinRow& all = basin->rows[2];
  EXPECT_EQ(all.variant, "base");
  EXPECT_EQ(all.sensor, "");
  const std::vector<int> success = {80, 80, 76, 74};
  ASSERT_EQ(all.levels.size(), 4U);
  for (std::size_t level = 0; level < 4; ++level) {
    EXPECT_EQ(all.levels[level].trials, 80);
    EXPECT_EQ(all.levels[level].count, success[level]);
    EXPECT_EQ(basin->rows[0].levels[level].count, success[level] / 2);
    EXPECT_EQ(basin->rows[5].levels[level].trials, 80);
    EXPECT_EQ(basin->rows[5].levels[level].count, 0);
  }
}

TEST(Basin, EndsBeforeTheFirstLevelBelow95Percent) {
  const auto basin = basin_of(records_of({"left"}), kSweep, {});
  ASSERT_TRUE(basin);
  EXPECT_EQ(basin_radius(kSweep, basin->rows[0]), 20.0);
  EXPECT_EQ(basin_radius(kSweep, basin->rows[2]), std::nullopt);
  BasinRow gap = basin->rows[0];
  gap.levels[1].count = 37;
  EXPECT_EQ(basin_radius(kSweep, gap), 0.0);
}

TEST(Basin, HasAnIntervalOfTheRadiusFromThoseOfTheShares) {
  const auto basin = basin_of(records_of({"left"}), kSweep, {});
  ASSERT_TRUE(basin);
  // Of 40 scenes all succeed at the first two levels: the lower ends are 91 %.
  const auto interval = basin_radius_interval(kSweep, basin->rows[0]);
  ASSERT_TRUE(interval);
  EXPECT_EQ(interval->low, 0.0);
  EXPECT_EQ(interval->high, 30.0);
  EXPECT_FALSE(basin_radius_interval(kSweep, basin->rows[2]));
  BasinRow few = basin->rows[0];
  for (Share& share : few.levels) share.interval.reset();
  EXPECT_TRUE(basin_radius(kSweep, few));
  EXPECT_FALSE(basin_radius_interval(kSweep, few));
  // More scenes of the same kind make it shorter.
  BasinRow many = basin->rows[0];
  for (Share& share : many.levels) share.interval = wilson_interval(share.ratio, 4000.0);
  const auto shorter = basin_radius_interval(kSweep, many);
  ASSERT_TRUE(shorter);
  EXPECT_EQ(shorter->low, 10.0);
  EXPECT_EQ(shorter->high, 20.0);
}

/// A world in which each scene has a size of its own, `centre` +- `scatter`, beyond which all
/// starts fail; a share `hopeless` of the scenes fails from every start.
struct World {
  double hopeless, centre, scatter;

  /// The share of scenes that succeed at a size.
  double success(double size) const {
    return (1.0 - hopeless) * std::clamp((centre + scatter - size) / (2.0 * scatter), 0.0, 1.0);
  }
};

Share share_at(const std::vector<double>& reaches, double size) {
  SceneCounts counts;
  for (std::size_t scene = 0; scene < reaches.size(); ++scene) {
    counts.add(std::to_string(scene), reaches[scene] > size ? 3 : 0, 3);
  }
  return counts.share();
}

TEST(Basin, TheIntervalOfTheRadiusHoldsTheTrueOne) {
  constexpr int kExperiments = 300;
  const Sweep sweep{SweepOf::rotation, 0.0, 90.0, 10};
  Rng rng = croon::test::test_rng();
  for (const World& world : {World{0.0, 55.0, 1.0}, World{0.0, 50.0, 40.0}, World{0.3, 55.0, 20.0},
                             World{0.1, 95.0, 2.0}}) {
    BasinRow truth;
    for (int level = 0; level < sweep.levels; ++level) {
      const double success = world.success(level_size(sweep, level));
      truth.levels.push_back({static_cast<int>(1e6 * success), 1000000, success, {}});
    }
    const double radius = *basin_radius(sweep, truth);
    for (const int scenes : {kMinScenes, 12, 40}) {
      int held = 0;
      for (int i = 0; i < kExperiments; ++i) {
        std::vector<double> reaches;
        for (int scene = 0; scene < scenes; ++scene) {
          const double reach = world.centre + world.scatter * (2.0 * rng.uniform() - 1.0);
          reaches.push_back(rng.uniform() < world.hopeless ? -1.0 : reach);
        }
        BasinRow row;
        for (int level = 0; level < sweep.levels; ++level) {
          row.levels.push_back(share_at(reaches, level_size(sweep, level)));
        }
        const auto interval = basin_radius_interval(sweep, row);
        held += interval && interval->low <= radius && radius <= interval->high;
      }
      EXPECT_GE(held, 0.93 * kExperiments)
          << world.hopeless << " " << world.scatter << ": " << scenes;
    }
  }
}

TEST(Basin, HasARadiusThoughOneSceneAlwaysFails) {
  std::vector<TrialRecord> records = records_of({"left"});
  for (int trial = 0; trial < 160; ++trial) {
    for (const char* variant : {"base", "lost"}) {
      records.push_back(test::unfinished({variant, "narrow", "left", trial}, Status::failed, "no"));
    }
  }
  const auto basin = basin_of(records, kSweep, {});
  ASSERT_TRUE(basin);
  EXPECT_EQ(basin->rows[0].levels[0].count, 40);
  EXPECT_EQ(basin->rows[0].levels[0].trials, 80);
  EXPECT_EQ(basin_radius(kSweep, basin->rows[0]), 20.0);
  EXPECT_EQ(basin_radius(kSweep, basin->rows[2]), std::nullopt);
}

TEST(Basin, LeavesOutSensorsWithoutTruth) {
  std::vector<TrialRecord> records = records_of({"left"});
  records.push_back(test::finished_without_truth({"base", "a", "right", 0}, {}));
  const auto basin = basin_of(records, kSweep, {});
  ASSERT_TRUE(basin);
  for (const BasinRow& row : basin->rows) EXPECT_NE(row.sensor, "right");
  EXPECT_EQ(basin->rows[1].levels[0].trials, 40);
  EXPECT_FALSE(basin_of({records.back()}, kSweep, {}));
  EXPECT_FALSE(basin_of({}, kSweep, {}));
}

TEST(Basin, IsTheseBytes) {
  Results results;
  results.basin = basin_of(records_of({"left"}), kSweep, {});
  const std::string csv = result_file("basin.csv", results);
  EXPECT_EQ(csv.substr(0, csv.find("base,left,1")),
            "variant,sensor,level,size,unit,trials,success,success_ratio,low,high\n"
            "base,left,0,0,deg,40,40,1,0.9123783988027134,1\n");
  EXPECT_NE(csv.find("\nlost,all,3,30,deg,40,0,0,0,"), std::string::npos);
}

TEST(Basin, IsATable) {
  Results results;
  results.basin = basin_of(records_of({"left"}), kSweep, {});
  const std::string table = text_section(basin_section(results));
  EXPECT_NE(table.find("each level has at least 95 %"), std::string::npos);
  EXPECT_NE(table.find("variant    0   10  20  30  radius deg  95 % interval"), std::string::npos)
      << table;
  EXPECT_NE(table.find("base     100  100  95  92          20        [0, 30]"), std::string::npos)
      << table;
  EXPECT_NE(table.find("lost       0    0   0   0           -              -"), std::string::npos)
      << table;
}

TEST(Basin, IsAPictureOfEveryVariant) {
  const Drawing drawing = basin_chart(*basin_of(records_of({"left"}), kSweep, {}));
  EXPECT_THAT(test::unreadable_parts(drawing), testing::IsEmpty());
  const std::string svg = svg_bytes(drawing);
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  EXPECT_NE(svg.find(">base</text>"), std::string::npos);
  EXPECT_NE(svg.find(">lost</text>"), std::string::npos);
  const auto is_band = [](const Drawing::Element& element) {
    return std::holds_alternative<Drawing::Area>(element);
  };
  const auto& elements = drawing.elements();
  EXPECT_EQ(std::count_if(elements.begin(), elements.end(), is_band), 2);
}

}  // namespace
}  // namespace croon::experiments
