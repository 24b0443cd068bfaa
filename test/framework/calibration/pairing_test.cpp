#include "framework/calibration/pairing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/base/rng.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using Clouds = std::vector<std::optional<std::size_t>>;

constexpr auto kNone = std::nullopt;

std::vector<Clouds> clouds_of(const Pairing& pairing) {
  std::vector<Clouds> clouds;
  for (const PairedScene& scene : pairing.scenes) clouds.push_back(scene.clouds);
  return clouds;
}

SensorFiles files_of(const std::string& sensor, const std::vector<std::string>& names) {
  SensorFiles files{sensor, "drive/" + sensor, {}};
  for (const std::string& name : names) files.files.push_back(files.folder / name);
  return files;
}

TEST(PairByTime, TakesTheNearestWithinTheGap) {
  const Pairing pairing = pair_by_time(
      {{"left", {0.01, 0.16, 0.31}}, {"top", {0.0, 0.1, 0.2, 0.3}}, {"right", {0.1}}}, "top", 0.05);
  EXPECT_TRUE(pairing.is_by_time);
  EXPECT_THAT(clouds_of(pairing), ElementsAre(Clouds{0, 0, kNone}, Clouds{kNone, 1, 0},
                                              Clouds{1, 2, kNone}, Clouds{2, 3, kNone}));
  EXPECT_EQ(pairing.scenes[1].name, "0.100000");
  EXPECT_THAT(pairing.unpaired, SizeIs(0));
}

TEST(PairByTime, SaysPerSensorWhatRemained) {
  const Pairing pairing = pair_by_time(
      {{"top", {10.0, 11.0, 12.0}}, {"left", {10.01, 10.02, 12.2, 50.0}}}, "top", 0.05);
  EXPECT_THAT(clouds_of(pairing), ElementsAre(Clouds{0, 0}));
  EXPECT_THAT(
      pairing.unpaired,
      ElementsAre("\"left\": 3 of 4 clouds are not used: 2 without a cloud of \"top\" within "
                  "0.05 s (the nearest is 0.200 s away), 1 because another cloud is nearer",
                  "\"top\": 2 of 3 clouds are not used: no cloud of another sensor within "
                  "0.05 s"));
}

TEST(PairByTime, AcceptsSensorsWithoutClouds) {
  EXPECT_THAT(pair_by_time({{"top", {}}, {"left", {1.0}}}, "top", 1.0).scenes, SizeIs(0));
  const Pairing pairing = pair_by_time({{"top", {1.0}}, {"left", {}}}, "top", 1.0);
  EXPECT_THAT(pairing.scenes, SizeIs(0));
  EXPECT_THAT(pairing.unpaired, SizeIs(1));
}

TEST(PairByTime, UsesEachCloudOnceAndNoneBeyondTheGap) {
  Rng rng = test::test_rng();
  for (int round = 0; round < 50; ++round) {
    std::vector<SensorStamps> sensors = {{"a", {}}, {"b", {}}, {"c", {}}};
    for (SensorStamps& sensor : sensors) {
      for (int i = 0; i < 30; ++i) sensor.stamps_s.push_back(rng.uniform(0.0, 3.0));
      std::sort(sensor.stamps_s.begin(), sensor.stamps_s.end());
    }
    const double gap_s = rng.uniform(0.0, 0.2);
    std::vector<std::set<std::size_t>> used(sensors.size());
    for (const PairedScene& scene : pair_by_time(sensors, "b", gap_s).scenes) {
      ASSERT_TRUE(scene.clouds[1].has_value());
      for (std::size_t s = 0; s < sensors.size(); ++s) {
        if (!scene.clouds[s]) continue;
        EXPECT_TRUE(used[s].insert(*scene.clouds[s]).second);
        const double stamp_s = sensors[s].stamps_s[*scene.clouds[s]];
        EXPECT_LE(std::abs(stamp_s - sensors[1].stamps_s[*scene.clouds[1]]), gap_s);
      }
    }
  }
}

