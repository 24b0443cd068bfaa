#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kTwoDatasets = R"({"name": "two",
    "dataset": {"type": "simulated", "scenes": 2, "mix": {"empty": 1}},
    "pipeline": [{"step": "identity"}]})";

TEST(DescribeCommand, TellsOfEveryCloudTheSameForAnyNumberOfThreads) {
  const test::TempFolder folder;
  const std::string file = folder.write("x.json", kTwoDatasets).string();
  const std::string one = (folder.path() / "one").string();
  const std::string two = (folder.path() / "two").string();
  const Answer answer = croon("describe " + file + " --jobs 1 --out " + one);
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_EQ(croon("describe " + file + " --jobs 2 --out " + two).text, answer.text);
  const std::string csv = read_whole_file(one + "/clouds.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 5);
  EXPECT_NE(csv.find("two,000001,empty,left,"), std::string::npos);
  EXPECT_EQ(csv, read_whole_file(two + "/clouds.csv"));
  EXPECT_EQ(read_whole_file(one + "/ranges.svg"), read_whole_file(two + "/ranges.svg"));
  const std::string first = csv.substr(0, csv.find("two,000001"));
  const std::string three = (folder.path() / "three").string();
  EXPECT_EQ(croon("describe " + file + " --scenes 1 --out " + three).code, 0);
  EXPECT_EQ(read_whole_file(three + "/clouds.csv"), first);
}

TEST(DescribeCommand, LeavesNoFolderBehindIfACloudIsDamaged) {
  const test::TempFolder folder;
  const std::string header =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n";
  folder.write("data/top/1.pcd", header + "1 2 3\n");
  folder.write("data/left/1.pcd", header + "4 x 6\n");
  const std::string file = folder
                               .write("x.json", R"({"name": "x", "dataset":
      {"type": "sensor_folders", "path": ".", "reference": "top"}, "pipeline": [{"step": "identity"}]})")
                               .string();
  const std::string out = (folder.path() / "new").string();
  const Answer answer = croon("describe " + file + " --data " + (folder.path() / "data").string() +
                              " --out " + out + "/inner");
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("left/1.pcd"), std::string::npos) << answer.text;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(DescribeCommand, ReplacesWhatItWroteAndNoLink) {
  const test::TempFolder folder;
  const std::string file = folder.write("x.json", kTwoDatasets).string();
  const std::string command = "describe " + file + " --scenes 1 --out " + folder.path().string();
  EXPECT_EQ(croon(command).code, 0);
  const std::string clouds = read_whole_file(folder.path() / "clouds.csv");
  folder.write("clouds.csv", "an earlier one");
  EXPECT_EQ(croon(command).code, 0);
  EXPECT_EQ(read_whole_file(folder.path() / "clouds.csv"), clouds);
  for (const char* name : {"clouds.csv", "ranges.svg"}) {
    std::filesystem::remove(folder.path() / "clouds.csv");
    std::filesystem::remove(folder.path() / "ranges.svg");
    std::filesystem::create_symlink("x.json", folder.path() / name);
    const Answer answer = croon(command);
    EXPECT_EQ(answer.code, 2);
    EXPECT_EQ(answer.text.find("croon: --out: expected a file to write, found "), 0U)
        << answer.text;
    EXPECT_EQ(read_whole_file(file), kTwoDatasets);
    // The other file is not written either.
    std::filesystem::remove(folder.path() / name);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "clouds.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "ranges.svg"));
  }
}

TEST(DescribeCommand, LooksAtItsOutputBeforeTheClouds) {
  const test::TempFolder folder;
  folder.write("x.json", R"({"name": "car", "starts": {"around": "nominal"},
    "dataset": {"type": "sensor_folders", "path": "car", "reference": "top"},
    "pipeline": [{"step": "identity"}]})");
  // A cloud that is found to be damaged when it is read.
  const std::string damaged =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "POINTS 1\nDATA ascii\noops\n";
  for (const char* sensor : {"top", "left"}) {
    folder.write(std::string("data/car/") + sensor + "/1.pcd", damaged);
  }
  folder.write("file", "mine");
  const std::string root = folder.path().string();
  const std::string command = "describe " + root + "/x.json --data " + root + "/data --out " + root;
  EXPECT_NE(croon(command + "/out").text.find("1.pcd: "), std::string::npos);
  EXPECT_EQ(croon(command + "/file").text.find("croon: " + root + "/file: "), 0U);
  std::filesystem::create_symlink("x.json", folder.path() / "clouds.csv");
  EXPECT_EQ(croon(command).text.find("croon: --out: expected a file to write, found "), 0U);
}

TEST(DescribeCommand, TakesNoExperimentTwice) {
  const test::TempFolder folder;
  const std::string file = folder.write("x.json", kTwoDatasets).string();
  const std::string same = (folder.path() / "." / "x.json").string();
  const Answer answer = croon("describe " + file + " " + same);
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text,
            "croon: " + same + ": expected each experiment once, found this one twice\n");
}

/// A PCD file of the corners of a square on the ground, or of no points.
std::string square_pcd(int points = 4) {
  const std::string count = std::to_string(points);
  return "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
         "\nHEIGHT 1\nPOINTS " + count + "\nDATA ascii\n" +
         (points > 0 ? "5 5 -2\n5 -5 -2\n-5 -5 -2\n-5 5 -2\n" : "");
}

TEST(DescribeCommand, NamesSensorsWithoutPoints) {
  const test::TempFolder folder;
  const std::string file = folder
                               .write("x.json", R"({"name": "car", "starts": {"around": "nominal"},
    "dataset": {"type": "sensor_folders", "path": "car", "reference": "top"},
    "pipeline": [{"step": "identity"}]})")
                               .string();
  folder.write("data/car/top/1.pcd", square_pcd());
  folder.write("data/car/top/2.pcd", square_pcd(0));
  for (const char* scene : {"1", "2"}) {
    folder.write(std::string("data/car/left/") + scene + ".pcd", square_pcd(0));
    folder.write(std::string("data/car/right/") + scene + ".pcd", square_pcd());
  }
  const Answer answer = croon("describe " + file + " --data " + (folder.path() / "data").string());
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find("\nleft of car has no points in scene 1 and 1 more\n"
                             "top of car has no points in scene 2\n"),
            std::string::npos)
      << answer.text;
  EXPECT_NE(answer.text.find("\nright "), std::string::npos) << answer.text;
}

TEST(DescribeCommand, RefusesWhatIsNotThere) {
  const test::TempFolder folder;
  EXPECT_EQ(croon("describe " + (folder.path() / "none.json").string()).code, 2);
  EXPECT_EQ(croon("describe").code, 2);
  const std::string file = folder.write("x.json", kTwoDatasets).string();
  EXPECT_EQ(croon("describe " + file + " --scenes 0").code, 2);
}

}  // namespace
}  // namespace croon::experiments
