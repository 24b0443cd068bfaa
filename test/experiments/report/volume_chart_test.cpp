#include "experiments/report/volume_chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/picture/writers.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/support/occurrences.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

/// A room of 8 m x 6 m x 3 m with a pillar, at `T_room`: `count` points on its surfaces.
Points room(Rng& rng, int count, const RigidTransform& T_room) {
  const Eigen::Vector3d size(4.0, 3.0, 1.5), pillar(0.5, 0.4, 1.5);
  Points points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d& half = i % 4 == 0 ? pillar : size;
    Eigen::Vector3d point =
        half.unaryExpr([&](double reach) { return rng.uniform(-reach, reach); });
    const auto axis = static_cast<Eigen::Index>(rng.below(3));
    point[axis] = rng.below(2) == 0 ? half[axis] : -half[axis];
    points.push_back((T_room * point).cast<float>());
  }
  return points;
}

/// The curves around the true pose of a sensor, where each of two clouds has a half of the points.
VolumeCurves curves_of_room(const RigidTransform& T_target_source) {
  Rng rng = test::test_rng();
  // Walls across the leaves, as in a recording.
  const RigidTransform T_room{rotation_from_rpy({0.03, -0.05, 0.4}), {0.4, -0.3, 0.2}};
  const Points target = room(rng, 12000, T_room);
  const Points source = room(rng, 12000, T_target_source.inverse() * T_room);
  return volume_curves(target, source, T_target_source);
}

const RigidTransform kPose{rotation_from_rpy({0.02, 0.1, -0.7}), {0.8, 0.5, -0.2}};

TEST(VolumeCurves, AreMinimalNearTheTruth) {
  const VolumeCurves curves = curves_of_room(kPose);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const std::vector<double>& volumes = curves[k].volumes_m3;
    ASSERT_EQ(volumes.size(), curves[k].offsets.size());
    const auto least = std::min_element(volumes.begin(), volumes.end());
    const double limit = curves[k].offsets.back();
    EXPECT_EQ(curves[k].offsets.front(), -limit);
    EXPECT_NEAR(curves[k].offsets[static_cast<std::size_t>(least - volumes.begin())], 0.0,
                0.14 * limit)
        << kDofNames.at(k);
    EXPECT_GT(std::min(volumes.front(), volumes.back()), 1.05 * *least) << kDofNames.at(k);
  }
}

TEST(VolumeCurves, HaveGapsOutsideTheGrid) {
  const Points far = {Eigen::Vector3f(1e9F, 0.0F, 0.0F)};
  for (const VolumeCurve& curve : volume_curves(far, {Eigen::Vector3f::Zero()}, {})) {
    for (const double volume_m3 : curve.volumes_m3) EXPECT_TRUE(std::isnan(volume_m3));
  }
}

TEST(VolumeChart, IsReadableAndMarksGroundTruthWithinItsPanels) {
  Vector6d truth = Vector6d::Zero();
  truth[0] = rad_from_deg(0.3);
  truth[5] = 2.0;  // Beyond the panel.
  for (const Sheet& sheet : {Sheet{}, kOneColumn, kTwoColumns}) {
    const Drawing drawing = volume_chart(curves_of_room(kPose), truth, sheet);
    EXPECT_EQ(test::unreadable_parts(drawing), std::vector<std::string>());
    const std::string svg = svg_bytes(drawing);
    EXPECT_EQ(test::occurrences(svg, "class=\"curve c0\""), 6U + 1U);  // And the legend.
    EXPECT_EQ(test::occurrences(svg, "class=\"curve c1 d1\""), 5U + 1U);
    EXPECT_EQ(test::occurrences(svg, "nan"), 0U);
  }
}

TEST(VolumeChart, WithoutVolumesOrGroundTruthHasEmptyPanels) {
  const Drawing drawing = volume_chart({}, std::nullopt);
  EXPECT_EQ(test::unreadable_parts(drawing), std::vector<std::string>());
  EXPECT_EQ(test::occurrences(svg_bytes(drawing), "ground truth"), 0U);
}

}  // namespace
}  // namespace croon::experiments
