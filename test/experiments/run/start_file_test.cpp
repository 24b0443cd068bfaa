#include "experiments/run/starts.hpp"

#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using Lines = std::vector<std::string>;

std::vector<SceneGroup> scenes_of(const std::vector<std::string>& names,
                                  const std::vector<std::string>& sensors) {
  std::vector<SceneGroup> scenes;
  for (const std::string& name : names) {
    scenes.push_back({name, "", {{}}, {}});
    for (const std::string& sensor : sensors) {
      scenes.back().pairs.push_back({{sensor, sensor, "top"}, {}, {}, {}});
    }
  }
  return scenes;
}

std::string file_of(const Lines& lines) {
  std::string bytes = std::string(kStartHeader) + "\n";
  for (const std::string& line : lines) bytes += line + "\n";
  return bytes;
}

StartTable read(const std::string& bytes, const std::vector<SceneGroup>& scenes) {
  const test::TempFolder folder;
  return read_start_file(folder.write("starts.csv", bytes), scenes);
}

/// Faults as "where: message".
Lines start_faults(const std::string& bytes,
                   const std::vector<SceneGroup>& scenes = scenes_of({"a"}, {"left"})) {
  Lines lines;
  try {
    read(bytes, scenes);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) {
      lines.push_back(Fault{"", fault.where, fault.message}.line());
    }
  }
  return lines;
}

TEST(StartFile, IsReadInAnyOrder) {
  const StartTable table =
      read(file_of({"b,left,0,7,8,9,0,0,0,1", "\"a,1\",left,1,4,5,6,0,0,1,0",
                    "\"a,1\",left,0,1,2,3,0.5,-0.5,0.5,0.5", "b,left,1,0,0,0,0,0,0,-1"}),
           scenes_of({"a,1", "b"}, {"left"}));
  EXPECT_EQ(table.trials, 2);
  EXPECT_EQ(table.sha256.size(), 64U);
  const std::vector<Start>& starts = table.starts.at({"a,1", "left"});
  ASSERT_EQ(starts.size(), 2U);
  EXPECT_EQ(starts[0].translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(starts[0].rotation.coeffs(), Eigen::Vector4d(0.5, -0.5, 0.5, 0.5));
  EXPECT_EQ(starts[1].translation, Eigen::Vector3d(4, 5, 6));
}

TEST(StartFile, NeedNotEndItsLastLine) {
  std::string bytes = file_of({"a,left,0,1,2,3,0,0,0,1"});
  bytes.pop_back();
  EXPECT_EQ(read(bytes, scenes_of({"a"}, {"left"})).trials, 1);
}

TEST(StartFile, MayEndItsLinesAsWindowsDoes) {
  const std::string bytes = std::string(kStartHeader) + "\r\na,left,0,1,2,3,0,0,0,1\r\n";
  EXPECT_EQ(read(bytes, scenes_of({"a"}, {"left"})).trials, 1);
}

TEST(StartFile, MayBeginWithAByteOrderMark) {
  EXPECT_EQ(
      read("\xef\xbb\xbf" + file_of({"a,left,0,1,2,3,0,0,0,1"}), scenes_of({"a"}, {"left"})).trials,
      1);
}

TEST(StartFile, ShowsLittleOfALongLine) {
  const Lines faults = start_faults(file_of({std::string(100000, 'x') + ",left,0,1,2,3,0,0,0,1"}));
  EXPECT_LT(faults.at(0).size(), 200U);
}

TEST(StartFile, NormalisesWhatIsNearlyOfUnitLength) {
  const StartTable table =
      read(file_of({"a,left,0,0,0,0,0,0,0.6000003,0.8000004"}), scenes_of({"a"}, {"left"}));
  EXPECT_NEAR(table.starts.at({"a", "left"})[0].rotation.norm(), 1.0, 1e-15);
}

TEST(StartFile, NamesWhatIsWrongWithALine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"a,left,0,1,2,3,0,0,0", "expected 10 fields, found 9"},
      {"a,left,0,1,2,3,0,0,0,1,1", "expected 10 fields, found 11"},
      {"", "expected 10 fields, found 1"},
      {"a,left,x,1,2,3,0,0,0,1", "expected a trial, a whole number from 0 to 999999, found \"x\""},
      {"a,left,1.0,1,2,3,0,0,0,1",
       "expected a trial, a whole number from 0 to 999999, found \"1.0\""},
      {"a,left,-1,1,2,3,0,0,0,1",
       "expected a trial, a whole number from 0 to 999999, found \"-1\""},
      {"a,left,1000000,1,2,3,0,0,0,1",
       "expected a trial, a whole number from 0 to 999999, found \"1000000\""},
      {"a,left,0,1,2,3 m,0,0,0,1", "expected a number, found \"3 m\""},
      {"a,left,0,1,2,,0,0,0,1", "expected a number, found \"\""},
      {"a,left,0,1,2,nan,0,0,0,1", "expected a finite number, found \"nan\""},
      {"a,left,0,1,2,3,0,0,0,inf", "expected a finite number, found \"inf\""},
      {"a,left,0,1,2,-1.1e6,0,0,0,1",
       "expected a number from -1000000 to 1000000 m, found \"-1.1e6\""},
      {"a,left,0,1,2,3,0,0,0,1.00001",
       "expected a quaternion of length 1, found one of length 1.000010"},
      {"a,left,0,1,2,3,0,0,0,0", "expected a quaternion of length 1, found one of length 0.000000"},
      {"aa,left,0,1,2,3,0,0,0,1",
       "expected a scene of the dataset, found \"aa\"; did you mean \"a\"?"},
      {"a,lift,0,1,2,3,0,0,0,1",
       "expected a sensor of scene \"a\", found \"lift\"; did you mean \"left\"?"},
      {"\"a,left,0,1,2,3,0,0,0,1", "expected a second quote, found \"\"a,left,0,1,2,3,0,0,0,1\""}};
  for (const auto& [line, message] : cases) {
    EXPECT_EQ(start_faults(file_of({line})), Lines{"line 2: " + message});
  }
}

