#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "experiments/cli/commands.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/document/renderers.hpp"
#include "framework/io/pcd_file.hpp"
#include "registry/registry.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Results of two clouds in files, and the command on them.
class ReportCommand : public ::testing::Test {
 protected:
  ReportCommand() {
    Rng rng = test::test_rng();
    for (const char* sensor : {"top", "left"}) {
      fs::create_directories(path("data/car") / sensor);
      write_pcd(path("data/car") / sensor / "1.pcd", test::random_cloud(rng, 200, 10.0));
    }
    folder_.write("data/car/truth.json",
                  R"({"left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [1, 0, 0]}})");
    RunOptions options;
    options.experiment = folder_.write("x.json", R"({
        "name": "x", "starts": {"trials": 4},
        "dataset": {"type": "sensor_folders", "path": "car", "reference": "top"},
        "pipeline": [{"step": "identity"}]})");
    options.data = path("data");
    options.out = path("out");
    options.quiet = true;
    std::ostringstream text, progress;
    run_command(options, registry(), text, progress);
  }

  void SetUp() override {
    if (!can_write_html()) GTEST_SKIP() << "a build without reports";
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }

  /// Runs `croon report` and returns its exit code.
  int report(const std::vector<std::string>& folders, const std::string& data = "data",
             const std::vector<std::string>& trials = {}) {
    ReportOptions options;
    for (const std::string& name : folders) options.folders.push_back(path(name));
    options.trials = trials;
    options.data = path(data);
    std::ostringstream out;
    const int code = report_command(options, registry(), out);
    text_ = out.str();
    return code;
  }

  /// The report without the scripts of the program.
  std::string page() const {
    const std::string whole = read_whole_file(path("out/report.html"));
    return whole.substr(0, whole.find("<script>"));
  }

  test::TempFolder folder_;
  std::string text_;
};

TEST_F(ReportCommand, WritesTheSameReportTwice) {
  EXPECT_EQ(report({"out"}), 0);
  EXPECT_EQ(text_, "The report is in " + path("out/report.html").string() + "\n");
  const std::string first = page();
  EXPECT_THAT(first, HasSubstr("The largest error of an accepted pose"));
  EXPECT_THAT(first, HasSubstr("<figure class=\"cloud-view\""));
  EXPECT_EQ(report({"out"}), 0);
  EXPECT_TRUE(page() == first);
}

TEST_F(ReportCommand, ShowsTheTrialsThatItIsAskedFor) {
  const std::string advice = "croon report DIR --trial";
  EXPECT_EQ(report({"out"}), 0);
  EXPECT_THAT(page(), AllOf(HasSubstr(advice), Not(HasSubstr("The trial base/1/left/"))));
  EXPECT_EQ(report({"out"}, "data", {"base/1/left/2", "1/left/0"}), 0);
  EXPECT_THAT(page(),
              AllOf(HasSubstr("The trial base/1/left/2"), HasSubstr("The trial base/1/left/0")));
}

TEST_F(ReportCommand, WritesNothingIfATrialCannotBeShown) {
  const auto error = [&](const std::string& data, const std::string& trial) {
    return test::input_error([&] { report({"out"}, data, {trial}); });
  };
  EXPECT_THAT(error("data", "base/1/lfet/2"), HasSubstr("did you mean \"base/1/left/2\"?"));
  EXPECT_THAT(error("nowhere", "base/1/left/2"), HasSubstr("nowhere"));
  EXPECT_THAT(test::input_error([&] {
                report({"out", "out"}, "data", {"base/1/left/2"});
              }),
              HasSubstr("--trial: expected one folder, found 2"));
  Rng rng = test::test_rng();
  write_pcd(path("data/car/left/1.pcd"), test::random_cloud(rng, 100, 10.0));
  EXPECT_THAT(error("data", "base/1/left/2"), HasSubstr("has changed since the run"));
  EXPECT_FALSE(fs::exists(path("out/report.html")));
}

TEST_F(ReportCommand, SaysThatWallTimesAreLeftOut) {
  fs::remove(path("out/timings.sqlite"));
  EXPECT_EQ(report({"out"}), 0);
  EXPECT_THAT(text_, HasSubstr("timings.csv: its wall times are left out"));
}

TEST_F(ReportCommand, WithoutTheDataSaysWhyThereAreNoViews) {
  EXPECT_EQ(report({"out"}, "nowhere"), 0);
  EXPECT_THAT(page(), HasSubstr("The clouds of the trials could not be read"));
  EXPECT_THAT(page(), Not(HasSubstr("<figure class=\"cloud-view\"")));
}

TEST_F(ReportCommand, ShowsNoCloudsThatHaveChanged) {
  Rng rng = test::test_rng();
  write_pcd(path("data/car/left/1.pcd"), test::random_cloud(rng, 100, 10.0));
  EXPECT_EQ(report({"out"}), 0);
  EXPECT_THAT(page(), HasSubstr("left/1.pcd: has changed since the run"));
  EXPECT_THAT(page(), Not(HasSubstr("<figure class=\"cloud-view\"")));
}

TEST_F(ReportCommand, RefusesFoldersWithoutResultsAndRepeats) {
  fs::create_directories(path("empty"));
  EXPECT_THAT(test::input_error([&] { report({"empty"}); }), HasSubstr("empty"));
  EXPECT_FALSE(fs::exists(path("empty/report.html")));
  folder_.write("empty/rig.json", "{}");
  EXPECT_THAT(test::input_error([&] { report({"empty"}); }), HasSubstr("found a calibration"));
  EXPECT_THAT(test::input_error([&] { report({"nowhere"}); }), HasSubstr("nowhere"));
  EXPECT_NE(test::input_error([&] { report({"out", "out"}); }), "");
  EXPECT_NE(test::input_error([&] { report({"out", "out/../out"}); }), "");
  EXPECT_FALSE(fs::exists(path("out/report.html")));
}

}  // namespace
}  // namespace croon::experiments
