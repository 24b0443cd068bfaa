// Names and keys that harm a terminal, a spreadsheet or a figure; and requests that no memory
// holds.
#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/cli/commands.hpp"
#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

const std::string kCloud =
    "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 3\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n";

class OddInput : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Writes a scene of the name with a sensor of the name.
  void write_scene(const std::string& scene, const std::string& sensor) const {
    folder_.write("data/rig/" + scene + "/top.pcd", kCloud);
    folder_.write("data/rig/" + scene + "/other.pcd", kCloud);
    folder_.write(
        "data/rig/" + scene + "/lidar_cloud_path.txt",
        "device_id: 0\npath: top.pcd\ndevice_id: 1\npath: other.pcd\nsensor: " + sensor + "\n");
    folder_.write("data/rig/nominal.json",
                  R"({"left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}})");
  }

  /// Writes an experiment on it with `keys`.
  std::string experiment(
      const std::string& keys,
      const std::string& dataset = R"({"type": "opencalib", "path": "rig"})") const {
    folder_.write("x.json", R"({"name": "x", "dataset": )" + dataset +
                                R"(, "pipeline": [{"step": "identity"}], )" + keys + "}");
    return path("x.json");
  }

  /// The answer of a run that is refused with one line.
  std::string refusal(const std::string& keys, const std::string& options = "") const {
    const Answer answer = croon("run \"" + experiment(keys) + "\" --data " + path("data") +
                                " --quiet --out " + path("out") + " " + options);
    EXPECT_EQ(answer.code, 2) << answer.text;
    EXPECT_EQ(answer.text.find('\n'), answer.text.size() - 1) << answer.text;
    EXPECT_FALSE(std::filesystem::exists(path("out")));
    return answer.text;
  }

  test::TempFolder folder_;
};

constexpr const char* kNominal = R"("starts": {"around": "nominal", "trials": 1})";

TEST_F(OddInput, AVariantIsNoFormula) {
  for (const char* name : {"=1+1", "+1", "-1", "@a", "\\ta"}) {
    const Answer answer =
        croon("validate " + experiment(R"("variants": [{"name": ")" + std::string(name) + "\"}]"));
    EXPECT_EQ(answer.code, 2) << name;
    EXPECT_NE(answer.text.find("/variants/0/name: expected a name of letters"), std::string::npos)
        << answer.text;
  }
}

TEST_F(OddInput, ASensorIsNoFormula) {
  for (const char* name : {"=1+1", "+1", "-1", "@a", "a\tb",
                           "le\xe2\x80\xae"
                           "ft",
                           "\xef\xbb\xbf"
                           "left"}) {
    write_scene("s1", name);
    EXPECT_NE(refusal(kNominal).find("other.pcd: expected a sensor with a name in UTF-8"),
              std::string::npos)
        << name;
  }
}

TEST_F(OddInput, AScenesNameIsPrintable) {
  for (const std::string name : {"a\nb", "a\xff", "a\x1b[31m", "=s"}) {
    const test::TempFolder folder;
    std::filesystem::remove_all(path("data"));
    write_scene(name, "left");
    const std::string text = refusal(kNominal);
    EXPECT_NE(text.find("expected a scene with a name in UTF-8"), std::string::npos) << text;
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_EQ(text.find('\xff'), std::string::npos);
  }
  write_scene("ok", "left");
}

TEST_F(OddInput, ASensorIsNotCalledAllSensors) {
  write_scene("s1", "all");
  EXPECT_NE(refusal(kNominal).find("x.json: /dataset: expected a sensor name other than "
                                   "\"all\""),
            std::string::npos);
}

