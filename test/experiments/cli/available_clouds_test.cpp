// What is recorded is what was measured: clouds that change or cannot be read during a run.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <sstream>

#include "experiments/cli/commands.hpp"
#include "experiments/store/manifest.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/point_cloud_file.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

/// Bytes of a KITTI file with points at whole metres.
std::string cloud_bytes(int points, float x) {
  std::string bytes;
  for (int i = 0; i < points; ++i) {
    for (const float value : {x, static_cast<float>(i), static_cast<float>(i * i % 7), 0.0F}) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  return bytes;
}

/// Called when the sensor's cloud of the second scene is read for the second time. A run takes the
/// cloud that it has read to record it, and reads again for the second variant (`no_share`).
std::function<void()>& on_second_load() {
  static std::function<void()> hook;
  return hook;
}

struct FilesParams {
  std::string folder;
};

/// Scenes a and b with the clouds `<scene>_top.bin` and `<scene>_left.bin` in a folder.
class FilesDataset final : public Dataset {
 public:
  explicit FilesDataset(FilesParams params) : params_(std::move(params)) {}

  std::vector<Scene> scenes(const std::filesystem::path&) const override {
    std::vector<Scene> scenes;
    for (const std::string name : {"a", "b"}) {
      Scene scene;
      scene.name = name;
      scene.reference = scan(name, "top");
      scene.sensors = {scan(name, "left")};
      scenes.push_back(scene);
    }
    return scenes;
  }

 private:
  SensorScan scan(const std::string& scene, const std::string& sensor) const {
    SensorScan scan;
    scan.sensor = sensor;
    scan.file = params_.folder + "/" + scene + "_" + sensor + ".bin";
    scan.truth = RigidTransform{};
    const auto loads = std::make_shared<std::atomic<int>>(0);
    const bool is_watched = scene == "b" && sensor == "left";
    scan.load = [file = scan.file, loads, is_watched] {
      if (++*loads == 2 && is_watched && on_second_load()) on_second_load()();
      return read_point_cloud(file);
    };
    return scan;
  }

  FilesParams params_;
};

Catalogue catalogue() {
  Catalogue catalogue = test::fake_catalogue();
  params::Table<FilesParams> table = {
      params::text("folder", &FilesParams::folder, "The folder of the clouds.")};
  catalogue.add(stage_entry<FilesDataset>("files", "Clouds in files.", "a test", table));
  return catalogue;
}

class AvailableClouds : public testing::Test {
 protected:
  AvailableClouds() {
    for (const char* cloud : {"a_top", "a_left", "b_top", "b_left"}) write(cloud, 1.0F);
    folder_.write("x.json", R"({"name": "x", "dataset": {"type": "files", "folder": ")" +
                                folder_.path().string() +
                                R"("}, "starts": {"trials": 3}, "pipeline": [{"step": "drift"}],
                                     "variants": [{"name": "again"}]})");
  }
  /// Makes the two scenes one group.
  void group() const {
    std::string text = read_whole_file(folder_.path() / "x.json");
    text.insert(1, "\"scenes_per_trial\": 2, ");
    folder_.write("x.json", text);
  }

  ~AvailableClouds() override { on_second_load() = {}; }

  void write(const std::string& cloud, float x) const {
    folder_.write(cloud + ".bin", cloud_bytes(40, x));
  }

  struct Answer {
    int code;
    std::string complaints;
  };

  Answer run(const std::string& out, RunOptions options = {}) const {
    options.experiment = folder_.path() / "x.json";
    options.out = folder_.path() / out;
    options.data = folder_.path();
    options.quiet = true;
    options.no_share = true;
    std::ostringstream text, complaints;
    const int code = run_command(options, catalogue(), text, complaints);
    return {code, complaints.str()};
  }

  std::string trials(const std::string& out) const {
    return read_whole_file(folder_.path() / out / "trials.csv");
  }

  test::TempFolder folder_;
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST_F(AvailableClouds, ThatAreNotThereForAMomentAreTriedAgain) {
  const std::string file = (folder_.path() / "b_left.bin").string();
  on_second_load() = [&] { std::filesystem::rename(file, file + ".away"); };
  const Answer first = run("out");
  EXPECT_EQ(first.code, 3);
  EXPECT_EQ(first.complaints.find("croon: " + file +
                                  ": expected a readable file, found none; its "
                                  "trials are not stored, the next run repeats them\n"),
            0U)
      << first.complaints;
  EXPECT_EQ(count_of(trials("out"), "\nagain,a,"), 3U);
  EXPECT_EQ(count_of(trials("out"), "\nagain,b,"), 0U);
  on_second_load() = {};
  std::filesystem::rename(file + ".away", file);
  EXPECT_EQ(run("out").code, 0);
  EXPECT_EQ(run("whole").code, 0);
  EXPECT_EQ(trials("out"), trials("whole"));
  EXPECT_EQ(count_of(trials("out"), "\nagain,b,"), 3U);
}

