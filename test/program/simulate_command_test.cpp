// Scenes that are written run to the same results as those that are made when they are needed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

std::string experiment(int dataset_seed) {
  return R"({"name": "x",
            "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 2, "seed": )" +
         std::to_string(dataset_seed) +
         R"(}, "starts": {"rotation_deg": 10, "trials": 1},
            "pipeline": [{"step": "ground_alignment"}, {"step": "registration"}]})";
}

std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry, folder).string()] = read_whole_file(entry);
  }
  return files;
}

class SimulateCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void run(const std::string& arguments, int code = 0) const {
    const Answer answer = croon(arguments);
    EXPECT_EQ(answer.code, code) << arguments << "\n" << answer.text;
  }

  test::TempFolder folder_;
};

TEST_F(SimulateCommand, WritesADatasetThatRunsToTheSameResults) {
  folder_.write("x.json", experiment(1));
  run("simulate " + path("x.json") + " --out " + path("data") + " --quiet --png --jobs 1");
  EXPECT_TRUE(fs::exists(folder_.path() / "data/000001/top.pcd"));
  EXPECT_TRUE(fs::exists(folder_.path() / "data/000001.png"));
  run("run " + path("x.json") + " --out " + path("made") + " --quiet");
  run("run " + path("data/experiment.json") + " --data " + path("data") + " --out " + path("read") +
      " --quiet");
  for (const char* file :
       {"/trials.csv", "/summary.csv", "/summary.json", "/summary_by_kind.csv"}) {
    EXPECT_EQ(read_whole_file(path("made") + file), read_whole_file(path("read") + file)) << file;
  }
}

TEST_F(SimulateCommand, WritesWhatIsNotWholeAgain) {
  folder_.write("x.json", experiment(1));
  const std::string command = "simulate " + path("x.json") + " --out " + path("data") + " --quiet";
  run(command);
  const auto whole = files_of(folder_.path() / "data");
  const fs::path top = folder_.path() / "data/000000/top.pcd";
  fs::resize_file(top, 1000);
  const fs::path left = folder_.path() / "data/000001/left.pcd";
  fs::rename(left, folder_.path() / "elsewhere.pcd");
  fs::create_symlink(folder_.path() / "elsewhere.pcd", left);
  run(command);
  EXPECT_EQ(files_of(folder_.path() / "data"), whole);
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(left)));
  fs::remove(top);
  ASSERT_EQ(::mkfifo(top.c_str(), 0600), 0);
  run(command, 2);
}

TEST_F(SimulateCommand, IsTheSameForAnyNumberOfThreadsAndGoesOnWhereItStopped) {
  folder_.write("x.json", experiment(1));
  run("simulate " + path("x.json") + " --out " + path("one") + " --quiet --jobs 1");
  run("simulate " + path("x.json") + " --out " + path("four") + " --quiet --jobs 4");
  const auto files = files_of(path("one"));
  EXPECT_EQ(files, files_of(path("four")));
  fs::remove_all(path("one") + "/000001");
  run("simulate " + path("x.json") + " --out " + path("one") + " --quiet");
  EXPECT_EQ(files, files_of(path("one")));
}

TEST_F(SimulateCommand, RefusesAFolderWithSomethingElse) {
  folder_.write("x.json", experiment(1));
  folder_.write("y.json", experiment(2));
  run("simulate " + path("x.json") + " --out " + path("data") + " --quiet");
  const auto files = files_of(path("data"));
  run("simulate " + path("y.json") + " --out " + path("data") + " --quiet", 2);
  EXPECT_EQ(files, files_of(path("data")));
  folder_.write("mine/notes.txt", "mine");
  run("simulate " + path("x.json") + " --out " + path("mine") + " --quiet", 2);
  EXPECT_EQ(files_of(path("mine")).size(), 1U);
}

TEST_F(SimulateCommand, WritesTheVelocitiesAndTheTimesThatDeskewTakes) {
  const auto write = [&](const std::string& name, const std::string& filters) {
    folder_.write(name, R"({"name": "x", "dataset": {"type": "simulated", "scenes": 1,
        "mix": {"highway": 1}, "noise": "real"}, "starts": {"rotation_deg": 2, "trials": 1},
        "pipeline": [{"step": "preprocessing", "reference": )" +
                            filters + R"(}, {"step": "ground_alignment"}]})");
  };
  write("x.json", "[]");
  run("simulate " + path("x.json") + " --out " + path("data") + " --quiet");
  const auto velocities =
      nlohmann::json::parse(read_whole_file(path("data") + "/000000/velocities.json"));
  EXPECT_EQ(velocities.size(), 5U);
  EXPECT_GT(velocities["top"]["linear_mps"][0], 5.0);
  nlohmann::json deskew = velocities["top"];
  deskew["type"] = "deskew";
  write("y.json", "[" + deskew.dump() + "]");
  run("run " + path("y.json") + " --out " + path("made") + " --quiet");
  auto on_files = nlohmann::json::parse(read_whole_file(path("y.json")));
  on_files["dataset"] = {{"type", "opencalib"}, {"path", "."}};
  folder_.write("z.json", on_files.dump());
  run("run " + path("z.json") + " --data " + path("data") + " --out " + path("read") + " --quiet");
  EXPECT_EQ(read_whole_file(path("made") + "/trials.csv"),
            read_whole_file(path("read") + "/trials.csv"));
}

