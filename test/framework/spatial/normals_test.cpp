#include "framework/spatial/normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(Normals, OfRandomPlanesAreTheirsAndFaceTheSensor) {
  Rng rng = test::test_rng();
  for (int trial = 0; trial < 20; ++trial) {
    const RigidTransform pose = test::random_pose(rng, 5.0);
    Points cloud;
    for (int i = 0; i < 300; ++i) {
      cloud.push_back(
          (pose * Eigen::Vector3d{rng.uniform(-1, 1), rng.uniform(-1, 1), 0}).cast<float>());
    }
    const KdTree tree(cloud);
    const Normals normals(cloud, tree, 40);
    for (int i = 0; i < 300; ++i) {
      const LocalShape shape = normals.at(i);
      EXPECT_NEAR(std::abs(shape.normal.dot(pose.rotation.col(2).cast<float>())), 1.0F, 1e-5F);
      EXPECT_LE(shape.normal.dot(cloud[i]), 0.0F);
      EXPECT_LT(shape.surface_variation, 1e-5F);
    }
  }
}

TEST(Normals, AreUndefinedOnALineAndAmongEqualPoints) {
  Points line, equal;
  for (int i = 0; i < 50; ++i) {
    line.push_back(Eigen::Vector3f(1.0F + 0.1F * static_cast<float>(i), 2.0F, 3.0F));
    equal.push_back({1, 2, 3});
  }
  for (const Points& cloud : {line, equal, Points{{1, 0, 0}, {0, 1, 0}}}) {
    const KdTree tree(cloud);
    EXPECT_TRUE(Normals(cloud, tree, 10).at(0).normal.isZero());
  }
}

TEST(Normals, AreUndefinedOnLinesOfAnyDirection) {
  Rng rng = test::test_rng();
  for (int trial = 0; trial < 500; ++trial) {
    const RigidTransform pose = test::random_pose(rng, 10.0);
    Points line;
    for (int i = 0; i < 40; ++i) {
      line.push_back((pose * Eigen::Vector3d(rng.uniform(-2, 2), 0, 0)).cast<float>());
    }
    const KdTree tree(line);
    EXPECT_TRUE(Normals(line, tree, 40).at(0).normal.isZero());
  }
}

TEST(Normals, VariationTellsARoundCloudFromAFlatOne) {
  Rng rng = test::test_rng();
  Points cloud = test::random_cloud(rng, 400, 1.0);
  const KdTree tree(cloud);
  EXPECT_GT(Normals(cloud, tree, 400).at(0).surface_variation, 0.25F);
}

TEST(Normals, LengthAndBreadthAreStandardDeviationsInAnyPose) {
  Rng rng = test::test_rng();
  for (int trial = 0; trial < 20; ++trial) {
    const RigidTransform pose = test::random_pose(rng, 5.0);
    const double half_length_m = rng.uniform(1.0, 2.0), half_breadth_m = rng.uniform(0.01, 0.5);
    Points cloud;
    for (int i = 0; i < 2000; ++i) {
      cloud.push_back((pose * Eigen::Vector3d{rng.uniform(-half_length_m, half_length_m),
                                              rng.uniform(-half_breadth_m, half_breadth_m), 0})
                          .cast<float>());
    }
    const KdTree tree(cloud);
    const LocalShape shape = Normals(cloud, tree, 2000).at(0);
    EXPECT_NEAR(shape.length_m, half_length_m / std::sqrt(3.0), 0.05 * half_length_m);
    EXPECT_NEAR(shape.breadth_m, half_breadth_m / std::sqrt(3.0), 0.05 * half_breadth_m);
  }
}

TEST(Normals, DoNotDependOnTheOrderOfTheCalls) {
  // The radius of the point before it decides in which order the neighbours of a point are found.
  Rng rng = test::test_rng();
  for (const double noise_m : {0.0, 0.01}) {
    const Points cloud = test::random_street(rng, 1, 3000, noise_m);
    const KdTree tree(cloud);
    const Normals forwards(cloud, tree, 40), shuffled(cloud, tree, 40);
    for (int i = 0; i < 3000; ++i) forwards.at(i);
    for (int i = 0; i < 3000; ++i) {
      const int index = i * 1861 % 3000;
      const LocalShape a = shuffled.at(index), b = forwards.at(index);
      EXPECT_EQ(a.normal, b.normal);
      EXPECT_EQ(a.surface_variation, b.surface_variation);
      EXPECT_EQ(a.length_m, b.length_m);
      EXPECT_EQ(a.breadth_m, b.breadth_m);
    }
  }
}

TEST(Normals, AreTheSameWhicheverThreadAsksFirst) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_street(rng, 1, 4000, 0.01);
  const KdTree tree(cloud);
  const Normals alone(cloud, tree, 40);
  const Normals shared(cloud, tree, 40);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 4000; ++i) shared.at((i + 997 * t) % 4000);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < 4000; ++i) {
    EXPECT_EQ(shared.at(i).normal, alone.at(i).normal);
    EXPECT_EQ(shared.at(i).surface_variation, alone.at(i).surface_variation);
  }
}

}  // namespace
}  // namespace croon
