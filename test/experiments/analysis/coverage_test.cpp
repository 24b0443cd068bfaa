#include "experiments/analysis/coverage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "experiments/report/plots.hpp"
#include "experiments/report/result_list.hpp"
#include "experiments/report/result_sections.hpp"
#include "framework/document/renderers.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;
using ::testing::HasSubstr;

/// Trials whose errors have the covariance that they claim, times `factor` squared.
std::vector<TrialRecord> drawn_records(int scenes, double factor) {
  Rng rng = croon::test::test_rng();
  std::vector<TrialRecord> records;
  for (int scene = 0; scene < scenes; ++scene) {
    for (const char* sensor : {"left", "right"}) {
      const PoseCovariance covariance = croon::test::random_covariance(rng);
      const Matrix6d root = covariance.matrix.llt().matrixL();
      Vector6d draws;
      for (int i = 0; i < 6; ++i) draws(i) = factor * rng.normal();
      records.push_back(test::finished({"base", std::to_string(scene), sensor, 0}, Status::success,
                                       croon::test::random_pose(rng, 2.0), root * draws));
      records.back().covariance = covariance;
    }
  }
  return records;
}

Coverage coverage_on(const std::vector<TrialRecord>& records) {
  return coverage_of(records, summarise(records, kBounds, {}));
}

/// The share of trials whose interval of `level` holds the truth.
const Share& share_at(const CoverageRow& row, double level) {
  const auto found = std::find(kCoverageLevels.begin(), kCoverageLevels.end(), level);
  return row.held.at(static_cast<std::size_t>(found - kCoverageLevels.begin()));
}

TEST(Coverage, IsTheLevelIfCovariancesAreRight) {
  const Coverage coverage = coverage_on(drawn_records(1000, 1.0));
  ASSERT_EQ(coverage.rows.size(), 3U * 7U);
  for (const CoverageRow& row : coverage.rows) {
    for (const double level : kCoverageLevels) {
      const Share& share = share_at(row, level);
      EXPECT_EQ(share.trials, row.sensor.empty() ? 2000 : 1000);
      EXPECT_NEAR(share.ratio, level, 4.0 * std::sqrt(0.25 / share.trials)) << name_of_dof(row);
      ASSERT_TRUE(share.interval);
    }
  }
  ASSERT_EQ(coverage.errors.size(), 3U);
  EXPECT_EQ(coverage.errors.back().sensor, "");
  EXPECT_NEAR(coverage.errors.back().mean, 6.0, 0.4);
  EXPECT_NEAR(coverage.errors.back().median, 5.35, 0.4);
  ASSERT_TRUE(coverage.errors.back().interval);
  EXPECT_LT(coverage.errors.back().interval->low, coverage.errors.back().median);
  EXPECT_GT(coverage.errors.back().interval->high, coverage.errors.back().median);
}

TEST(Coverage, IsLessIfCovariancesAreTooSmall) {
  const Coverage coverage = coverage_on(drawn_records(300, 3.0));
  for (const CoverageRow& row : coverage.rows) EXPECT_LT(share_at(row, 0.95).ratio, 0.7);
  EXPECT_NEAR(coverage.errors.back().mean, 54.0, 6.0);
}

TEST(Coverage, IsOfAcceptedTrialsWithTruthAndCovariance) {
  std::vector<TrialRecord> records = drawn_records(4, 1.0);
  records[0].status = Status::rejected;
  records[2].covariance.reset();
  records[4].error.reset();
  records[4].status = Status::finished;
  const Coverage coverage = coverage_on(records);
  EXPECT_EQ(coverage.rows.front().sensor, "left");
  EXPECT_EQ(coverage.rows.front().held.front().trials, 1);
  EXPECT_FALSE(coverage.rows.front().held.front().interval);  // Of one scene.
  EXPECT_EQ(coverage.errors.back().trials, 5);
  for (TrialRecord& record : records) record.covariance.reset();
  EXPECT_TRUE(coverage_on(records).rows.empty());
}

TEST(Coverage, OfACovarianceWithoutRankIsFiniteAlongIt) {
  Vector6d direction;
  direction << 0, 0, 0, 1, 1, 0;
  const Matrix6d covariance = direction * direction.transpose();
  EXPECT_NEAR(normalised_squared_error(2.0 * direction, covariance), 4.0, 1e-9);
  EXPECT_EQ(normalised_squared_error(Vector6d::Unit(0), covariance),
            std::numeric_limits<double>::infinity());
}

TEST(Coverage, CountsErrorsThatACovarianceDeniesAsMissesOnly) {
  std::vector<TrialRecord> records = drawn_records(10, 1.0);
  const Coverage all = coverage_on(records);
  records[0].covariance->matrix.setZero();
  const Coverage coverage = coverage_on(records);
  EXPECT_EQ(coverage.errors.back().trials, 19);
  EXPECT_TRUE(std::isfinite(coverage.errors.back().mean));
  EXPECT_TRUE(std::isfinite(coverage.errors.back().interval->high));
  EXPECT_EQ(coverage.rows.back().held.back().trials, 20);
  EXPECT_LE(coverage.rows.back().held.back().count, all.rows.back().held.back().count);
  for (TrialRecord& record : records) record.covariance->matrix.setZero();
  EXPECT_TRUE(coverage_on(records).errors.empty());
  EXPECT_EQ(coverage_on(records).rows.back().held.back().count, 0);
}

TEST(Coverage, HasTablesAndAFigure) {
  const std::vector<TrialRecord> records = drawn_records(10, 1.0);
  Results results;
  results.records = records;
  results.coverage = coverage_on(records);
  EXPECT_THAT(result_file("coverage.csv", results), HasSubstr("base,all,all,0.95,20,"));
  EXPECT_THAT(result_file("nees.csv", results), HasSubstr("base,all,20,"));
  EXPECT_THAT(text_section(coverage_section(results)), HasSubstr("yaw"));
  const std::string picture = result_file("coverage.svg", results);
  EXPECT_THAT(test::unreadable_parts(coverage_chart(results.coverage)), testing::IsEmpty());
  for (const std::string& name : kDofNames) EXPECT_THAT(picture, HasSubstr(">" + name + "<"));
  const std::string rows = result_file("covariance.csv", results);
  EXPECT_EQ(rows.substr(0, rows.find('\n')),
            "variant,scene,sensor,trial,c00,c01,c02,c03,c04,c05,c11,c12,c13,c14,c15,c22,c23,c24,"
            "c25,c33,c34,c35,c44,c45,c55,roll,pitch,yaw,x,y,z");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 21);
}

}  // namespace
}  // namespace croon::experiments
