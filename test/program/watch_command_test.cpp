// croon check --watch on simulated drives: recordings, folders that grow, signals, and bad
// requests.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr int kScansOfDrive = 20;

/// A drive of two sensors, in a folder per scan.
class SimulatedDrive {
 public:
  SimulatedDrive() {
    const fs::path experiment = folder_.write("drive.json", R"({"name": "drive",
      "dataset": {"type": "simulated", "scenes": 20, "scans_per_drive": 20, "seed": 3,
                  "mix": {"urban": 1}, "noise": "real",
                  "rig": {"reference": "top", "sensors": {
                    "top": {"model": {"like": "spinner_32", "azimuth_step_deg": 0.4}},
                    "left": {"model": {"like": "spinner_32", "azimuth_step_deg": 0.4},
                             "rotation_rpy_deg": [10, 0, 90], "translation_m": [0, 0.6, -0.3]}}}},
      "starts": {"rotation_deg": 5, "trials": 1},
      "pipeline": [{"step": "ground_alignment"}, {"step": "registration"}]})");
    const Answer answer =
        croon("simulate '" + experiment.string() + "' --quiet --out '" + scans().string() + "'");
    EXPECT_EQ(answer.code, 0) << answer.text;
  }

  const fs::path& folder() const { return folder_.path(); }
  fs::path scans() const { return folder() / "scans"; }
  fs::path truth() const { return scans() / "truth.json"; }
  fs::path log() const { return folder() / "log.csv"; }
  fs::path cloud(int scan, const std::string& sensor) const {
    std::string name = std::to_string(scan);
    name.insert(0, 6 - name.size(), '0');
    return scans() / name / (sensor + ".pcd");
  }
  /// Copies the clouds of a scan into the folders of the sensors.
  void put(int scan) const {
    for (const char* sensor : {"top", "left"}) {
      const fs::path to = grown(scan, sensor);
      fs::create_directories(to.parent_path());
      fs::copy_file(cloud(scan, sensor), to, fs::copy_options::overwrite_existing);
    }
  }
  fs::path grown(int scan, const std::string& sensor) const {
    return folder() / "grown" / sensor / cloud(scan, "").parent_path().filename().concat(".pcd");
  }
  /// The arguments of a watch of `input`, with the log.
  std::string watch(const fs::path& input, const fs::path& poses) const {
    return "check '" + poses.string() + "' '" + input.string() +
           "' --reference top --watch --quiet --log '" + log().string() + "'";
  }

 private:
  test::TempFolder folder_;
};

std::size_t count_lines_of(const fs::path& file) {
  const std::string text = read_whole_file(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool waits_for_lines(const fs::path& file, std::size_t lines) {
  for (int i = 0; i < 600; ++i) {
    if (fs::exists(file) && count_lines_of(file) >= lines) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

TEST(WatchCommand, AuditsARecordingToItsEnd) {
  const SimulatedDrive drive;
  const Answer answer = croon(drive.watch(drive.scans(), drive.truth()));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_NE(answer.text.find(": left is right\n"), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("RIGHT"), std::string::npos) << answer.text;
  EXPECT_EQ(count_lines_of(drive.log()), kScansOfDrive + 1U);
  const std::string log = read_whole_file(drive.log());
  EXPECT_EQ(log.rfind("scan,scene,time_s,sensor,verdict,why_not,roll_deg,roll_std_deg,", 0), 0U);

  const Answer again = croon(drive.watch(drive.scans(), drive.truth()));
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.text.find("expected a new file, found one that exists"), std::string::npos)
      << again.text;
  EXPECT_EQ(read_whole_file(drive.log()), log);
}

TEST(WatchCommand, NamesAPoseThatIsOff) {
  const SimulatedDrive drive;
  const fs::path poses = drive.folder() / "poses.json";
  write_whole_file(poses, R"({"left": {"rotation_rpy_deg": [10, 0, 90],
                              "translation_m": [0, 0.68, -0.3]}})");
  const Answer answer = croon(drive.watch(drive.scans(), poses));
  EXPECT_EQ(answer.code, 3) << answer.text;
  EXPECT_NE(answer.text.find("left is wrong: y -"), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("DRIFTED"), std::string::npos) << answer.text;
}

TEST(WatchCommand, WaitsForIncompleteFilesUntilItIsInterrupted) {
  const SimulatedDrive drive;
  for (int scan = 0; scan < 3; ++scan) drive.put(scan);
  const pid_t pid = fork();
  if (pid == 0) {
    const std::string command = "exec '" + std::string(CROON_BINARY_DIR) + "/bin/croon' " +
                                drive.watch(drive.folder() / "grown", drive.truth()) +
                                " >/dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  EXPECT_TRUE(waits_for_lines(drive.log(), 4));
  drive.put(3);
  const std::string whole = read_whole_file(drive.cloud(3, "left"));
  write_whole_file(drive.grown(3, "left"), whole.substr(0, whole.size() / 2));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_EQ(count_lines_of(drive.log()), 4U);
  write_whole_file(drive.grown(3, "left"), whole);
  EXPECT_TRUE(waits_for_lines(drive.log(), 5));
  kill(pid, SIGINT);
  int status = 0;
  waitpid(pid, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);  // Too few scans to decide anything.
  const std::string log = read_whole_file(drive.log());
  EXPECT_EQ(count_lines_of(drive.log()), 5U);
  EXPECT_EQ(log.back(), '\n');
  EXPECT_EQ(log.find("unusable cloud"), std::string::npos) << log;
}

TEST(WatchCommand, RefusesOptionsWithoutWatchAndPosesOfOtherSensors) {
  const SimulatedDrive drive;
  EXPECT_EQ(croon("check '" + drive.truth().string() + "' '" + drive.scans().string() +
                  "' --until-idle 1")
                .code,
            2);
  const fs::path poses = drive.folder() / "poses.json";
  write_whole_file(poses,
                   R"({"lft": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}})");
  const Answer answer = croon(drive.watch(drive.scans(), poses));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("did you mean \"lft\"?"), std::string::npos) << answer.text;
  EXPECT_FALSE(fs::exists(drive.log()));
}

}  // namespace
}  // namespace croon::experiments
