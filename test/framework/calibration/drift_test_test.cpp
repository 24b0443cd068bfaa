// The sequential test for drift: false alarms, delays, and the properties of its statistic.
#include "framework/calibration/drift_test.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/rng.hpp"

namespace croon {
namespace {

constexpr double kDriftStd_rad = rad_from_deg(0.03);
constexpr double kDriftStd_m = 0.006;

Vector6d drift_deviations() {
  Vector6d stds;
  stds << Eigen::Vector3d::Constant(kDriftStd_rad), Eigen::Vector3d::Constant(kDriftStd_m);
  return stds;
}

/// DriftErrors with the standard deviations above and the lag-one correlation `correlation`.
class DriftErrors {
 public:
  DriftErrors(std::uint64_t seed, double correlation)
      : rng_(StreamKey(seed).with("drift")), correlation_(correlation) {}

  Vector6d next() {
    for (int i = 0; i < 6; ++i) {
      const double fresh = std::sqrt(1.0 - correlation_ * correlation_) * rng_.normal();
      last_(i) = is_first_ ? rng_.normal() : correlation_ * last_(i) + fresh;
    }
    is_first_ = false;
    return last_.cwiseProduct(drift_deviations());
  }

 private:
  Rng rng_;
  double correlation_;
  bool is_first_ = true;
  Vector6d last_ = Vector6d::Zero();
};

/// The number of scans until the test raises an alarm, at most `max_scans`, with the constant
/// `offset` from scan `from`.
std::size_t scans_until_alarm(DriftTest& test, DriftErrors& errors, const Vector6d& offset,
                              std::size_t from, std::size_t max_scans) {
  for (std::size_t k = 0; k < max_scans; ++k) {
    const Vector6d error = errors.next();
    test.add(k, k < from ? error : Vector6d(error + offset), drift_deviations());
    if (test.state() == DriftState::drifted) return k;
  }
  return max_scans;
}

/// At the edge of the tolerance, where false alarms are most frequent.
Vector6d tolerated_offset() {
  Vector6d offset;
  offset << Eigen::Vector3d::Constant(kScatter_rad), Eigen::Vector3d::Constant(kScatter_m);
  return offset;
}

TEST(DriftTest, FalseAlarmsAreRarerThanStated) {
  constexpr double kMeanScans = 1000.0;
  constexpr std::size_t kLast = 3000;
  for (const double correlation : {0.0, 0.5}) {
    DriftTestOptions options;
    options.threshold = drift_threshold(kMeanScans, 6);
    double scans = 0.0, alarms = 0.0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      DriftTest test(options);
      DriftErrors errors(seed, correlation);
      const std::size_t alarm = scans_until_alarm(test, errors, tolerated_offset(), 0, kLast);
      scans += static_cast<double>(alarm);
      if (alarm < kLast) alarms += 1.0;
    }
    EXPECT_GT(scans, kMeanScans * alarms) << "correlation " << correlation;
  }
}

TEST(DriftTest, NoticesAKnockWithinTwentyScansAndSaysWhichAndWhen) {
  constexpr std::size_t kKnock = 300, kLast = 500;
  for (int dof = 0; dof < 6; ++dof) {
    for (const double sign : {-1.0, 1.0}) {
      DriftTestOptions options;
      options.threshold = drift_threshold(360000.0, 24);
      DriftTest test(options);
      DriftErrors errors(static_cast<std::uint64_t>(dof), 0.0);
      const double size = sign * (dof < 3 ? rad_from_deg(0.2) : 0.02);
      const Vector6d offset = size * Vector6d::Unit(dof);
      const std::size_t alarm = scans_until_alarm(test, errors, offset, kKnock, kLast);
      EXPECT_GE(alarm, kKnock);
      EXPECT_LT(alarm, kKnock + 20);
      const DriftTest::Change change = test.largest_change();
      EXPECT_EQ(static_cast<int>(change.dof), dof);
      EXPECT_NEAR(change.size, size, 5.0 * change.deviation);
      EXPECT_NEAR(static_cast<double>(change.since), static_cast<double>(kKnock), 5.0);
      EXPECT_FALSE(change.is_from_start);
    }
  }
}

TEST(DriftTest, SaysThatAPoseWasWrongFromTheStart) {
  DriftTest test;
  DriftErrors errors(1, 0.0);
  const Vector6d offset = 0.05 * Vector6d::Unit(3);
  EXPECT_LT(scans_until_alarm(test, errors, offset, 0, 100), 100U);
  EXPECT_TRUE(test.largest_change().is_from_start);
}

TEST(DriftTest, ThreeBadScansRaiseNoAlarm) {
  DriftTest test;
  DriftErrors errors(2, 0.0);
  for (std::size_t k = 0; k < 1000; ++k) {
    const bool is_bad = k % 50 < 3 && k > 100;
    test.add(k, errors.next() + (is_bad ? 1.0 : 0.0) * Vector6d::Ones(), drift_deviations());
    EXPECT_NE(test.state(), DriftState::drifted) << k;
  }
}

TEST(DriftTest, TreatsDegreesOfFreedomAlike) {
  DriftTest forwards, backwards;
  DriftErrors errors(3, 0.3);
  const auto reversed = [](const Vector6d& v) {
    Vector6d w;
    w << v.head<3>().reverse(), v.tail<3>().reverse();
    return w;
  };
  for (std::size_t k = 0; k < 200; ++k) {
    const Vector6d error = 3.0 * errors.next();
    forwards.add(k, error, drift_deviations());
    backwards.add(k, reversed(error), reversed(drift_deviations()));
    EXPECT_EQ(forwards.statistics(), reversed(backwards.statistics()));
    EXPECT_EQ(forwards.state(), backwards.state());
  }
}

TEST(DriftTest, MeasuresTheCorrelationOfTheErrors) {
  DriftTest independent, correlated;
  DriftErrors a(4, 0.0), b(4, 0.8);
  for (std::size_t k = 0; k < 5000; ++k) {
    independent.add(k, a.next(), drift_deviations());
    correlated.add(k, b.next(), drift_deviations());
  }
  // The variance of a mean of n correlated errors is up to (1 + r) / (1 - r) = 9 times as large.
  EXPECT_LT(independent.inflations().maxCoeff(), 1.5);
  EXPECT_GT(correlated.inflations().minCoeff(), 4.0);
  EXPECT_LT(correlated.inflations().maxCoeff(), 10.0);
}

TEST(DriftTest, GoesBackToRightAfterARepair) {
  DriftTest test;
  DriftErrors errors(5, 0.0);
  std::size_t changes = 0;
  DriftState last = test.state();
  for (std::size_t k = 0; k < 700; ++k) {
    const bool is_off = k >= 200 && k < 400;
    test.add(k, errors.next() + (is_off ? 0.04 : 0.0) * Vector6d::Unit(4), drift_deviations());
    if (test.state() != last) ++changes;
    last = test.state();
  }
  EXPECT_EQ(last, DriftState::right);
  EXPECT_EQ(changes, 3U);  // Right, drifted, right.
}

TEST(DriftTest, IsUndecidableWithoutScansAndWithUncertainOnes) {
  DriftTest test;
  DriftErrors errors(6, 0.0);
  for (std::size_t k = 0; k < 50; ++k) test.add(k, errors.next(), drift_deviations());
  EXPECT_EQ(test.state(), DriftState::right);
  for (int k = 0; k < 16; ++k) test.add_missing();
  EXPECT_EQ(test.state(), DriftState::undecidable);
  for (std::size_t k = 70; k < 90; ++k) test.add(k, errors.next(), drift_deviations());
  EXPECT_EQ(test.state(), DriftState::right);
  const Vector6d along_the_road = drift_deviations() + 10.0 * Vector6d::Unit(3);
  for (std::size_t k = 90; k < 110; ++k) test.add(k, errors.next(), along_the_road);
  EXPECT_EQ(test.state(), DriftState::undecidable);
}

}  // namespace
}  // namespace croon
