#include "framework/calibration/rig_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/statistics.hpp"
#include "framework/base/threads.hpp"
#include "framework/calibration/fit_check.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

/// Adds points of the rectangle `origin + u a + v b`: one at random in each cell of about `cell_m`.
void add_patch(Points& points, Rng& rng, const Eigen::Vector3d& origin, const Eigen::Vector3d& a,
               const Eigen::Vector3d& b, double cell_m) {
  const int columns = std::max(1, static_cast<int>(a.norm() / cell_m));
  const int rows = std::max(1, static_cast<int>(b.norm() / cell_m));
  for (int i = 0; i < columns * rows; ++i) {
    const double u = (i % columns + rng.uniform()) / columns;
    const double v = (i / columns + rng.uniform()) / rows;
    points.push_back((origin + u * a + v * b).cast<float>());
  }
}

/// A room of 20 x 20 m with its floor 2 m below the origin.
Points bare_room(std::uint64_t seed) {
  Rng rng = test_rng(seed);
  Points points;
  add_patch(points, rng, {-10, -10, -2}, {20, 0, 0}, {0, 20, 0}, 0.2);
  for (const double x : {-10.0, 10.0}) {
    add_patch(points, rng, {x, -10, -2}, {0, 20, 0}, {0, 0, 4}, 0.2);
  }
  add_patch(points, rng, {-10, 10, -2}, {20, 0, 0}, {0, 0, 4}, 0.2);
  return points;
}

ViewedCloud viewed_cloud(const std::string& sensor, const Points& points,
                         const std::vector<std::optional<RigidTransform>>& poses,
                         bool is_accepted = true) {
  return {sensor, std::make_shared<const Cloud>(points, StreamKey(1)), is_accepted, poses};
}

RigidTransform shift(double x_m, double y_m, double z_m) {
  return {Eigen::Matrix3d::Identity(), {x_m, y_m, z_m}};
}

bool is_inner_floor(const Eigen::Vector3f& point) {
  return point.z() < -1.9F && point.head<2>().cwiseAbs().maxCoeff() < 9.0F;
}

TEST(RigView, DistancesAreAlongTheNormalsAndNaNWithoutSurface) {
  Points points = bare_room(2);
  Rng rng = test_rng(3);
  add_patch(points, rng, {-1, -1, 4}, {2, 0, 0}, {0, 2, 0}, 0.2);  // Nobody else sees it.
  const RigView view =
      view_of("a", {"raised", "result"},
              {viewed_cloud("top", bare_room(1), {RigidTransform(), RigidTransform()}),
               viewed_cloud("left", points, {shift(0.0, 0.0, 0.05), RigidTransform()})});
  ASSERT_EQ(view.sensors.size(), 2U);
  const ViewedSensor& left = view.sensors[1];
  ASSERT_EQ(left.distances.size(), 2U);
  ASSERT_EQ(left.distances.at(0).size(), left.points.size());
  int floor = 0;
  for (std::size_t i = 0; i < left.points.size(); ++i) {
    if (left.points[i].z() > 3.0F) {
      EXPECT_TRUE(std::isnan(left.distances.at(1)[i]));
    } else if (is_inner_floor(left.points[i])) {
      EXPECT_NEAR(left.distances.at(0)[i], 0.05F, 1e-4F);
      EXPECT_NEAR(left.distances.at(1)[i], 0.0F, 1e-4F);
      ++floor;
    }
  }
  EXPECT_GT(floor, 1000);
  ASSERT_EQ(view.pairs.size(), 1U);
  EXPECT_GT(view.pairs[0].overlap_ratio, 0.9);
  EXPECT_LT(view.pairs[0].median_distance_m, 1e-3);
}

