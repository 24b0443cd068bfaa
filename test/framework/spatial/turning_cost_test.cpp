#include "framework/spatial/turning_cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// A street, and another sensor's view of it from a pose near `start`.
struct Turn {
  explicit Turn(std::uint64_t seed, double away_m = 0.0) : rng(test::test_rng(seed)) {
    const Eigen::Vector3d far = away_m * Eigen::Vector3d::UnitX();
    Points street = test::random_street(rng, 4, 3000, 0.01);
    start = test::pose_near(rng, {}, 60.0, 1.0);
    start.translation += far;
    axis = test::random_pose(rng, 1.0).rotation.col(0);
    const Cloud source(transformed(street, test::pose_near(rng, {}, 20.0, 0.3)), StreamKey(2));
    for (Eigen::Vector3f& point : street) point += far.cast<float>();
    const auto target = std::make_shared<const Cloud>(street, StreamKey(1));
    cost.emplace(target, source, 400, 2.0);
  }
  Rng rng;
  RigidTransform start;
  Eigen::Vector3d axis;
  std::optional<NearestDistanceCost> cost;
};

TEST(TurningCost, IsTheCostToTheLastBit) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Turn turn(seed);
    TurningCost turning(*turn.cost, turn.start, turn.axis);
    for (int i = 0; i < 30; ++i) {
      const double angle_rad = turn.rng.uniform(-3.0, 3.0);
      EXPECT_EQ(turning(angle_rad), (*turn.cost)(turning.turned(angle_rad)));
    }
  }
}

TEST(TurningCost, BelowIsRightAboutWhatIsLess) {
  for (const double away_m : {0.0, 500.0}) {
    Turn turn(7, away_m);
    TurningCost turning(*turn.cost, turn.start, turn.axis);
    double least = turning(0.0);
    // Ever smaller turns around the best so far, as a search makes them.
    double best_rad = 0.0;
    for (double step_rad = 0.5; step_rad > 1e-4; step_rad *= 0.7) {
      for (const double angle_rad : {best_rad - step_rad, best_rad + step_rad, best_rad}) {
        const double cost = (*turn.cost)(turning.turned(angle_rad));
        for (const double enough : {least, cost, 0.5 * cost, std::nextafter(cost, 1e9)}) {
          const double found = turning.below(angle_rad, enough);
          if (cost < enough) {
            EXPECT_EQ(found, cost);
          } else {
            EXPECT_GE(found, enough);
          }
        }
        if (cost < least) {
          least = cost;
          best_rad = angle_rad;
        }
      }
    }
  }
}

TEST(TurningCost, AGlanceIsTheCostOfFewPointsAndChangesNothing) {
  for (std::uint64_t seed = 11; seed <= 14; ++seed) {
    Turn turn(seed);
    TurningCost turning(*turn.cost, turn.start, turn.axis),
        glanced(*turn.cost, turn.start, turn.axis);
    double squares = 0.0, errors = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double angle_rad = turn.rng.uniform(-3.0, 3.0);
      const double cheap_estimate = glanced.cheap_estimate(angle_rad);
      const double cost = turning(angle_rad);
      EXPECT_EQ(glanced(angle_rad), cost);
      squares += cost * cost;
      errors += (cheap_estimate - cost) * (cheap_estimate - cost);
    }
    EXPECT_LT(std::sqrt(errors / squares), 0.5);
    EXPECT_GT(errors, 0.0);
  }
}

TEST(TurningCost, OfNoPointsIsZero) {
  const auto target = std::make_shared<const Cloud>(Points{{1.0F, 0.0F, 0.0F}}, StreamKey(1));
  const Cloud source(Points{}, StreamKey(2));
  TurningCost turning(NearestDistanceCost(target, source, 10, 1.0), {}, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(turning(0.1), 0.0);
  EXPECT_EQ(turning.below(0.1, 0.0), 0.0);
  EXPECT_EQ(turning.cheap_estimate(0.1), 0.0);
}

}  // namespace
}  // namespace croon
