// croon calibrate as users call it, and the mistakes that they make.
#include <gtest/gtest.h>

#include <filesystem>

#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/pcd_file.hpp"
#include "test/program/program.hpp"
#include "test/support/one_point_pcd.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// What a user types behind "croon calibrate", and a part of the answer. "{}" is the folder of the
/// test.
struct Mistake {
  const char* arguments;
  const char* answer;
};

constexpr Mistake kMistakes[] = {
    // Inputs that are missing, or do not fit each other.
    {"", "INPUT is required"},
    {"{}/none.pcd {}/left.pcd", "none.pcd: expected a cloud, a folder or a recording"},
    {"{}/top.pcd {}/lfet.pcd", "did you mean"},
    {"{}/top.pcd", "expected clouds of at least two sensors, found one"},
    {"{}/top.pcd {}/top.pcd", "found the path of"},
    {"a={}/top.pcd a={}/left.pcd", "found two named \"a\"; name them: NAME=PATH"},
    {"={}/top.pcd {}/left.pcd", "a sensor with a name"},
    {"-x={}/top.pcd {}/left.pcd", "unknown option"},
    {"{}/top.pcd {}/scans", "expected a folder, as for other sensors, found a file"},
    {"{}/scans", "found 1 such folder"},
    {"{}/empty", "expected a folder with a folder of clouds for each sensor"},
    {"{}/flat", "name a file for each sensor"},
    {"{}/scans/top {}/empty", "expected files with point clouds, found none"},
    {"{}/scans/top {}/other", "other"},
    {"\"\" {}/left.pcd", "expected a path, found \"\""},
    // Files that are no clouds.
    {"{}/top.pcd {}/photo.png", "photo.png"},
    {"{}/top.pcd {}/notes.docx", "notes.docx"},
    {"{}/top.pcd {}/empty.pcd", "empty.pcd"},
    {"{}/top.pcd {}/text.pcd", "text.pcd"},
    {"{}/top.pcd {}/short.pcd", "short.pcd"},
    {"{}/top.pcd {}/flat.pcd", "flat.pcd"},
    {"{}/top.pcd {}/nan.pcd", "it has no points"},
    {"{}/drive.bag", "drive.bag"},
    {"{}/broken.mcap", "broken.mcap"},
    {"{}/broken.db3", "broken.db3"},
    {"{}/top.pcd {}/broken.mcap", "expected a recording as the first input"},
    // Options.
    {"{}/top.pcd {}/left.pcd --refrence top", "did you mean \"--reference\"?"},
    {"{}/top.pcd {}/left.pcd --reference tpo", "did you mean \"top\"?"},
    {"{}/top.pcd {}/left.pcd --reference \"\"", "expected a sensor, found \"\""},
    {"{}/top.pcd {}/left.pcd --pipeline bst", "did you mean \"best\"?"},
    {"{}/top.pcd {}/left.pcd --pipeline {}/none.json", "none.json"},
    {"{}/top.pcd {}/left.pcd --pipeline {}/text.pcd", "text.pcd"},
    {"{}/top.pcd {}/left.pcd --pipeline {}/typo_pipeline.json", "did you mean \"verdict\"?"},
    {"{}/top.pcd {}/left.pcd --pipeline {}/no_pipeline.json", "no_pipeline.json"},
    {"{}/top.pcd {}/left.pcd --nominal {}/none.json", "none.json"},
    {"{}/top.pcd {}/left.pcd --nominal {}/text.pcd", "text.pcd"},
    {"{}/top.pcd {}/left.pcd --nominal {}/others.json", "expected a pose of \"left\", found none"},
    {"{}/top.pcd {}/left.pcd --nominal-std-deg 2", "expected nominal poses"},
    {"{}/top.pcd {}/left.pcd --nominal-std-m nan", "expected a number, found \"nan\""},
    {"{}/top.pcd {}/left.pcd --nominal {}/skewed.txt", "skewed.txt"},
    {"{}/top.pcd {}/left.pcd --base 1,2,3,4,5", "expected a file or six numbers"},
    {"{}/top.pcd {}/left.pcd --base 1,2,3,4,5,x", "expected a file or six numbers"},
    {"{}/top.pcd {}/left.pcd --base {}/others.json", "expected the pose of the reference \"top\""},
    {"{}/top.pcd {}/left.pcd --base {}/none.json", "none.json"},
    {"{}/top.pcd {}/left.pcd --format ros", "did you mean \"ros2\"?"},
    {"{}/top.pcd {}/left.pcd --format urdf,kity", "did you mean \"kitti\"?"},
    {"{}/top.pcd {}/left.pcd --max-time-gap -1", "--max-time-gap"},
    {"{}/top.pcd {}/left.pcd --max-time-gap soon", "--max-time-gap"},
    {"{}/top.pcd {}/left.pcd --max-scenes 0", "--max-scenes"},
    {"{}/top.pcd {}/left.pcd --jobs 0", "--jobs"},
    {"{}/top.pcd {}/left.pcd --seed -1", "--seed"},
    {"{}/top.pcd {}/left.pcd --out {}/top.pcd", "expected a folder to write to"},
    {"{}/top.pcd {}/left.pcd --out {}/scans", "found one with other files"},
    // A rig.json.
    {"{}/experiment.json", "found an experiment; run it with croon run"},
    {"{}/typo.json", "did you mean \"reference\"?"},
    {"{}/no_inputs.json", "inputs"},
    {"{}/word.json", "/inputs"},
    {"{}/broken.json", "broken.json"},
    {"{}/good.json {}/top.pcd", "without further inputs"},
    {"{}/lost.json", "lost.pcd"},
    {"{}/none.json", "none.json"},
};

