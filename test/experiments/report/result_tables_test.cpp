#include "experiments/report/result_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "test/support/occurrences.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::random_pose;
using croon::test::test_rng;

constexpr const char* kHeader =
    "variant,scene,sensor,trial,status,rotation_error_deg,translation_error_m,roll_error_deg,"
    "pitch_error_deg,yaw_error_deg,x_error_m,y_error_m,z_error_m,tx_m,ty_m,tz_m,qx,qy,qz,qw,"
    "agrees\n";

TEST(ShortestNumber, ReadsBackAsTheSameBits) {
  Rng rng = test_rng();
  for (int i = 0; i < 10000; ++i) {
    const double value = rng.normal() * std::pow(10.0, rng.uniform(-20.0, 20.0));
    EXPECT_EQ(std::strtod(shortest_number(value).c_str(), nullptr), value);
  }
}

TEST(ShortestNumber, IsShortAndZeroHasNoSign) {
  EXPECT_EQ(shortest_number(0.1), "0.1");
  EXPECT_EQ(shortest_number(-2.0), "-2");
  EXPECT_EQ(shortest_number(-0.0), "0");
  EXPECT_EQ(shortest_number(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(UnitQuaternion, IsTheRotationAndHasOneSign) {
  Rng rng = test_rng();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d R = random_pose(rng, 1.0).rotation;
    const Eigen::Quaterniond q = unit_quaternion(R);
    EXPECT_GE(q.w(), 0.0);
    EXPECT_LT((q.toRotationMatrix() - R).norm(), 1e-12);
  }
  const Eigen::Quaterniond half_turn = unit_quaternion(Eigen::Vector3d(-1, -1, 1).asDiagonal());
  EXPECT_EQ(half_turn.w(), 0.0);
  EXPECT_EQ(half_turn.z(), 1.0);
}

TEST(TrialsCsv, HasEveryColumnOfAFinishedTrial) {
  TrialRecord record = test::finished_without_truth(
      {"base", "0001", "front", 7}, {Eigen::Vector3d(1, -1, -1).asDiagonal(), {1.5, -2.0, 0.1}});
  record.error.emplace();
  record.error->dof << kPi, -kPi / 2.0, 0.0, 0.5, -0.25, 0.125;
  record.error->rotation_rad = kPi;
  record.error->translation_m = 0.75;
  record.status = Status::inaccurate;
  EXPECT_EQ(trials_csv({record}, {}),
            std::string(kHeader) +
                "base,0001,front,7,inaccurate,180,0.75,180,-90,0,0.5,-0.25,0.125,"
                "1.5,-2,0.1,1,0,0,0,\n");
}

TEST(TrialsCsv, LeavesEmptyWhatIsNotKnown) {
  const TrialId id = {"no volume", "a,b", "left", 0};
  const std::string rows = trials_csv(
      {test::finished_without_truth(id, {}), test::unfinished(id, Status::failed, "no ground"),
       test::unfinished(id, Status::rejected, "two yaws fit")},
      {});
  EXPECT_EQ(rows, std::string(kHeader) +
                      "no volume,\"a,b\",left,0,finished,,,,,,,,,0,0,0,0,0,0,1,\n"
                      "no volume,\"a,b\",left,0,failed,,,,,,,,,,,,,,,,\n"
                      "no volume,\"a,b\",left,0,rejected,,,,,,,,,,,,,,,,\n");
}

TEST(Agreement, IsTheSameCountInEveryFile) {
  std::vector<TrialRecord> records = test::one_of_four_astray();
  records.push_back(test::unfinished({"base", "0001", "left", 4}, Status::failed, "no ground"));
  const Summary summary = summarise(records, test::kBounds, {});
  const std::string trials = trials_csv(records, summary);
  EXPECT_EQ(test::occurrences(trials, ",finished,"), 4U);
  EXPECT_EQ(test::occurrences(trials, ",1\n"), 3U);
  EXPECT_EQ(test::occurrences(trials, ",0\n"), 1U);
  EXPECT_EQ(test::occurrences(trials, "success"), 0U);
  const auto row = nlohmann::json::parse(summary_json(summary))["rows"][0];
  EXPECT_TRUE(row["success"].is_null());
  EXPECT_TRUE(row["inaccurate"].is_null());
  EXPECT_EQ(row["finished"], 4);
  EXPECT_EQ(row["failed"], 1);
  EXPECT_EQ(row["agreement"]["count"], 3);
  EXPECT_EQ(row["scenes"][0]["agreement"]["count"], 3);
  EXPECT_EQ(row["counted"], 3);
}

TEST(Agreement, WithTruthIsNotSuccess) {
  std::vector<TrialRecord> records;  // Most trials agree on a pose that is wrong.
  for (int trial = 0; trial < 5; ++trial) {
    const bool is_right = trial < 2;
    records.push_back(test::finished({"base", "0001", "left", trial},
                                     is_right ? Status::success : Status::inaccurate, {},
                                     test::offset_of(0, 0, 0, is_right ? 0.0 : 1.0, 0, 0)));
  }
  const Summary summary = summarise(records, test::kBounds, {});
  EXPECT_EQ(summary.rows[0].success.count, 2);
  EXPECT_EQ(summary.rows[0].agreement.count, 3);
  EXPECT_EQ(summary.rows[0].counted, 2);
  EXPECT_EQ(test::occurrences(trials_csv(records, summary), "inaccurate"), 3U);
  EXPECT_EQ(test::occurrences(trials_csv(records, summary), ",1\n"), 3U);
}

}  // namespace
}  // namespace croon::experiments