TEST_F(OddInput, ASensorIsNotCalledAPairOfSensors) {
  for (const char* sensor : {"top", "a", "b", "b>a"}) {
    folder_.write(std::string("data/car/") + sensor + "/s1.pcd", kCloud);
  }
  const std::string run =
      experiment(R"("loops": true, "starts": {"trials": 1})",
                 R"({"type": "sensor_folders", "path": "car", "reference": "top"})");
  const Answer answer = croon("run " + run + " --data " + path("data") + " --out " + path("out"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text.find("croon: " + run + ": /loops: expected sensors without \">\""), 0U)
      << answer.text;
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(OddInput, AFolderOfASensorIsNamedAtItsPointer) {
  folder_.write("data/car/top/s1.pcd", kCloud);
  folder_.write("data/car/left/s1.pcd", kCloud);
  const auto refused = [&](const std::string& keys) {
    const Answer answer =
        croon("run " +
              experiment(kNominal, R"({"type": "sensor_folders", "path": "car", )" + keys + "}") +
              " --data " + path("data") + " --out " + path("out"));
    EXPECT_EQ(answer.code, 2) << answer.text;
    EXPECT_FALSE(std::filesystem::exists(path("out")));
    return answer.text;
  };
  EXPECT_NE(
      refused(R"("reference": "tpo")").find("x.json: /dataset/reference: expected the folder"),
      std::string::npos);
  EXPECT_NE(refused(R"("reference": "top", "sensors": ["lfet"])")
                .find("car/lfet; did you mean \"left\"?"),
            std::string::npos);
  EXPECT_NE(refused(R"("reference": "top", "sensors": ["left", "left"])")
                .find("x.json: /dataset/sensors/1: expected each name once"),
            std::string::npos);
}

TEST_F(OddInput, AFarPoseIsRefusedBeforeItIsStored) {
  write_scene("s1", "left");
  const std::string far =
      R"({"left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [1e16, 0, 0]}})";
  folder_.write("data/rig/truth.json", far);
  EXPECT_NE(refusal(kNominal).find("truth.json: /left/translation_m/0: expected a number "
                                   "from -1000000 to 1000000 m, found 1e+16"),
            std::string::npos);
  std::filesystem::remove(path("data/rig/truth.json"));
  folder_.write("data/poses.csv",
                "scene,sensor,tx_m,ty_m,tz_m,qx,qy,qz,qw\ns1,left,1e16,0,0,0,0,0,1\n");
  EXPECT_NE(
      refusal(std::string(kNominal) + R"(, "variants": [{"name": "other", "poses": "poses.csv"}])")
          .find("poses.csv: line 2: expected a number from -1000000 to 1000000 m"),
      std::string::npos);
}

TEST_F(OddInput, ManyFaultsAreCounted) {
  std::string steps;
  for (int i = 0; i < 300; ++i) steps += std::string(i == 0 ? "" : ",") + R"({"step": "none"})";
  folder_.write("many.json",
                R"({"name": "x", "dataset": {"type": "simulated"}, "pipeline": [)" + steps + "]}");
  const Answer answer = croon("validate " + path("many.json"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 11) << answer.text;
  EXPECT_NE(answer.text.find("\ncroon: and 589 more faults"), std::string::npos) << answer.text;
}

TEST_F(OddInput, EmbreeWithoutMemoryIsNoBug) {
  experiment(R"("starts": {"trials": 1})", R"({"type": "simulated", "scenes": 1})");
  const Answer answer =
      croon("validate " + path("x.json") + " >/dev/null; ulimit -v 180000; \"" + CROON_BINARY_DIR +
            "/bin/croon\" run " + path("x.json") + " --quiet --jobs 1 --out " + path("out"));
  EXPECT_EQ(answer.code, 1);
  EXPECT_NE(answer.text.find("croon: Embree does not start: "), std::string::npos) << answer.text;
}

TEST_F(OddInput, FilesAreNamedWithoutEscapes) {
  folder_.write("a\x1b[31m.json", "{");
  folder_.write(
      "b\x1b[31m.json",
      R"({"name": "x", "dataset": {"type": "simulated"}, "pipeline": [{"step": "identity"}]})");
  const Answer answer = croon("validate \"" + folder_.path().string() + "\"");
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("b?[31m.json: ok"), std::string::npos) << answer.text;
  EXPECT_EQ(answer.text.find('\x1b'), std::string::npos);
}

