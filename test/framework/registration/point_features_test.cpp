#include "framework/registration/point_features.hpp"

#include <gtest/gtest.h>

#include <map>

#include "framework/geometry/rigid_transform.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

Cloud cloud_of(const Points& points) { return Cloud(points, StreamKey(1)); }

PointFeatures features_of(const Points& points, int count = 300) {
  FeatureOptions options;
  options.max_features = count;
  return point_features(cloud_of(points), options);
}

TEST(PointFeatures, DoNotChangeIfTheCloudIsTurned) {
  Rng rng = test::test_rng();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const Points street = test::random_street(rng, i, 4000, 0.01);
    const RigidTransform T = {test::random_pose(rng, 0.0).rotation, Eigen::Vector3d::Zero()};
    const PointFeatures before = features_of(street);
    const PointFeatures after = features_of(transformed(street, T));
    const auto matches = mutual_matches(before, after, {10.0, 1});
    int same = 0;
    for (const FeatureMatch& match : matches) {
      const Eigen::Vector3d moved = T * before.points[match.target].cast<double>();
      if ((moved - after.points[match.source].cast<double>()).norm() < 1e-3) ++same;
    }
    // Rounding moves a few angles into the next bin.
    EXPECT_GT(same, 270) << "street " << i;
    EXPECT_LT(static_cast<int>(matches.size()) - same, 10) << "street " << i;
  }
}

TEST(PointFeatures, AreWhereTheCloudIsUnlikeAPlane) {
  Rng rng = test::test_rng(2);
  const Points street = test::random_street(rng, 3, 4000, 0.01);
  const auto on_ground = [](const Points& points) {
    int count = 0;
    for (const Eigen::Vector3f& point : points) count += point.z() < -1.9F ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(points.size());
  };
  EXPECT_LT(on_ground(features_of(street).points), 0.7 * on_ground(street));
}

TEST(PointFeatures, AreAtMostAsManyAsAskedFor) {
  Rng rng = test::test_rng(3);
  const Points street = test::random_street(rng, 3, 2000, 0.01);
  for (const int count : {1, 100, 10000}) {
    const PointFeatures features = features_of(street, count);
    EXPECT_LE(features.points.size(), std::min<std::size_t>(street.size(), count));
    EXPECT_GE(features.points.size(), static_cast<std::size_t>(std::min(count, 1000)));
    EXPECT_EQ(features.normals.size(), features.points.size());
    EXPECT_EQ(features.histograms.size(), features.points.size());
  }
}

TEST(PointFeatures, AreNoneOfPointsWithoutASurface) {
  EXPECT_TRUE(features_of({}).points.empty());
  EXPECT_TRUE(features_of({{1, 2, 3}}).points.empty());
  EXPECT_TRUE(features_of(Points(100, Eigen::Vector3f(1, 2, 3))).points.empty());
  Points line;
  for (int i = 0; i < 100; ++i) line.emplace_back(0.1F * static_cast<float>(i), 0.0F, 0.0F);
  EXPECT_TRUE(features_of(line).points.empty());
}

TEST(MutualMatches, AreAtMostTheCandidatesOfEachFeature) {
  Rng rng = test::test_rng(4);
  const PointFeatures target = features_of(test::random_street(rng, 3, 3000, 0.01));
  const PointFeatures source = features_of(test::random_street(rng, 3, 3000, 0.01));
  std::size_t before = 0;
  for (const int candidates : {1, 3}) {
    MatchOptions options;
    options.candidates = candidates;
    const auto matches = mutual_matches(target, source, options);
    std::map<int, int> of_target;
    std::map<int, int> of_source;
    for (const FeatureMatch& match : matches) {
      EXPECT_LE(++of_target[match.target], candidates);
      EXPECT_LE(++of_source[match.source], candidates);
    }
    EXPECT_GT(matches.size(), before);
    before = matches.size();
  }
}

TEST(MutualMatches, ReachNoFartherThanTheSensorsAreApart) {
  Rng rng = test::test_rng(5);
  const PointFeatures target = features_of(test::random_street(rng, 3, 3000, 0.01));
  const PointFeatures source = features_of(test::random_street(rng, 4, 3000, 0.01));
  MatchOptions options;
  options.max_sensor_distance_m = 1.0;
  const auto matches = mutual_matches(target, source, options);
  ASSERT_FALSE(matches.empty());
  for (const FeatureMatch& match : matches) {
    EXPECT_NEAR(target.points[match.target].norm(), source.points[match.source].norm(), 1.0001);
  }
}

}  // namespace
}  // namespace croon