TEST(PairByName, JoinsEqualStems) {
  const Pairing pairing = pair_by_name({files_of("top", {"000.pcd", "001.pcd", "002.pcd"}),
                                        files_of("left", {"001.ply", "002.pcd.bin", "003.ply"})},
                                       "top", 0.05);
  EXPECT_FALSE(pairing.is_by_time);
  EXPECT_THAT(clouds_of(pairing), ElementsAre(Clouds{1, 0}, Clouds{2, 1}));
  EXPECT_EQ(pairing.scenes[0].name, "001");
  EXPECT_THAT(
      pairing.unpaired,
      ElementsAre(
          "\"left\": 1 of 3 clouds is not used: no file of \"top\" has the same name",
          "\"top\": 1 of 3 clouds is not used: no file of another sensor has the same name"));
}

TEST(PairByName, PairsNamesThatAreTimesByTime) {
  // In ns and in s; not in the order of time.
  const Pairing pairing = pair_by_name(
      {files_of("top", {"1700000000100000000.pcd", "1700000000000000000.pcd"}),
       files_of("left", {"1700000000.004.pcd", "1700000000.110.pcd", "1700000009.000.pcd"})},
      "top", 0.05);
  EXPECT_TRUE(pairing.is_by_time);
  EXPECT_THAT(clouds_of(pairing), ElementsAre(Clouds{1, 0}, Clouds{0, 1}));
  EXPECT_EQ(pairing.scenes[0].name, "1700000000000000000");
  EXPECT_THAT(pairing.unpaired, SizeIs(1));
}

TEST(PairByName, TakesSingleFilesAsOneScene) {
  const Pairing pairing =
      pair_by_name({files_of("top", {"a.pcd"}), files_of("left", {"b.pcd"})}, "top", 0.05);
  EXPECT_THAT(clouds_of(pairing), ElementsAre(Clouds{0, 0}));
}

TEST(PairByName, RefusesNamesThatSayNothing) {
  const SensorFiles top = files_of("top", {"top_0.pcd", "top_1.pcd"});
  const auto error_with = [&](const std::vector<std::string>& names) {
    return test::input_error([&] { pair_by_name({top, files_of("left", names)}, "top", 0.05); });
  };
  EXPECT_THAT(error_with({"left_0.pcd", "left_1.pcd"}),
              HasSubstr("drive/left: expected files named like those of \"top\""));
  EXPECT_THAT(error_with({"left_0.pcd", "left_1.pcd"}),
              HasSubstr("found \"left_0.pcd\" beside \"top_0.pcd\"; rename the files"));
  EXPECT_THAT(error_with({}),
              HasSubstr("drive/left: expected files with point clouds, found none"));
  EXPECT_THAT(error_with({"top_0.pcd", "top_0.ply"}),
              HasSubstr("found \"top_0.pcd\" and \"top_0.ply\""));
}

TEST(StampInName, GoesByTheMagnitude) {
  const std::vector<std::string> names = {
      "1700000000",          "1700000000.25",
      "1700000000250",       "1700000000250000",
      "1700000000250000000", "1700000000_250000000",
      "top_1700000000.25",   "n1-2018-07__LIDAR_TOP__1700000000250000"};
  for (const std::string& name : names) {
    const std::optional<double> stamp_s = stamp_in_name(name);
    ASSERT_TRUE(stamp_s.has_value()) << name;
    EXPECT_NEAR(*stamp_s, name == "1700000000" ? 1.7e9 : 1.7e9 + 0.25, 1e-6) << name;
  }
  for (const char* name :
       {"", "000123", "12345", "1e9", "cloud_12", "2018-07-24", "1700000000_25", "17000000000", "a",
        "1700000000.0.1", "1700000000250.5", "nan", "99999999999999999999"}) {
    EXPECT_EQ(stamp_in_name(name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace croon
