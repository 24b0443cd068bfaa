// joint_registration moves the points of both clouds to where they were at the reference time.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "framework/base/angles.hpp"
#include "framework/spatial/deskew.hpp"
#include "framework/stage/given_motions.hpp"
#include "framework/stage/rig_step.hpp"
#include "test/support/driven_scan.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// A street at rest that a driving rig of two sensors measured.
struct DrivenStreet {
  Points of_target;  ///< In the target's frame half-way through its scan.
  Points of_source;  ///< In the source's frame at that time.
  RigEstimate one;   ///< Near the truth.
};

/// When a sensor that turns once in 0.1 s, about z or against it, looks at each of `points`.
std::vector<double> turning_times_s(const Points& points, double begin_s, float sense) {
  std::vector<double> times;
  for (const Eigen::Vector3f& point : points) {
    const double turn_rad = kPi + std::atan2(sense * point.y(), point.x());
    times.push_back(begin_s + 0.1 * turn_rad / (2.0 * kPi));
  }
  return times;
}

/// The source looks to another side, turns the other way and begins 0.02 s later, so that one
/// street tells the velocity from a shift of the sensor. Its clock is late: it shows `late_s` less
/// than the target's.
DrivenStreet driven_street(std::uint64_t scene_seed, const Twist& velocity, double late_s) {
  Rng rng = test::test_rng(scene_seed);
  const RigidTransform T_target_source = {rotation_from_rpy({0.05, -0.1, rad_from_deg(110.0)}),
                                          {1.2, -0.8, -0.5}};
  const test::StreetPair pair =
      test::street_pair(rng, scene_seed, T_target_source, 20000, 10000, 0.005);
  const std::vector<double> target_s = turning_times_s(pair.target, 0.0, 1.0F);
  std::vector<double> source_s = turning_times_s(pair.source, 0.02, -1.0F);
  const double reference_s = span_of(target_s).middle_s();
  DrivenStreet street = {pair.target, pair.source, {std::to_string(scene_seed), "top", "left", {}}};
  Estimate& estimate = street.one.estimate;
  estimate.target = std::make_shared<const Cloud>(
      test::driven_scan(pair.target, target_s, reference_s, velocity), StreamKey(1));
  PointCloud source =
      test::driven_scan(pair.source, source_s, reference_s, velocity, T_target_source);
  for (double& time_s : source_s) time_s -= late_s;
  source.channels = {make_channel(kTime, source_s)};
  estimate.source = std::make_shared<const Cloud>(std::move(source), StreamKey(2));
  estimate.T_target_source = test::pose_near(rng, T_target_source, 0.5, 0.1);
  return street;
}

/// 12 m/s move a point by up to 0.6 m during half a scan.
Twist fast() { return {{0.01, -0.02, 0.3}, {12.0, -0.5, 0.1}}; }

void adjust_streets(std::vector<DrivenStreet>& streets, const Step& step) {
  std::vector<RigEstimate> rig;
  for (const DrivenStreet& street : streets) rig.push_back(street.one);
  Rng rng = test::test_rng();
  dynamic_cast<const RigStep&>(step).adjust(rig, rng);
  for (std::size_t i = 0; i < rig.size(); ++i) streets[i].one = rig[i];
}

void adjust_streets(std::vector<DrivenStreet>& streets, const std::string& parameters) {
  adjust_streets(streets,
                 *test::stage<Step>(R"({"step": "joint_registration")" + parameters + "}"));
}

/// How many points are not within `tolerance_m` of where they should be.
std::size_t count_off(const Cloud& cloud, const Points& expected, float tolerance_m) {
  EXPECT_EQ(cloud.points().size(), expected.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!((cloud.points()[i] - expected[i]).norm() <= tolerance_m)) ++count;
  }
  return count;
}