TEST(StartFile, WantsItsHeader) {
  EXPECT_EQ(start_faults("a,left,0,1,2,3,0,0,0,1\n"),
            Lines{"line 1: expected \"" + std::string(kStartHeader) +
                  "\", found \"a,left,0,1,2,3,0,0,0,1\""});
  EXPECT_EQ(start_faults("").size(), 1U);
}

TEST(StartFile, WantsEachTrialOnceAndNoneLeftOut) {
  const std::string tail = ",1,2,3,0,0,0,1";
  const std::vector<SceneGroup> scenes = scenes_of({"a", "b"}, {"left"});
  EXPECT_EQ(
      start_faults(file_of({"a,left,0" + tail, "b,left,0" + tail, "a,left,0" + tail}), scenes),
      Lines{"line 4: expected each trial once, found trial 0 of sensor \"left\" in scene "
            "\"a\" again"});
  EXPECT_EQ(
      start_faults(file_of({"a,left,0" + tail, "a,left,2" + tail, "b,left,1" + tail}), scenes),
      (Lines{"expected trials 0 to 2 of sensor \"left\" in scene \"a\", found no trial 1",
             "expected trials 0 to 2 of sensor \"left\" in scene \"b\", found no trial "
             "0"}));
  EXPECT_EQ(start_faults(file_of({}), scenes), Lines{"line 2: expected a start, found the end"});
}

TEST(StartFile, TakesPositionsUpToTheirBound) {
  EXPECT_EQ(read(file_of({"a,left,0,1e6,-1e6,3,0,0,0,1"}), scenes_of({"a"}, {"left"})).trials, 1);
}

TEST(StartFile, CountsFaultsThatAreNotShownInLinearTime) {
  std::vector<std::string> names;
  for (int i = 0; i < 2000; ++i) names.push_back(std::string(100, 's') + std::to_string(i));
  // Names as long as those of the dataset, so that their distance must be counted: for each of the
  // lines that takes many minutes, and the test its time limit.
  const Lines faults =
      start_faults(file_of(Lines(20000, std::string(102, 't') + ",left,0,1,2,3,0,0,0,1")),
                   scenes_of(names, {"left"}));
  ASSERT_EQ(faults.size(), 11U);
  EXPECT_EQ(faults.back(), "and 19990 more faults");
}

TEST(StartFile, ShowsTheFirstFaultsAlone) {
  const Lines faults = start_faults(file_of(Lines(25, "x")));
  ASSERT_EQ(faults.size(), 11U);
  EXPECT_EQ(faults.front(), "line 2: expected 10 fields, found 1");
  EXPECT_EQ(faults.back(), "and 15 more faults");
}

}  // namespace
}  // namespace croon::experiments