TEST_F(OddInput, ALongKeyIsCut) {
  const Answer answer = croon("validate " + experiment("\"" + std::string(1000000, 'k') + "\": 1"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_LT(answer.text.size(), 5000U);
}

TEST_F(OddInput, ASimulationGoesOnAfterAKillAtItsRecipe) {
  experiment(R"("starts": {"trials": 1})", R"({"type": "simulated", "scenes": 1})");
  folder_.write("sim/simulation.json.croon-part0", "{\"data");
  const Answer answer = croon("simulate " + path("x.json") + " --quiet --out " + path("sim"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_FALSE(std::filesystem::exists(path("sim/simulation.json.croon-part0")));
}

TEST_F(OddInput, APlanIsEstimatedBeforeItIsMade) {
  experiment(R"("starts": {"trials": 1000000})", R"({"type": "simulated", "scenes": 10000})");
  const Answer answer = croon("run " + path("x.json") + " --plan --out " + path("out"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("a plan of 40000000000 trials takes about "), std::string::npos)
      << answer.text;
  EXPECT_NE(answer.text.find("or run it in parts with --shard"), std::string::npos) << answer.text;
}

TEST_F(OddInput, ASensorsRaysAreEstimatedBeforeTheyAreCast) {
  std::string rings;
  for (int i = 0; i < 1000; ++i) rings += (i == 0 ? "" : ",") + std::to_string(-20.0 + 0.04 * i);
  std::string sensors = R"("top": {})";
  for (int i = 0; i < 100; ++i) {
    sensors += ", \"s" + std::to_string(i) + R"(": {"model": {"elevations_deg": [)" + rings +
               R"(], "azimuth_step_deg": 0.01}})";
  }
  experiment(R"("starts": {"trials": 1})",
             R"({"type": "simulated", "scenes": 1, "rig": {"sensors": {)" + sensors + "}}}");
  const Answer answer = croon("run " + path("x.json") + " --plan --out " + path("out"));
  EXPECT_EQ(answer.code, 2) << answer.text;
  EXPECT_NE(answer.text.find("x.json: /dataset/rig: a scene of "), std::string::npos)
      << answer.text;
  EXPECT_NE(answer.text.find(" rays takes about "), std::string::npos) << answer.text;
}

TEST_F(OddInput, ACloudIsEstimatedBeforeItIsRead) {
  write_scene("s1", "left");
  std::filesystem::remove(path("data/rig/s1/other.pcd"));
  folder_.write("data/rig/s1/other.bin", "");
  std::filesystem::resize_file(path("data/rig/s1/other.bin"), std::uintmax_t{1} << 40);
  folder_.write("data/rig/s1/lidar_cloud_path.txt",
                "device_id: 0\npath: top.pcd\ndevice_id: 1\npath: other.bin\nsensor: left\n");
  const std::string text = refusal(kNominal);
  EXPECT_NE(text.find("other.bin: to read this file takes about 2473.9 GB of memory"),
            std::string::npos)
      << text;
}

TEST_F(OddInput, AFarPointIsDescribedInOneLine) {
  write_scene("s1", "left");
  folder_.write("data/rig/s1/other.pcd",
                "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA ascii\n1e32 0 0\n");
  const Answer answer = croon("describe " + experiment(kNominal) + " --data " + path("data"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("other.pcd: a point at (1e+32, 0, 0) m is outside the grid"),
            std::string::npos)
      << answer.text;
}

TEST_F(OddInput, ManyJobsUnderLittleMemoryAreFewer) {
  write_scene("s1", "left");
  const std::string run = "run " + experiment(kNominal) + " --data " + path("data") +
                          " --quiet --jobs 1024 --out " + path("out");
  for (const char* kilobytes : {"1000000", "3000000"}) {
    const Answer answer =
        croon("validate " + path("x.json") + " >/dev/null; ulimit -v " + kilobytes + "; \"" +
              CROON_BINARY_DIR + "/bin/croon\" " + run + " --fresh");
    EXPECT_EQ(answer.code, 0) << answer.text;
  }
}

TEST_F(OddInput, AGridOfManyStagesIsReadInLinearTime) {
  std::string stages;
  for (int i = 1; i <= 4000; ++i) {
    stages += std::string(i == 1 ? "" : ",") + R"({"type": "icpn", "max_iterations": )" +
              std::to_string(i % 1000 + 1) + R"(, "kernel_width_m": )" + std::to_string(i) + "}";
  }
  folder_.write("grid.json", R"({"name": "x", "dataset": {"type": "simulated"},
                "pipeline": [{"step": "registration"}], "grid": {"registration.icp": [)" +
                                 stages + "]}}");
  // With the cube, as once, it takes more than an hour, and the test its time limit.
  const Answer answer = croon("validate " + path("grid.json"));
  EXPECT_EQ(answer.code, 0) << answer.text.substr(0, 1000);
}

}  // namespace
}  // namespace croon::experiments