void expect_street_at_rest(const DrivenStreet& street) {
  SCOPED_TRACE("street " + street.one.scene);
  ASSERT_EQ(street.one.failure, "");
  constexpr float kTolerance_m = 0.03F;
  EXPECT_EQ(count_off(*street.one.estimate.target, street.of_target, kTolerance_m), 0U);
  EXPECT_EQ(count_off(*street.one.estimate.source, street.of_source, kTolerance_m), 0U);
}

TEST(JointDeskew, PutsWhatADrivingRigMeasuredWhereItWas) {
  std::vector<DrivenStreet> streets = {driven_street(1, fast(), 0.0)};
  const DrivenStreet& street = streets.front();
  EXPECT_GT(count_off(*street.one.estimate.target, street.of_target, 0.3F), 5000U);
  EXPECT_GT(count_off(*street.one.estimate.source, street.of_source, 0.3F), 2500U);
  adjust_streets(streets, "");
  expect_street_at_rest(street);
}

Twist slow() { return {{0.0, 0.0, -0.1}, {4.0, 0.2, 0.0}}; }

/// Streets of different velocities, which tell the offset of a clock from a shift of the sensor
/// along the way. All begin at one pose.
std::vector<DrivenStreet> streets_of_a_late_clock(double late_s) {
  std::vector<DrivenStreet> streets;
  streets.push_back(driven_street(1, fast(), late_s));
  streets.push_back(driven_street(2, slow(), late_s));
  streets.push_back(driven_street(3, {}, late_s));
  for (DrivenStreet& street : streets) {
    street.one.estimate.T_target_source = streets.front().one.estimate.T_target_source;
  }
  return streets;
}

TEST(JointDeskew, AddsTheOffsetOfAClockToItsTimes) {
  std::vector<DrivenStreet> streets = streets_of_a_late_clock(0.03);
  const std::vector<DrivenStreet> before = streets;
  adjust_streets(streets, R"(, "poses": "common", "clock_offset_std_s": 0.1)");
  for (const DrivenStreet& street : streets) expect_street_at_rest(street);
  // The clouds have the times of the target's clock, also where the rig stands.
  for (std::size_t i = 0; i < streets.size(); ++i) {
    const Estimate& estimate = streets[i].one.estimate;
    const double offset_s = test::diagnostic(estimate, "clock_offset_s");
    EXPECT_NEAR(offset_s, 0.03, 0.002);
    const std::vector<double> late_s = times_s(before[i].one.estimate.source->with_channels());
    const std::vector<double> on_time_s = times_s(estimate.source->with_channels());
    for (std::size_t k = 0; k < late_s.size(); ++k) {
      ASSERT_NEAR(on_time_s[k], late_s[k] + offset_s, 1e-12);
    }
    EXPECT_EQ(times_s(estimate.target->with_channels()),
              times_s(before[i].one.estimate.target->with_channels()));
  }
}

TEST(JointDeskew, FindsTheOffsetOfAClockByWhichAKnownVelocityWasRemoved) {
  for (const double std : {0.0, 0.1}) {
    SCOPED_TRACE(std);
    std::vector<DrivenStreet> streets = streets_of_a_late_clock(0.03);
    GivenMotions motions;
    for (const auto& [scene, velocity] :
         std::map<std::string, Twist>{{"1", fast()}, {"2", slow()}, {"3", {}}}) {
      motions[scene] = {velocity, Vector6d::Constant(std)};
      if (std == 0.0) motions[scene].stds.reset();
    }
    const auto known = test::stage<Step>(R"({"step": "known_velocity", "file": "v.csv"})");
    adjust_streets(streets, *dynamic_cast<const GivenMotionStep&>(*known).with(motions));
    adjust_streets(streets, R"(, "poses": "common", "clock_offset_std_s": 0.1)");
    for (const DrivenStreet& street : streets) {
      expect_street_at_rest(street);
      EXPECT_NEAR(test::diagnostic(street.one.estimate, "clock_offset_s"), 0.03, 0.002);
    }
  }
}

}  // namespace
}  // namespace croon