TEST(RigView, ResidualsArePositiveBehindTheSurface) {
  const RigView view = view_of("a", {"result"},
                               {viewed_cloud("top", bare_room(1), {RigidTransform()}),
                                viewed_cloud("left", bare_room(2), {shift(0.05, 0.0, 0.0)})});
  int ahead = 0, behind = 0;
  for (const Residual& residual : view.sensors[1].residuals) {
    if (std::abs(residual.elevation_deg) > 5.0) continue;
    const double off_deg =
        std::min(std::abs(residual.azimuth_deg), 180.0 - std::abs(residual.azimuth_deg));
    if (off_deg > 40.0) continue;
    const bool is_ahead = std::abs(residual.azimuth_deg) < 90.0;
    ++(is_ahead ? ahead : behind);
    EXPECT_NEAR(residual.distance_m, is_ahead ? 0.05 : -0.05, 1e-3);
    const double cosine =
        std::cos(rad_from_deg(off_deg)) * std::cos(rad_from_deg(residual.elevation_deg));
    EXPECT_NEAR(residual.incidence_deg, deg_from_rad(std::acos(cosine)), 0.5);
    EXPECT_NEAR(residual.range_m, 10.0 / cosine, 0.05);
  }
  EXPECT_GT(ahead, 100);
  EXPECT_GT(behind, 100);
}

/// The refit of a sensor in a street, with noise of 2 cm, whose given pose is wrong by `offset`.
Refit street_refit(std::uint64_t seed, const Vector6d& offset) {
  Rng rng = test_rng(seed);
  const RigidTransform T_top_left = {rotation_from_rpy({0.1, 0.0, 1.2}), {0.5, 0.6, -0.2}};
  const StreetPair pair = street_pair(rng, seed, T_top_left, 20000, 15000, 0.02);
  const RigView view = view_of("a", {"result"},
                               {viewed_cloud("top", pair.target, {RigidTransform()}),
                                viewed_cloud("left", pair.source, {moved(T_top_left, offset)})});
  EXPECT_FALSE(view.sensors[0].refit);
  EXPECT_TRUE(view.sensors[1].refit);
  return view.sensors[1].refit.value_or(Refit());
}

TEST(RigView, RefitFindsAPoseThatIsWrongByLittle) {
  Vector6d wrong = Vector6d::Zero();
  wrong(2) = rad_from_deg(0.3);
  wrong(3) = 0.03;
  wrong(4) = 0.04;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EXPECT_LT(street_refit(seed, Vector6d::Zero()).surface_shift_m, kMaxSurfaceShift_m);
    const Refit refit = street_refit(seed, wrong);
    EXPECT_GT(refit.surface_shift_m, kMaxSurfaceShift_m);
    EXPECT_NEAR(refit.rotation_rad, rad_from_deg(0.3), rad_from_deg(0.1));
    EXPECT_NEAR(refit.translation_m, 0.05, 0.02);
  }
}

TEST(RigView, MergesALastStepThatIsTheResult) {
  const RigidTransform near = shift(0.01, 0.0, 0.0), far = shift(1.0, 0.0, 0.0);
  const std::vector<std::string> states = {"coarse", "icp", "result"};
  const ViewedCloud top = viewed_cloud("top", bare_room(1), {3, RigidTransform()});
  const ViewedCloud left = viewed_cloud("left", bare_room(2), {far, near, near});
  const RigView merged = view_of("a", states, {top, left});
  EXPECT_EQ(merged.states, (std::vector<std::string>{"coarse", "result"}));
  EXPECT_EQ(merged.sensors[1].poses.size(), 2U);
  const ViewedCloud right = viewed_cloud("right", bare_room(3), {std::nullopt, far, near});
  const RigView whole = view_of("a", states, {top, left, right});
  EXPECT_EQ(whole.states, states);
  EXPECT_FALSE(whole.sensors[2].poses[0]);
  EXPECT_EQ(whole.sensors[2].distances.count(0), 0U);
}