TEST_F(AvailableClouds, ThatChangeDuringARunAreNotStored) {
  on_second_load() = [&] { write("b_left", 2.0F); };
  const Answer answer = run("out");
  EXPECT_EQ(answer.code, 3);
  EXPECT_EQ(answer.complaints,
            "croon: b_left.bin: has changed since the start of the run; its trials are not "
            "stored, the next run repeats them\n");
  EXPECT_EQ(count_of(trials("out"), "\nagain,a,"), 3U);
  EXPECT_EQ(count_of(trials("out"), "\nagain,b,"), 0U);
  // The next run sees that the data are others.
  EXPECT_THROW(run("out"), InputError);
}

TEST_F(AvailableClouds, ThatChangeDuringARunAreNotFused) {
  on_second_load() = [&] { write("b_left", 2.0F); };
  RunOptions options;
  options.clouds = true;
  const Answer answer = run("out", options);
  EXPECT_EQ(answer.code, 3);
  EXPECT_NE(answer.complaints.find("croon: b_left.bin: has changed since the start of the "
                                   "run; the clouds of scene b are not written\n"),
            std::string::npos)
      << answer.complaints;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/clouds/base/b.ply"));
}

TEST_F(AvailableClouds, ThatAreDamagedDuringARunAreNotStored) {
  on_second_load() = [&] { folder_.write("b_left.bin", "half"); };
  EXPECT_EQ(run("out").code, 3);
  EXPECT_EQ(count_of(trials("out"), "failed"), 0U);
}

TEST_F(AvailableClouds, ThatAreDamagedAreAResultWithTheirPath) {
  folder_.write("b_left.bin", "half");
  EXPECT_EQ(run("out").code, 3);
  EXPECT_EQ(count_of(trials("out"), "failed"), 6U);
  const std::string summary = read_whole_file(folder_.path() / "out/summary.json");
  EXPECT_NE(summary.find("the cloud of left: expected rows of 4 or 5 floats (x, y, z, intensity, "
                         "...), found 4 bytes, in b_left.bin"),
            std::string::npos)
      << summary;
}

TEST_F(AvailableClouds, OfGroupsThatAreDamagedAreToldByEachRun) {
  group();
  folder_.write("b_left.bin", "half");
  const std::string told =
      "croon: scene b: the cloud of left: expected rows of 4 or 5 floats (x, y, z, intensity, "
      "...), found "
      "4 bytes, in b_left.bin; its trials use the other scenes of the group\n";
  for (const char* which : {"first", "again"}) {
    const Answer answer = run("out");
    EXPECT_EQ(answer.code, 3) << which;
    EXPECT_EQ(answer.complaints, told) << which;
  }
  EXPECT_EQ(count_of(trials("out"), "failed"), 0U);
}

TEST_F(AvailableClouds, AreReadOnceToBeRecorded) {
  std::vector<SceneGroup> groups =
      scene_groups(load_experiment(folder_.path() / "x.json", catalogue()), "");
  int loads = 0;
  auto& load = groups[1].scenes[0].sensors[0].load;
  load = [&loads, original = load] {
    ++loads;
    return original();
  };
  const std::vector<InputFile> inputs = record_inputs(groups, folder_.path(), 1);
  ASSERT_EQ(inputs.size(), 4U);
  EXPECT_EQ(inputs[3].path, "b_left.bin");
  EXPECT_EQ(inputs[3].points, 40U);
  EXPECT_EQ(loads, 1);
  // What was read to be recorded is what the first trials get.
  EXPECT_EQ(load().points.size(), 40U);
  EXPECT_EQ(loads, 1);
  EXPECT_EQ(load().points.size(), 40U);
  EXPECT_EQ(loads, 2);
  write("b_left", 3.0F);
  EXPECT_THROW(load(), UnavailableFile);
}

}  // namespace
}  // namespace croon::experiments
