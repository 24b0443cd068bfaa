// Velocities of a file decide results like any parameter, and faults are found before the run.
#include <gtest/gtest.h>

#include "experiments/run/given_velocities.hpp"
#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

class GivenVelocities : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  void write_velocities(const std::string& rows) const {
    folder_.write("v.csv", velocity_header() + "\n" + rows);
  }

  /// Runs known_velocity with the parameters `members` into the folder `out`.
  Answer run(const std::string& members, const std::string& keys = "") const {
    folder_.write("x.json",
                  R"({"name": "x", "dataset": {"type": "simulated", "rig": "croon_three",
                      "scenes": 2, "noise": "real", "speed_mps": 10},
                      "starts": {"rotation_deg": 1, "translation_m": 0.01, "trials": 1}, )" +
                      keys + R"("pipeline": [{"step": "known_velocity", )" + members + "}]}");
    return croon("run " + path("x.json") + " --out " + path("out") + " --quiet");
  }

  test::TempFolder folder_;
};

constexpr const char* kRows = "000000,10,0,0,0,0,0\n000001,10,0,0,0,0,1\n";

TEST_F(GivenVelocities, DecideByTheirBytesWhetherARunGoesOn) {
  write_velocities(kRows);
  EXPECT_EQ(run(R"("file": "v.csv")").code, 0);
  const std::string manifest = read_whole_file(path("out/manifest.json"));
  EXPECT_NE(manifest.find("\"path\": \"v.csv\""), std::string::npos) << manifest;
  const std::string diagnostics = read_whole_file(path("out/diagnostics.csv"));
  EXPECT_NE(diagnostics.find("yaw_rate_degps,1"), std::string::npos) << diagnostics;
  EXPECT_NE(diagnostics.find("vx_mps,10"), std::string::npos) << diagnostics;
  EXPECT_EQ(run(R"("file": "v.csv")").code, 0);
  write_velocities("000000,10,0,0,0,0,0\n000001,11,0,0,0,0,1\n");
  EXPECT_EQ(run(R"("file": "v.csv")").code, 2);
}

TEST_F(GivenVelocities, OfAnotherDigestAreRefused) {
  write_velocities(kRows);
  const std::string zeros(64, '0');
  const Answer answer = run(R"("file": "v.csv", "sha256": ")" + zeros + '"');
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("expected the sha256 " + zeros + ", found "), std::string::npos)
      << answer.text;
}

TEST_F(GivenVelocities, AreBelowTheDataOrTheExperiment) {
  write_velocities(kRows);
  const test::TempFolder elsewhere;
  const std::string outside = elsewhere.write("v.csv", read_whole_file(path("v.csv"))).string();
  const Answer answer = run("\"file\": \"" + outside + '"', "");
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("outside the folder"), std::string::npos) << answer.text;
}

TEST_F(GivenVelocities, OfAllScenesServeGroupsThatLeaveSomeOut) {
  folder_.write("v.csv", velocity_header() + "\n" + kRows + "000002,10,0,0,0,0,0\n");
  folder_.write("x.json",
                R"({"name": "x", "dataset": {"type": "simulated", "rig": "croon_three",
                    "scenes": 3, "noise": "real", "speed_mps": 10}, "scenes_per_trial": 2,
                    "starts": {"rotation_deg": 1, "translation_m": 0.01, "trials": 1},
                    "pipeline": [{"step": "known_velocity", "file": "v.csv"}]})");
  const Answer answer = croon("run " + path("x.json") + " --out " + path("out") + " --quiet");
  EXPECT_EQ(answer.code, 0) << answer.text;
}

TEST_F(GivenVelocities, AreReadStrictly) {
  const auto expect_refusal = [&](const Answer& answer, const std::string& words) {
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.text.find(words), std::string::npos) << answer.text;
    EXPECT_FALSE(std::filesystem::exists(path("out")));
  };
  expect_refusal(run(R"("file": "v.csv")"),
                 "x.json: the step \"known_velocity\": expected a file of velocities, found "
                 "neither ");
  std::filesystem::create_directory(path("v.csv"));
  expect_refusal(run(R"("file": "v.csv")"),
                 "expected a file of velocities, found a folder at " + path("v.csv"));
  std::filesystem::remove(path("v.csv"));
  expect_refusal(run(R"("file": "v.csv")", R"("variants": [{"name": "p", "poses": "p.csv"}], )"),
                 "x.json: /variants/0/poses: expected a file of poses, found neither ");
  expect_refusal(run(R"("file": "v.csv")", R"("variants": [{"name": "p", "poses": "p.csv"}], )"),
                 "expected a file of velocities, found neither ");
  write_velocities("000000,10,0,0,0,0,0\n000002,10,0,0,0,0,1\n");
  expect_refusal(run(R"("file": "v.csv")"),
                 "v.csv: line 3: expected a scene of the dataset, found \"000002\"; did you mean");
  write_velocities(kRows);
  expect_refusal(run(R"("file": "v.csv")", R"("loops": true, )"),
                 "x.json: /pipeline/0: the step \"known_velocity\" cannot be used with \"loops\"");
  expect_refusal(run(R"("file": "v.csv", "linear_mps": [1, 0, 0])"),
                 "no such key together with \"file\"");
  expect_refusal(run(R"("linear_std_mps": 1)"), "must both be 0 or both be positive");
}

}  // namespace
}  // namespace croon::experiments
