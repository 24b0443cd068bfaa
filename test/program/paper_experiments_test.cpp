#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "test/program/program.hpp"
#include "test/support/data_root.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The rows of a CSV file without quotes.
std::vector<Row> rows_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = cells_of(line);
    Row row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[names[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

/// The trials of an experiment of the paper with a few starts.
std::vector<Row> trials_of(const std::string& experiment, const std::string& options) {
  const test::TempFolder folder;
  const std::string out = (folder.path() / "out").string();
  const Answer answer =
      croon("run " CROON_SOURCE_DIR "/experiments/paper/" + experiment + ".json --data " +
            test::data_root().string() + " --quiet --out " + out + " " + options);
  EXPECT_EQ(answer.code, 0) << answer.text;
  return rows_of(out + "/trials.csv");
}

RigidTransform pose_of(const Row& row) {
  const auto number = [&row](const char* name) { return std::stod(row.at(name)); };
  const Eigen::Quaterniond q(number("qw"), number("qx"), number("qy"), number("qz"));
  return {q.toRotationMatrix(), {number("tx_m"), number("ty_m"), number("tz_m")}};
}

/// What the authors' published stitched clouds imply.
RigidTransform published(const Row& row) {
  std::ifstream file(test::data_root() / "opencalib/real" / row.at("scene") /
                     "published_result.json");
  const nlohmann::json matrix = nlohmann::json::parse(file)["T_top_sensor"][row.at("sensor")];
  RigidTransform T;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) T.rotation(i, j) = matrix[i][j].get<double>();
    T.translation(i) = matrix[i][3].get<double>();
  }
  return T;
}

TEST(PaperExperiments, TheMethodReturnsToTheTruthOnCarla) {
  CROON_SKIP_WITHOUT_DATA();
  const std::vector<Row> rows = trials_of("carla_samples", "--trials 3 --only base");
  EXPECT_EQ(rows.size(), 24U);
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("status"), "success");
    EXPECT_LT(std::stod(row.at("rotation_error_deg")), 0.05) << row.at("sensor");
    EXPECT_LT(std::stod(row.at("translation_error_m")), 0.012) << row.at("sensor");
  }
}

TEST(PaperExperiments, RealScenesAreConsistentAndNearThePublishedResult) {
  CROON_SKIP_WITHOUT_DATA();
  const std::vector<Row> rows = trials_of("real_consistency", "--trials 3 --only base");
  EXPECT_EQ(rows.size(), 12U);
  std::map<std::string, RigidTransform> first;
  for (const Row& row : rows) {
    const RigidTransform pose = pose_of(row);
    const PoseError error = pose_error(pose, published(row));
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.3) << row.at("scene") << row.at("sensor");
    EXPECT_LT(error.translation_m, 0.05) << row.at("scene") << row.at("sensor");
    const PoseError spread =
        pose_error(pose, first.emplace(row.at("scene") + row.at("sensor"), pose).first->second);
    EXPECT_LT(deg_from_rad(spread.rotation_rad), 0.02);
    EXPECT_LT(spread.translation_m, 0.02);
  }
}

TEST(PaperExperiments, TheAuthorsCodeSlidesAlongTheRoadInOneOfEightPairs) {
  CROON_SKIP_WITHOUT_DATA();
  for (const Row& row : trials_of("opencalib_2022_03", "--trials 2")) {
    const bool slides = row.at("scene") == "004553" && row.at("sensor") == "front";
    EXPECT_EQ(row.at("status"), slides ? "inaccurate" : "success")
        << row.at("scene") << row.at("sensor");
    if (slides) {
      EXPECT_GT(std::abs(std::stod(row.at("x_error_m"))), 0.1);
      EXPECT_LT(std::abs(std::stod(row.at("y_error_m"))), 0.1);
    }
  }
}

}  // namespace
}  // namespace croon::experiments