TEST(RigView, ARejectedSensorIsNoSurface) {
  for (const bool is_accepted : {true, false}) {
    Points ceiling = bare_room(2);
    Rng rng = test_rng(4);
    add_patch(ceiling, rng, {-5, -5, 4}, {10, 0, 0}, {0, 10, 0}, 0.2);
    Points other = bare_room(3);
    add_patch(other, rng, {-4, -4, 4}, {8, 0, 0}, {0, 8, 0}, 0.2);
    const RigView view = view_of("a", {"result"},
                                 {viewed_cloud("top", bare_room(1), {RigidTransform()}),
                                  viewed_cloud("left", ceiling, {RigidTransform()}, is_accepted),
                                  viewed_cloud("right", other, {RigidTransform()})});
    const ViewedSensor& right = view.sensors[2];
    for (std::size_t i = 0; i < right.points.size(); ++i) {
      if (right.points[i].z() > 3.0F) {
        EXPECT_EQ(std::isnan(right.distances.at(0)[i]), !is_accepted);
      }
    }
    EXPECT_FALSE(view.sensors[1].residuals.empty());  // Its own points are compared all the same.
  }
}

/// A road with a wall across it, a pole and the corner of a house, 2 m below the origin.
Points places(std::uint64_t seed) {
  Rng rng = test_rng(seed);
  Points points;
  add_patch(points, rng, {-25, -25, -2}, {50, 0, 0}, {0, 50, 0}, 0.5);
  add_patch(points, rng, {20.5, -5, -2}, {0, 10, 0}, {0, 0, 4}, 0.2);
  add_patch(points, rng, {-15.3, 10.3, -2}, {0, 5, 0}, {0, 0, 4}, 0.2);
  add_patch(points, rng, {-15.3, 10.3, -2}, {-5, 0, 0}, {0, 0, 4}, 0.2);
  add_patch(points, rng, {12.45, -7.5, -2}, {0.1, 0, 0}, {0, 0, 4}, 0.05);
  return points;
}

TEST(CloseUps, AreWhereTheWallTheEdgeAndThePoleAre) {
  const ViewedCloud top = viewed_cloud("top", places(1), {RigidTransform()});
  const RigView view =
      view_of("a", {"result"}, {top, viewed_cloud("left", places(2), {RigidTransform()})});
  ASSERT_EQ(view.close_ups.size(), 3U);
  const std::vector<std::pair<std::string, Eigen::Vector2d>> expected = {
      {"wall, 21 m away", {20.5, 0.0}},
      {"vertical edge, 19 m away", {-15.4, 10.5}},
      {"pole, 15 m away", {12.5, -7.5}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d centre = view.close_ups[i].centre_m.head<2>();
    EXPECT_EQ(view.close_ups[i].title, expected[i].first);
    EXPECT_LT((centre - expected[i].second).norm(), 0.7) << centre.transpose();
  }
  // Without a second sensor nothing shows a misalignment.
  EXPECT_TRUE(view_of("a", {"result"}, {top}).close_ups.empty());
}

TEST(RigView, IsTheSameOnOneThreadAndOnFour) {
  const auto view_on = [](int threads) {
    RigView view;
    on_threads(threads, [&] {
      view = view_of("a", {"result"},
                     {viewed_cloud("top", bare_room(1), {RigidTransform()}),
                      viewed_cloud("left", bare_room(2), {shift(0.02, 0.0, 0.0)}),
                      viewed_cloud("right", bare_room(3), {shift(0.0, 0.01, 0.0)})});
    });
    return view;
  };
  const RigView one = view_on(1), four = view_on(4);
  for (std::size_t s = 0; s < 3; ++s) {
    const ViewedSensor &a = one.sensors[s], &b = four.sensors[s];
    ASSERT_EQ(a.residuals.size(), b.residuals.size());
    for (std::size_t i = 0; i < a.residuals.size(); ++i) {
      EXPECT_EQ(a.residuals[i].distance_m, b.residuals[i].distance_m);
    }
    ASSERT_EQ(a.refit.has_value(), b.refit.has_value());
    if (a.refit) {
      EXPECT_EQ(a.refit->surface_shift_m, b.refit->surface_shift_m);
      EXPECT_EQ(a.refit->translation_m, b.refit->translation_m);
    }
  }
  ASSERT_EQ(one.pairs.size(), 3U);
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_EQ(one.pairs[i].median_distance_m, four.pairs[i].median_distance_m);
  }
}

}  // namespace
}  // namespace croon::test