TEST_F(SimulateCommand, WritesTheFileOfVelocitiesThatKnownVelocityTakes) {
  folder_.write("x.json", R"({"name": "x", "dataset": {"type": "simulated", "rig": "croon_three",
      "scenes": 2, "noise": "real", "speed_mps": 12}, "starts": {"rotation_deg": 1, "trials": 1},
      "pipeline": [{"step": "known_velocity", "file": "velocities.csv"}]})");
  run("simulate " + path("x.json") + " --out " + path("data") + " --quiet");
  run("run " + path("data/experiment.json") + " --data " + path("data") + " --out " + path("read") +
      " --quiet");
  const std::string diagnostics = read_whole_file(path("read") + "/diagnostics.csv");
  for (const char* const scene : {"000000", "000001"}) {
    const std::size_t row = diagnostics.find("base," + std::string(scene) + ",left,0");
    ASSERT_NE(row, std::string::npos) << diagnostics;
    const std::size_t number = diagnostics.find("speed_mps,", row) + 10;
    // The lever arm of the reference adds to the speed in a bend.
    EXPECT_NEAR(std::stod(diagnostics.substr(number)), 12.0, 0.1);
  }
}

TEST_F(SimulateCommand, WritesWhatTheExperimentReadsBesideIt) {
  const std::string dataset = R"({"name": "x", "dataset": {"type": "simulated",
      "rig": "croon_three", "scenes": 2, "noise": "real", "speed_mps": 12}, )";
  folder_.write("x.json", dataset + R"("starts": {"rotation_deg": 1, "trials": 2},
      "pipeline": [{"step": "identity"}]})");
  run("simulate " + path("x.json") + " --out " + path("first") + " --quiet");
  folder_.write("given/v.csv", read_whole_file(path("first/velocities.csv")));
  run("starts " + path("x.json") + " --out " + path("s.csv"));
  const std::string sha256 = sha256_of_file(path("s.csv"));
  folder_.write("y.json", dataset + R"("starts": {"file": "s.csv", "trials": 1, "sha256": ")" +
                              sha256 + R"("},
      "pipeline": [{"step": "known_velocity", "file": "given/v.csv"}]})");
  run("simulate " + path("y.json") + " --out " + path("data") + " --quiet");
  run("run " + path("y.json") + " --out " + path("made") + " --quiet");
  run("run " + path("data/experiment.json") + " --data " + path("data") + " --out " + path("read") +
      " --quiet");
  EXPECT_EQ(read_whole_file(path("made/trials.csv")), read_whole_file(path("read/trials.csv")));

  folder_.write("truth.json", read_whole_file(path("first/velocities.csv")));
  for (const std::string& name : {std::string("truth.json"), std::string("./truth.json"),
                                  std::string("given/../truth.json"), path("given/v.csv")}) {
    folder_.write("z.json", dataset + R"("starts": {"rotation_deg": 1, "trials": 1},
      "pipeline": [{"step": "known_velocity", "file": ")" +
                                name + R"("}]})");
    run("simulate " + path("z.json") + " --out " + path("other") + " --quiet", 2);
    EXPECT_FALSE(fs::exists(path("other"))) << name;
  }
}

TEST_F(SimulateCommand, WritesThroughNoLink) {
  folder_.write("x.json", experiment(1));
  const std::string command = "simulate " + path("x.json") + " --out " + path("data") + " --quiet";
  run(command);
  fs::rename(path("data") + "/000001", path("elsewhere"));
  fs::remove(path("elsewhere") + "/lidar_cloud_path.txt");
  fs::create_symlink(path("elsewhere"), path("data") + "/000001");
  const auto files = files_of(path("elsewhere"));
  run(command, 2);
  EXPECT_EQ(files_of(path("elsewhere")), files);
}

TEST_F(SimulateCommand, RefusesRecordings) {
  folder_.write("data/s/lidar_cloud_path.txt",
                "device_id: 0\npath: a.ply\ndevice_id: 1\npath: b.ply\n");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n1 2 3\n";
  folder_.write("data/s/a.ply", ply);
  folder_.write("data/s/b.ply", ply);
  folder_.write("x.json", R"({"name": "x", "dataset": {"type": "opencalib", "path": "data"},
                              "pipeline": [{"step": "identity"}]})");
  run("simulate " + path("x.json") + " --out " + path("out"), 2);
  EXPECT_FALSE(fs::exists(path("out")));
  run("simulate " + path("none.json") + " --out " + path("out"), 2);
  run("simulate " + path("x.json"), 2);
}

}  // namespace
}  // namespace croon::experiments