class CalibrateCommand : public testing::Test {
 protected:
  CalibrateCommand() {
    for (const char* const name :
         {"top.pcd", "left.pcd", "flat/a.pcd", "flat/b.pcd", "scans/top/1.pcd", "scans/top/2.pcd",
          "other/3.pcd", "other/4.pcd", "drive.bag"}) {
      folder_.write(name, test::one_point_pcd(++points_));
    }
    fs::create_directories(folder_.path() / "empty");
    for (const char* const name :
         {"photo.png", "notes.docx", "text.pcd", "broken.mcap", "broken.db3", "broken.json"}) {
      folder_.write(name, "This is not what it should be.\n");
    }
    folder_.write("empty.pcd", "");
    folder_.write("short.pcd",
                  "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 9\nDATA binary\nxxxxxxxx");
    folder_.write("flat.pcd", "FIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 1\nDATA ascii\n1 2\n");
    folder_.write("nan.pcd",
                  "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA ascii\nnan nan nan\n");
    folder_.write("typo_pipeline.json", R"([{"step": "verdikt"}])");
    folder_.write("no_pipeline.json", R"({"extends": "best.json"})");
    folder_.write("others.json",
                  R"({"camera": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 1]}})");
    folder_.write("skewed.txt", "1 0 0 0\n0 2 0 0\n0 0 1 0\n0 0 0 1\n");
    folder_.write("experiment.json", R"({"name": "x", "dataset": {}, "pipeline": []})");
    folder_.write("typo.json", R"({"inputs": ["top.pcd", "left.pcd"], "refrence": "top"})");
    folder_.write("no_inputs.json", R"({"reference": "top"})");
    folder_.write("word.json", R"({"inputs": "top.pcd"})");
    folder_.write("good.json", R"({"inputs": ["top.pcd", "left.pcd"]})");
    folder_.write("lost.json", R"({"inputs": ["top.pcd", "lost.pcd"]})");
  }

  std::string with_folder(std::string arguments) const {
    for (auto at = arguments.find("{}"); at != std::string::npos; at = arguments.find("{}")) {
      arguments.replace(at, 2, folder_.path().string());
    }
    return arguments;
  }

  test::TempFolder folder_;
  int points_ = 0;
};

TEST_F(CalibrateCommand, AnswersEachMistakeInOneLineAndWritesNothing) {
  for (const Mistake& mistake : kMistakes) {
    const bool has_out = std::string(mistake.arguments).find("--out") != std::string::npos;
    const std::string out = has_out ? "" : " --out {}/results/x";
    const Answer answer =
        croon(with_folder("calibrate --quiet " + std::string(mistake.arguments) + out));
    EXPECT_EQ(answer.code, 2) << mistake.arguments << "\n" << answer.text;
    EXPECT_NE(answer.text.find(mistake.answer), std::string::npos) << mistake.arguments << "\n"
                                                                   << answer.text;
    EXPECT_EQ(answer.text.substr(0, 7), "croon: ") << answer.text;
    EXPECT_EQ(answer.text.find("bug"), std::string::npos) << answer.text;
    EXPECT_FALSE(fs::exists(folder_.path() / "results")) << mistake.arguments;
  }
}

TEST_F(CalibrateCommand, WritesExtrinsicsAndWhatRepeatsThem) {
  Rng rng = test::test_rng();
  const RigidTransform T_top_street = {Eigen::Matrix3d::Identity(), {0.0, 0.0, -2.0}};
  const RigidTransform T_top_left = {rotation_from_rpy({0.1, 0.0, 1.2}), {0.5, 0.6, -0.2}};
  const test::StreetPair pair =
      test::street_pair(rng, 1, T_top_left, 12000, 9000, 0.01, T_top_street);
  fs::create_directories(folder_.path() / "street");
  write_pcd(folder_.path() / "street/top.pcd", pair.target);
  write_pcd(folder_.path() / "street/left.pcd", pair.source);
  const Answer answer =
      croon(with_folder("calibrate {}/street/top.pcd left={}/street/left.pcd --out {}/out "
                        "--base 1,0,2,0,0,0 --format urdf"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find("ACCEPTED  left"), std::string::npos) << answer.text;
  for (const char* const name : {"extrinsics.csv", "extrinsics.json", "rig.json", "left.png",
                                 "rig.png", "report.html", "base_link/extrinsics.csv"}) {
    EXPECT_TRUE(fs::exists(folder_.path() / "out" / name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "out.croon-part"));
  const Answer again =
      croon(with_folder("calibrate {}/out/rig.json --out {}/again --quiet --no-pictures"));
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_FALSE(fs::exists(folder_.path() / "again/report.html"));
  EXPECT_FALSE(fs::exists(folder_.path() / "again/left.png"));
  EXPECT_EQ(read_whole_file(folder_.path() / "again/extrinsics.csv"),
            read_whole_file(folder_.path() / "out/extrinsics.csv"));
}

}  // namespace
}  // namespace croon::experiments
